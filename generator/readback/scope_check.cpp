#include "readback/scope_check.hpp"

#include <set>

#include "readback/function_texts.hpp"

namespace jourdain::readback {

namespace {

class ScopeCheck {
 public:
  ScopeCheck(const Unit& unit, Findings& findings)
      : unit_(unit), findings_(findings), count_(unit.symbols.size(), 0) {
    for (const Function* function : unit.functions)
      functions_.insert({function->scope, unit.symbols.text(function->name)});
    for (const auto& [name, values] : unit.tables) functions_.insert({"detail", name});
    for (const LibraryName& known : library_names()) functions_.insert({"", std::string(known.name)});
  }

  void check(const Function& function, const Struct* inside) {
    scope_ = function.scope == "detail" ? "detail" : "";
    hide(0);
    if (inside)
      for (const Member& member : inside->members) show(member.declarator.name);
    for (const Constant* constant : unit_.constants)
      if (constant->scope.empty() || constant->scope == scope_) show(constant->declarator.name);
    for (const Parameter& parameter : function.parameters) show(parameter.declarator.name);
    check(*function.body);
  }

 private:
  void check(const Statement& statement) {
    const std::size_t outside = visible_.size();
    switch (statement.kind) {
      case StatementKind::kDeclaration:
        declare(statement);
        return;
      case StatementKind::kRangeFor:
        check(statement.a);
        show(statement.declarators[0].name);
        break;
      case StatementKind::kFor:
        check(*statement.first);
        check(statement.a);
        check(statement.step);
        break;
      case StatementKind::kBlock:
      case StatementKind::kExpression:
      case StatementKind::kIf:
      case StatementKind::kReturn:
        check(statement.a);
        break;
    }
    for (const Statement* inner : statement.body) {
      const std::size_t before = visible_.size();
      check(*inner);
      if (statement.kind != StatementKind::kBlock) hide(before);
    }
    hide(outside);
  }

  void declare(const Statement& statement) {
    for (const Declarator& declarator : statement.declarators) {
      for (const Expression* bound : declarator.bounds) check(bound);
      check(declarator.initial);
      show(declarator.name);
    }
  }

  void check(const Expression* expression) {
    if (!expression) return;
    if (expression->kind == ExpressionKind::kName) return variable(*expression);
    const bool is_call =
        expression->kind == ExpressionKind::kCall && expression->a->kind == ExpressionKind::kName;
    if (is_call)
      callee(*expression->a);
    else
      check(expression->a);
    check(expression->b);
    for (const Expression* argument : expression->arguments) check(argument);
  }

  void show(Symbol name) {
    visible_.push_back(name);
    ++count_[name];
  }
  void hide(std::size_t from) {
    for (; visible_.size() > from; visible_.pop_back()) --count_[visible_.back()];
  }
  bool is_visible(Symbol name) const { return count_[name] > 0; }

  void variable(const Expression& expression) {
    if (expression.type && !expression.type->path.empty()) return static_member(expression);
    if (!is_visible(expression.name)) unknown(expression);
  }

  void static_member(const Expression& expression) {
    for (const Struct* known : unit_.structs)
      if (known->name == expression.type->path.back())
        for (const Member& member : known->members)
          if (member.is_static && member.declarator.name == expression.name) return;
    unknown(expression);
  }

  void callee(const Expression& expression) {
    const std::string& name = unit_.symbols.text(expression.name);
    if (expression.global) return;  // of the C library, looked at where it is executed
    if (expression.type && !expression.type->path.empty()) {
      if (!functions_.count({unit_.symbols.text(expression.type->path[0]), name})) unknown(expression);
      return;
    }
    if (!is_visible(expression.name) && !functions_.count({scope_, name}) && !functions_.count({"", name}))
      unknown(expression);
  }

  void unknown(const Expression& expression) {
    findings_.add("{}:{}: '{}' is not known here",
                  unit_.files[static_cast<std::size_t>(expression.place.file)], expression.place.line,
                  unit_.symbols.text(expression.name));
  }

  const Unit& unit_;
  Findings& findings_;
  std::set<std::pair<std::string, std::string>> functions_;
  std::vector<Symbol> visible_;
  std::vector<int> count_;  ///< by symbol
  std::string scope_;
};

}  // namespace

void check_scopes(const Unit& unit, Findings& findings) {
  ScopeCheck check(unit, findings);
  for (const Function* function : unit.functions) {
    if (!function->body) continue;
    const Struct* inside = nullptr;
    for (const Struct* known : unit.structs)
      if (function->is_constructor && known->name == function->name) inside = known;
    check.check(*function, inside);
  }
  for (const Struct* known : unit.structs)
    for (const Function* function : known->functions)
      if (function->body) check.check(*function, known);
}

}  // namespace jourdain::readback
