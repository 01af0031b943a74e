#include "readback/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace jourdain::readback {

void refuse(const std::string& file, int line, const std::string& message) {
  throw Refusal(fmt::format("{}:{}: {}", file, line, message));
}

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }

/// Longest first; compound assignments and shifts are tokens so that they are not taken for two.
constexpr std::array<std::string_view, 21> kLongPunctuation = {
    "...", "->*", "::", "++", "--", "<=", ">=", "==", "!=", "&&", "||",
    "->",  "+=",  "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<"};

class Tokenizer {
 public:
  Tokenizer(const std::string& file, std::string_view text) : text_(text) { result_.file = file; }

  Tokens read() {
    while (skip_space(), at_ < text_.size()) token();
    push(TokenKind::kEnd, text_.substr(text_.size()));
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse_here(const std::string& what) const { refuse(result_.file, line_, what); }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void skip_space() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') {
        ++line_;
        starts_line_ = true;
      } else if (c == '/' && peek(1) == '/') {
        line_comment();
        --at_;
      } else if (c == '/' && peek(1) == '*') {
        block_comment();
      } else if (c != ' ' && c != '\t' && c != '\r') {
        return;
      }
    }
  }

  void add_comment(std::string_view content) {
    if (!in_comment_) result_.comments.emplace_back();
    in_comment_ = true;
    result_.comments.back() += std::string(content) + "\n";
  }

  void line_comment() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view content = text_.substr(at_, end - at_);
    if (content.back() == '\\') refuse_here("a comment that goes on in the next line");
    while (!content.empty() && (content.front() == '/' || content.front() == '<')) content.remove_prefix(1);
    add_comment(content);
    at_ = end;
  }

  void block_comment() {
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos) refuse_here("a comment without an end");
    const std::string_view content = text_.substr(at_ + 2, end - at_ - 2);
    add_comment(content.substr(std::min(content.find_first_not_of("*<"), content.size())));
    line_ += static_cast<int>(std::count(content.begin(), content.end(), '\n'));
    at_ = end + 1;
  }

  void push(TokenKind kind, std::string_view text) {
    const int comment = in_comment_ ? static_cast<int>(result_.comments.size()) - 1 : -1;
    result_.tokens.push_back({kind, text, line_, comment});
    in_comment_ = starts_line_ = false;
  }

  void token() {
    const char c = peek();
    if (c == '#') return directive();
    if (is_name_start(c)) return name();
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number();
    if (c == '"') return string();
    for (const std::string_view punctuation : kLongPunctuation)
      if (text_.substr(at_).starts_with(punctuation))
        return take(TokenKind::kPunctuation, punctuation.size());
    if (std::string_view("()[]{}<>;:,.=+-*/!&?%|^~").find(c) == std::string_view::npos)
      refuse_here(fmt::format("the character '{}' (code {})", c, static_cast<unsigned char>(c)));
    take(TokenKind::kPunctuation, 1);
  }

  void take(TokenKind kind, std::size_t length) {
    push(kind, text_.substr(at_, length));
    at_ += length;
  }

  void directive() {
    if (!starts_line_) refuse_here("'#' within a line");
    std::size_t end = std::min(text_.find('\n', at_), text_.size());
    if (text_[end - 1] == '\\') refuse_here("a directive that goes on in the next line");
    take(TokenKind::kDirective, end - at_);
  }

  void name() {
    std::size_t length = 1;
    while (is_name_part(peek(length))) ++length;
    if (peek(length) == '"') refuse_here("a string with a prefix");
    take(TokenKind::kName, length);
  }

  /// Decimal integers and floating-point numbers, these also with the suffix that makes them floats.
  void number() {
    std::size_t length = 0;
    bool floating = false;
    while (is_digit(peek(length))) ++length;
    if (length > 1 && peek() == '0' && peek(length) != '.' && peek(length) != 'e')
      refuse_here("a number in octal digits");
    if (peek(length) == '.') {
      floating = true;
      for (++length; is_digit(peek(length));) ++length;
    }
    if (peek(length) == 'e' || peek(length) == 'E') {
      floating = true;
      ++length;
      if (peek(length) == '+' || peek(length) == '-') ++length;
      if (!is_digit(peek(length))) refuse_here("a number without the digits of its exponent");
      while (is_digit(peek(length))) ++length;
    }
    if (floating && peek(length) == 'f') ++length;
    if (is_name_part(peek(length)) || peek(length) == '.' || peek(length) == '\'')
      refuse_here(fmt::format("the number '{}'", text_.substr(at_, length + 1)));
    take(floating ? TokenKind::kFloating : TokenKind::kInteger, length);
  }

  void string() {
    std::size_t end = at_ + 1;
    for (; end < text_.size() && text_[end] != '"' && text_[end] != '\n'; ++end)
      if (text_[end] == '\\') ++end;
    if (end >= text_.size() || text_[end] == '\n') refuse_here("a string without an end");
    push(TokenKind::kString, text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
  }

  std::string_view text_;
  Tokens result_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool in_comment_ = false, starts_line_ = true;
};

}  // namespace

Tokens tokenize(const std::string& file, std::string_view text) { return Tokenizer(file, text).read(); }

}  // namespace jourdain::readback
