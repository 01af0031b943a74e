#include "emit/c/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "emit/layout.hpp"

namespace jourdain::emit::c {

std::string CNames::digits(double value) const {
  std::string digits = is_float ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits + suffix();
}

std::string CNames::literal(double value) const {
  return std::signbit(value) ? "(" + digits(value) + ")" : digits(value);
}

bool is_internal(const Type& type) {
  static constexpr std::array<std::string_view, 3> kOfSteps = {"ImplicitStep", "ImplicitStage", "Increment"};
  return type.kind == Type::Kind::kStruct &&
         std::find(kOfSteps.begin(), kOfSteps.end(), type.name) != kOfSteps.end();
}

std::string CNames::type(const Type& type) const {
  switch (type.kind) {
    case Type::Kind::kReal:
      return real();
    case Type::Kind::kAngle:
      return internal("angle");
    case Type::Kind::kInteger:
      return "int";
    case Type::Kind::kStruct:
    case Type::Kind::kLanes:
      break;
  }
  if (type.name == "Outputs") return global("output_values");  // `outputs` is the function that fills it
  std::string name;
  for (const char c : type.name) {
    const bool is_capital = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (is_capital && !name.empty()) name += '_';
    name += is_capital ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
  }
  if (type.depth > 0) name += fmt::format("{}", type.depth);
  return is_internal(type) ? internal(name) : global(name);
}

std::string c_safe(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    const char last = safe.empty() ? ' ' : safe.back();
    if (c == '?' && last == '?') continue;
    if ((c == '/' && last == '*') || (c == '*' && last == '/')) safe += ' ';
    safe += c;
  }
  return safe;
}

namespace {

std::string commented(const char* opening, const std::string& content, std::size_t indent) {
  const std::string margin(indent, ' '), next(indent + std::string_view(opening).size(), ' ');
  return wrapped_words(margin + opening + c_safe(content) + " */", next, indent + 8);
}

}  // namespace

std::string c_doc(const std::string& content, std::size_t indent) {
  return commented("/** ", content, indent);
}

std::string c_comment(const std::string& content, std::size_t indent) {
  return commented("/* ", content, indent);
}

}  // namespace jourdain::emit::c
