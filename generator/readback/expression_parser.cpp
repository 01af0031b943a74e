#include "readback/expression_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace jourdain::readback {

namespace {

bool is_keyword(std::string_view text) {
  static const std::set<std::string_view> words = {
      "const",    "constexpr", "for",       "if",     "else",     "return",   "template",    "class",
      "struct",   "namespace", "inline",    "static", "explicit", "noexcept", "using",       "typename",
      "while",    "do",        "switch",    "case",   "default",  "break",    "continue",    "goto",
      "operator", "new",       "delete",    "this",   "auto",     "volatile", "mutable",     "sizeof",
      "alignas",  "alignof",   "union",     "enum",   "extern",   "typedef",  "virtual",     "friend",
      "public",   "private",   "protected", "throw",  "try",      "catch",    "and",         "or",
      "not",      "xor",       "bitand",    "bitor",  "compl",    "asm",      kFunctionMacro};
  return words.count(text) > 0;
}

bool is_built_in(std::string_view text) {
  return text == "int" || text == "double" || text == "float" || text == "bool" || text == "void" ||
         text == "char";
}

struct Level {
  std::string_view text;
  int precedence;
  BinaryOp operation;
};

constexpr Level kLevels[] = {
    {"||", 1, BinaryOp::kOr},        {"&&", 2, BinaryOp::kAnd},          {"==", 3, BinaryOp::kEqual},
    {"!=", 3, BinaryOp::kNotEqual},  {"<", 4, BinaryOp::kLess},          {">", 4, BinaryOp::kGreater},
    {"<=", 4, BinaryOp::kLessEqual}, {">=", 4, BinaryOp::kGreaterEqual}, {"+", 5, BinaryOp::kAdd},
    {"-", 5, BinaryOp::kSubtract},   {"*", 6, BinaryOp::kMultiply},      {"/", 6, BinaryOp::kDivide}};

}  // namespace

const Token& ExpressionParser::peek(std::size_t ahead) const {
  return tokens_.tokens[std::min(at_ + ahead, tokens_.tokens.size() - 1)];
}

const Token& ExpressionParser::take() {
  const Token& token = peek();
  if (at_ + 1 < tokens_.tokens.size()) ++at_;
  return token;
}

bool ExpressionParser::is(std::string_view punctuation, std::size_t ahead) const {
  return peek(ahead).kind == TokenKind::kPunctuation && peek(ahead).text == punctuation;
}

bool ExpressionParser::is_word(std::string_view word, std::size_t ahead) const {
  return peek(ahead).kind == TokenKind::kName && peek(ahead).text == word;
}

bool ExpressionParser::accept(std::string_view punctuation) { return is(punctuation) && (take(), true); }
bool ExpressionParser::accept_word(std::string_view word) { return is_word(word) && (take(), true); }

void ExpressionParser::expect(std::string_view punctuation) {
  if (!accept(punctuation)) refuse_here(fmt::format("'{}'", punctuation));
}

void ExpressionParser::expect_word(std::string_view word) {
  if (!accept_word(word)) refuse_here(fmt::format("'{}'", word));
}

Symbol ExpressionParser::expect_name() {
  if (peek().kind != TokenKind::kName || is_keyword(peek().text) || is_built_in(peek().text))
    refuse_here("a name");
  return unit_.symbols[take().text];
}

void ExpressionParser::refuse_here(const std::string& expected) const {
  const std::string found =
      peek().kind == TokenKind::kEnd ? "the end of the file" : fmt::format("'{}'", peek().text);
  refuse(tokens_.file, peek().line, fmt::format("expected {}, found {}", expected, found));
}

Expression& ExpressionParser::make(ExpressionKind kind) {
  Expression& made = unit_.expressions.emplace_back();
  made.kind = kind;
  made.place = place();
  return made;
}

bool ExpressionParser::is_known_type(Symbol name) const {
  return known_.types.count(name) || known_.struct_templates.count(name);
}

bool ExpressionParser::starts_type() const {
  if (peek().kind != TokenKind::kName) return false;
  if (peek().text == "const" || is_built_in(peek().text)) return true;
  const Symbol first = unit_.symbols[peek().text];
  if (known_.c) return known_.c_types.count(first) > 0;
  if (is_known_type(first)) return true;
  return is("::", 1) && peek(2).kind == TokenKind::kName &&
         known_.qualified.count({first, unit_.symbols[peek(2).text]}) > 0;
}

bool ExpressionParser::is_struct_template(const std::vector<Symbol>& path) const {
  if (path.size() == 2) return known_.qualified.count({path[0], path[1]}) > 0;
  return path.size() == 1 && known_.struct_templates.count(path[0]) > 0;
}

