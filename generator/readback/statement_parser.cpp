#include "readback/statement_parser.hpp"

namespace jourdain::readback {

Statement& StatementParser::make(StatementKind kind) {
  Statement& made = unit_.statements.emplace_back();
  made.kind = kind;
  made.place = place();
  return made;
}

const Statement* StatementParser::block() {
  Statement& made = make(StatementKind::kBlock);
  expect("{");
  while (!is("}")) made.body.push_back(statement());
  expect("}");
  return &made;
}

const Statement* StatementParser::statement() {
  if (is("{")) return block();
  if (known_.c && is("(") && is_word("void", 1)) return mention();
  if (is_word("if")) return if_statement();
  if (is_word("for")) return for_statement();
  if (is_word("return")) {
    Statement& made = make(StatementKind::kReturn);
    take();
    if (!is(";")) made.a = expression();
    expect(";");
    return &made;
  }
  if (is_word("constexpr") || starts_type()) return declaration();
  Statement& made = make(StatementKind::kExpression);
  made.a = expression();
  expect(";");
  return &made;
}

void StatementParser::initializer(Declarator& declarator) {
  if (accept("=")) declarator.initial = expression();
}

const Statement* StatementParser::declaration() {
  Statement& made = make(StatementKind::kDeclaration);
  made.is_constexpr = !known_.c && accept_word("constexpr");
  made.type = type();
  made.type.is_const = made.type.is_const || made.is_constexpr;
  do {
    made.declarators.push_back(declarator(false));
    initializer(made.declarators.back());
  } while (accept(","));
  expect(";");
  return &made;
}

const Statement* StatementParser::if_statement() {
  Statement& made = make(StatementKind::kIf);
  expect_word("if");
  expect("(");
  made.a = expression();
  expect(")");
  made.body.push_back(statement());
  if (accept_word("else")) made.body.push_back(statement());
  return &made;
}

const Statement* StatementParser::for_statement() {
  Statement& made = make(StatementKind::kFor);
  expect_word("for");
  expect("(");
  if (known_.c) return c_for(made);
  Statement& first = make(StatementKind::kDeclaration);
  if (!starts_type()) refuse_here("the declaration of a loop's variable");
  first.type = type();
  first.declarators.push_back(declarator(false));
  if (accept(":")) {
    made.type = first.type;
    made.declarators = first.declarators;
    return range_for(made);
  }
  initializer(first.declarators.back());
  expect(";");
  made.first = &first;
  made.a = expression();
  expect(";");
  made.step = expression();
  expect(")");
  made.body.push_back(statement());
  return &made;
}

/// C's: the loop's variable is declared before.
const Statement* StatementParser::c_for(Statement& made) {
  Statement& first = make(StatementKind::kExpression);
  first.a = expression();
  if (first.a->kind != ExpressionKind::kAssign) refuse_here("the first value of a loop's variable");
  expect(";");
  made.first = &first;
  made.a = expression();
  expect(";");
  made.step = expression();
  expect(")");
  made.body.push_back(statement());
  return &made;
}

/// `(void)parameter;`, which says that nothing reads it.
const Statement* StatementParser::mention() {
  Statement& made = make(StatementKind::kBlock);
  expect("(");
  expect_word("void");
  expect(")");
  made.a = expression();
  if (made.a->kind != ExpressionKind::kName) refuse_here("a parameter");
  expect(";");
  return &made;
}

const Statement* StatementParser::range_for(Statement& made) {
  made.kind = StatementKind::kRangeFor;
  made.a = expression();
  expect(")");
  made.body.push_back(statement());
  return &made;
}

}  // namespace jourdain::readback
