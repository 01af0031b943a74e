#include "readback/every_change.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace jourdain::tests {

namespace {

/// Another token where `c` stands, or 0.
char other(char c) {
  if (c >= '0' && c <= '9') return static_cast<char>('0' + (c - '0' + 1) % 10);
  const std::string tokens = "+-*/^&|", others = "-+/*|^&";
  const std::size_t at = tokens.find(c);
  return at == std::string::npos ? '\0' : others[at];
}

/// Positions in `text` of what can be changed outside of comments, from `first` up to `end`.
std::vector<std::size_t> places(const std::string& text, const std::string& first, const std::string& end) {
  std::vector<std::size_t> found;
  const std::size_t stop = text.find(end, text.find(first));
  for (std::size_t i = text.find(first); i < stop; ++i) {
    if (text.compare(i, 2, "//") == 0) i = text.find('\n', i);
    if (text.compare(i, 2, "/*") == 0) i = text.find("*/", i) + 2;
    if (other(text[i])) found.push_back(i);
  }
  return found;
}

/// The number whose text a place is in, as the type takes it that the file has.
double number_at(const std::string& text, std::size_t place) {
  const std::string parts = "0123456789.e-";
  std::size_t begin = place, end = place;
  while (begin > 0 && parts.find(text[begin - 1]) != std::string::npos) --begin;
  while (parts.find(text[end]) != std::string::npos) ++end;
  const std::string digits = text.substr(begin, end - begin);
  return text[end] == 'f' ? double(std::strtof(digits.c_str(), nullptr))
                          : std::strtod(digits.c_str(), nullptr);
}

}  // namespace

void expect_every_change_seen(const CompiledText& text, const std::string& file, const std::string& first,
                              const std::string& end, std::size_t stride, std::size_t least) {
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  for (std::size_t k = 0; k < text.compiled.files.size(); ++k) {
    std::vector<emit::File> files = text.compiled.files;
    std::string& changed = files[k].text;
    if (files[k].name != file) continue;
    const std::vector<std::size_t> all = places(changed, first, end);
    EXPECT_GE(all.size(), least) << file;
    for (std::size_t i = 0; i < all.size(); i += stride) {
      const char before = changed[all[i]];
      const double number = number_at(changed, all[i]);
      changed[all[i]] = other(before);
      const bool is_digit_too_many =
          before >= '0' && before <= '9' && number != 0 && number_at(changed, all[i]) == number;
      if (!is_digit_too_many) {
        EXPECT_FALSE(text.differences(files).empty()) << file << ": " << changed.substr(all[i] - 30, 60);
      }
      changed[all[i]] = before;
    }
    return;
  }
  FAIL() << "no " << file;
}

}  // namespace jourdain::tests