TypeName ExpressionParser::type() {
  if (known_.c) return c_type();
  TypeName result;
  result.is_const = accept_word("const");
  if (peek().kind == TokenKind::kName && is_built_in(peek().text)) {
    result.path = {unit_.symbols[take().text]};
    return result;
  }
  if (!starts_type()) refuse_here("a type");
  result.path = {expect_name()};
  if (!is_known_type(result.path[0])) {
    expect("::");
    result.path.push_back(expect_name());
  }
  if (is("<") && is_struct_template(result.path)) template_arguments(result);
  return result;
}

void ExpressionParser::template_arguments(TypeName& type_name) {
  expect("<");
  ++angle_brackets_;
  do {
    TemplateArgument argument;
    if (starts_type())
      argument.type = type();
    else
      argument.value = expression();
    type_name.arguments.push_back(argument);
  } while (accept(","));
  --angle_brackets_;
  expect(">");
}

/// `name[2]`, `*name`, `&name`, `(&name)[2][3]`, each also without its name.
Declarator ExpressionParser::declarator(bool may_be_unnamed) {
  Declarator result;
  result.place = place();
  const bool wrapped = is("(") && (is("&", 1) || is("*", 1));
  if (wrapped) take();
  if (is("&") || is("*")) result.indirection = take().text[0];
  if (peek().kind == TokenKind::kName || !may_be_unnamed) result.name = expect_name();
  if (wrapped) expect(")");
  bounds(result);
  if (!wrapped && result.indirection == '&' && !result.bounds.empty()) refuse_here("no array of references");
  if (wrapped && (result.indirection != '&' || result.bounds.empty())) refuse_here("a reference to an array");
  return result;
}

void ExpressionParser::bounds(Declarator& declarator) {
  while (accept("[")) {
    declarator.bounds.push_back(is("]") ? nullptr : expression());
    expect("]");
  }
}

const Expression* ExpressionParser::expression() {
  const Expression* left = level(1);
  if (is("?")) refuse_here("no conditional expression");
  if (!is("=")) return left;
  Expression& made = make(ExpressionKind::kAssign);
  take();
  made.a = left;
  made.b = is("{") ? list() : expression();
  return &made;
}

/// Operations of one level and above, grouped from the left.
const Expression* ExpressionParser::level(int precedence) {
  if (precedence > 6) return unary();
  const Expression* left = level(precedence + 1);
  for (;;) {
    if (peek().kind != TokenKind::kPunctuation) return left;
    if (angle_brackets_ > 0 && is(">")) return left;
    const auto found = std::find_if(std::begin(kLevels), std::end(kLevels), [&](const Level& l) {
      return l.precedence == precedence && l.text == peek().text;
    });
    if (found == std::end(kLevels)) return left;
    Expression& made = make(ExpressionKind::kBinary);
    take();
    made.operation = found->operation;
    made.a = left;
    made.b = level(precedence + 1);
    left = &made;
  }
}

const Expression* ExpressionParser::unary() {
  const auto prefix = [this](ExpressionKind kind) {
    Expression& made = make(kind);
    take();
    made.a = unary();
    return &made;
  };
  if (is("-")) return prefix(ExpressionKind::kNegate);
  if (is("!")) return prefix(ExpressionKind::kNot);
  if (is("++")) return prefix(ExpressionKind::kIncrement);
  if (is("--")) return prefix(ExpressionKind::kDecrement);
  if (known_.c && is("&")) return prefix(ExpressionKind::kAddress);
  if (known_.c && is("*")) return prefix(ExpressionKind::kDereference);
  return postfix();
}

const Expression* ExpressionParser::postfix() {
  const Expression* left = primary();
  for (;;) {
    if (is("[")) {
      Expression& made = make(ExpressionKind::kSubscript);
      take();
      made.a = left;
      made.b = expression();
      expect("]");
      left = &made;
    } else if (is(".") || (known_.c && is("->"))) {
      const bool points = is("->");
      Expression& made = make(ExpressionKind::kMember);
      take();
      made.a = points ? dereferenced(left) : left;
      made.name = expect_name();
      left = &made;
    } else if (is("(")) {
      Expression& made = make(ExpressionKind::kCall);
      made.a = left;
      take();
      arguments(made, ")");
      left = known_.c ? c_call(made) : cpp_call(made);
    } else {
      return left;
    }
  }
}

