// Finished C++ text as tokens: the first step of reading back what was written, by C++'s rules alone.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::readback {

/// Text that is not in the subset of C++ that is understood, or that C++ would not accept; the message begins
/// with file and line.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class TokenKind : std::uint8_t { kName, kInteger, kFloating, kString, kPunctuation, kDirective, kEnd };

struct Token {
  TokenKind kind = TokenKind::kEnd;
  std::string_view text;  ///< a string without its quotes, a directive from its '#' to the end of the line
  int line = 0;
  int comment = -1;  ///< index of the comment right before it, or −1
};

/// One file's tokens; they point into `text`, which must outlive them.
struct Tokens {
  std::string file;
  std::vector<Token> tokens;  ///< the last one is kEnd
  std::vector<std::string>
      comments;  ///< runs of comments without code between them, line by line, without slashes
};

/// Throws Refusal.
Tokens tokenize(const std::string& file, std::string_view text);

/// Throws Refusal: "file:line: message".
[[noreturn]] void refuse(const std::string& file, int line, const std::string& message);

}  // namespace jourdain::readback
