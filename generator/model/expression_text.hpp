// The text of an expression as it is read: blanks, words, places of errors.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "model/expression.hpp"
#include "support/diagnostics.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

class ExpressionText {
 protected:
  explicit ExpressionText(std::string_view text) : text_(text) {}

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

  [[noreturn]] void fail(std::size_t offset, std::size_t length, std::string message,
                         std::string hint = "") const {
    throw ExpressionError{offset, std::max<std::size_t>(1, length), std::move(message), std::move(hint)};
  }

  bool at_end() {
    while (position_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[position_]) != std::string_view::npos)
      ++position_;
    return position_ == text_.size();
  }

  bool next_is(char c) { return !at_end() && text_[position_] == c; }

  bool accept(char c) {
    if (!next_is(c)) return false;
    ++position_;
    return true;
  }

  std::size_t character(std::size_t offset) const { return support::utf8_at(text_, offset).bytes; }

  std::string_view name_at(std::size_t begin) const {
    std::size_t end = begin;
    while (end < text_.size() && (starts_name(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(begin, end - begin);
  }

  /// With a member after one dot.
  std::string_view dotted_name_at(std::size_t begin) const {
    const std::string_view word = name_at(begin);
    const std::size_t dot = begin + word.size();
    if (word.empty() || dot + 1 >= text_.size() || text_[dot] != '.' || !starts_name(text_[dot + 1]))
      return word;
    return text_.substr(begin, word.size() + 1 + name_at(dot + 1).size());
  }

  std::string rest_of_word(std::size_t begin) const {
    const std::string_view name = name_at(begin);
    return support::shown(name.empty() ? text_.substr(begin, character(begin)) : name);
  }

  /// Without the blanks at its end.
  std::string_view written(std::size_t begin, std::size_t end) const {
    const std::string_view part = text_.substr(begin, end - begin);
    return part.substr(0, part.find_last_not_of(" \t\r\n") + 1);
  }

  std::size_t skip_blanks() {
    at_end();
    return position_;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace jourdain::model