/// `detail::number<Real>(x)` of text for packs is Real(x), `table(i)` an entry.
const Expression* ExpressionParser::cpp_call(Expression& call) {
  if (call.a->kind == ExpressionKind::kName && !call.a->type && known_.tables.contains(call.a->name) &&
      call.arguments.size() == 1) {
    call.kind = ExpressionKind::kSubscript;
    call.b = call.arguments.front();
    call.arguments.clear();
    return &call;
  }
  const TypeName* scope = call.a->kind == ExpressionKind::kName ? call.a->type : nullptr;
  const bool converts =
      known_.packs && scope && scope->path == std::vector<Symbol>{unit_.symbols["detail"]} &&
      call.a->name == unit_.symbols["number"] && scope->arguments.size() == 1 && !scope->arguments[0].value;
  if (!converts) return &call;
  call.kind = ExpressionKind::kCast;
  call.type = &scope->arguments[0].type;
  call.a = nullptr;
  return &call;
}

void ExpressionParser::arguments(Expression& call, std::string_view close) {
  const int outside = std::exchange(angle_brackets_, 0);
  if (!is(close)) do {
      const bool is_function = known_.c && is_word("input_at") && is(",", 1);
      call.arguments.push_back(is("{") ? list() : expression());
      if (!is_function) continue;
      take();
      expect_word("context");  // goes with the function
    } while (accept(","));
  expect(close);
  angle_brackets_ = outside;
}

const Expression* ExpressionParser::list() {
  Expression& made = make(ExpressionKind::kList);
  expect("{");
  arguments(made, "}");
  return &made;
}

const Expression* ExpressionParser::primary() {
  if (is("{")) return list();
  if (known_.c && is("(")) return c_parenthesis();
  if (is("(")) {
    take();
    const int outside = std::exchange(angle_brackets_, 0);
    const Expression* inner = expression();
    angle_brackets_ = outside;
    expect(")");
    return inner;
  }
  switch (peek().kind) {
    case TokenKind::kInteger:
    case TokenKind::kFloating:
      return number();
    case TokenKind::kString: {
      Expression& made = make(ExpressionKind::kString);
      made.text = take().text;
      return &made;
    }
    case TokenKind::kName:
      return name();
    case TokenKind::kPunctuation:
      if (is("::")) return name();
      break;
    case TokenKind::kDirective:
    case TokenKind::kEnd:
      break;
  }
  refuse_here("an expression");
}

const Expression* ExpressionParser::number(bool is_negative) {
  const Expression& made = plain_number(is_negative);
  return made.kind == ExpressionKind::kFloating && known_.c ? as_real(&made) : &made;
}

Expression& ExpressionParser::plain_number(bool is_negative) {
  const bool floating = peek().kind == TokenKind::kFloating, is_float = known_.c && known_.c->is_float;
  Expression& made = make(floating ? ExpressionKind::kFloating : ExpressionKind::kInteger);
  std::string_view text = peek().text;
  if (floating && text.ends_with('f') != is_float) refuse_here("a number of the type of this file");
  if (floating && is_float) text.remove_suffix(1);
  float rounded = 0;
  const char *const begin = text.data(), *const last = begin + text.size();
  const auto [end, error] = !floating  ? std::from_chars(begin, last, made.integer)
                            : is_float ? std::from_chars(begin, last, rounded)
                                       : std::from_chars(begin, last, made.floating);
  if (error != std::errc() || end != last || made.integer > 0x7fffffff)
    refuse_here("a number within the range of its type");
  if (floating && is_float) made.floating = static_cast<double>(rounded);
  if (is_negative) made.floating = -made.floating;
  take();
  return made;
}

/// A name, `true`, a call of a type, or a name with template arguments.
const Expression* ExpressionParser::name() {
  if (known_.c) return c_name();
  if (is_word("true") || is_word("false")) {
    Expression& made = make(ExpressionKind::kBool);
    made.integer = take().text == "true";
    return &made;
  }
  if (is_word("nullptr")) {
    Expression& made = make(ExpressionKind::kNull);
    take();
    return &made;
  }
  Expression& made = make(ExpressionKind::kName);
  made.global = accept("::");
  if (!made.global && starts_type()) {
    TypeName& read = unit_.types.emplace_back(type());
    if (is("(")) {
      made.kind = ExpressionKind::kCast;
      made.type = &read;
      take();
      arguments(made, ")");
      return &made;
    }
    if (is("{")) {
      made.kind = ExpressionKind::kCast;
      made.type = &read;
      made.arguments.push_back(list());
      return &made;
    }
    expect("::");  // a member of a type
    made.name = expect_name();
    made.type = &read;
    return &made;
  }
  std::vector<Symbol> path = {expect_name()};
  while (accept("::")) path.push_back(expect_name());
  made.name = path.back();
  const bool is_template =
      is("<") && known_.function_templates.count(made.name) && !known_.types.count(made.name);
  if (path.size() == 1 && !is_template) return &made;
  path.pop_back();
  TypeName& scope = unit_.types.emplace_back();
  scope.path = path;
  if (is_template) template_arguments(scope);
  made.type = &scope;
  return &made;
}

}  // namespace jourdain::readback
