// Functions that take entries of an array of constants: a second copy of how they are written, but for their numbers.
#include <fmt/format.h>

#include <cmath>

#include "readback/expression_parser.hpp"

namespace jourdain::readback {

namespace {

constexpr std::string_view kName = "table_";

}  // namespace

void ExpressionParser::expect_text(const std::string& text) {
  const Tokens expected = tokenize("", text);
  for (std::size_t i = 0; i + 1 < expected.tokens.size(); ++i) {
    if (peek().kind != expected.tokens[i].kind || peek().text != expected.tokens[i].text)
      refuse_here(std::string(expected.tokens[i].text));
    take();
  }
}

bool ExpressionParser::begins_table() const {
  if (!known_.c) return is_word("template") && is_word("Real", 6) && peek(7).text.starts_with(kName);
  return is_word("static") && peek(2).text.starts_with(known_.c->internal() + std::string(kName));
}

bool ExpressionParser::table_function() {
  if (!begins_table()) return false;
  std::string name;
  std::vector<double> values;
  if (known_.c) {
    const std::string real = known_.c->real();
    expect_text("static " + real);
    name = unit_.symbols.text(expect_name()).substr(known_.c->internal().size());
    expect_text(fmt::format("({0} i) {{ static const {0} values[] = {{", real));
    values = listed_numbers();
    expect_text(fmt::format("}}; return values[i > 0.0{0} ? (i < {1}.0{0} ? (int)i : {1}) : 0]; }}",
                            known_.c->is_float ? "f" : "", values.size() - 1));
  } else {
    expect_text("template <class Real> JOURDAIN_FUNCTION Real");
    name = unit_.symbols.text(expect_name());
    expect_text("(const Real& i) noexcept { using Value =");
    const bool holds_doubles = accept_word("double");
    if (!holds_doubles) expect_text("typename hooks::TableOf<Real>::Type");
    expect_text("; static constexpr Value values[] = {");
    values = listed_numbers();
    for (const double value : values)
      if (!holds_doubles && std::isinf(static_cast<float>(value))) refuse_here("numbers that floats hold");
    expect_text("}; return hooks::entry(values, i, hooks::ByOwnEntry<Real>()); }");
  }
  if (!unit_.tables.emplace(name, values).second) refuse_here("no second " + name);
  return true;
}

std::vector<double> ExpressionParser::listed_numbers() {
  std::vector<double> values;
  do {
    if (!known_.c) expect_text("Value(");
    const bool is_negative = accept("-");
    if (peek().kind != TokenKind::kFloating) refuse_here("a number");
    values.push_back(plain_number(is_negative).floating);
    if (!known_.c) expect(")");
  } while (accept(","));
  return values;
}

}  // namespace jourdain::readback
