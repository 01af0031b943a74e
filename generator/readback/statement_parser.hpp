// Statements by recursive descent.
#pragma once

#include "readback/expression_parser.hpp"

namespace jourdain::readback {

class StatementParser : public ExpressionParser {
 public:
  using ExpressionParser::ExpressionParser;

  const Statement* block();

 protected:
  void initializer(Declarator& declarator);

 private:
  const Statement* statement();
  const Statement* declaration();
  const Statement* if_statement();
  const Statement* for_statement();
  const Statement* range_for(Statement& made);
  const Statement* c_for(Statement& made);
  const Statement* mention();
  Statement& make(StatementKind kind);
};

}  // namespace jourdain::readback
