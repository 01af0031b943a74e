// What expressions call by a name of the description: tables, and functions that it defines.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/expression.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

struct Callable {
  /// Where value, slopes and curvature do not jump, though its expression may choose between pieces.
  enum class Smooth { kNowhere, kWithinEnds, kEverywhere };
  struct Argument {
    std::string name;
    Measure measure = Measure::open();
  };
  std::string_view kind;  ///< "table", "function"
  std::string name;
  std::vector<Argument> arguments;  ///< one at least
  Measure measure = Measure::open();
  /// Of as many expressions as there are arguments.
  std::function<Expression(std::span<const Expression>)> value;
  support::SourceRange where;
  Smooth smooth = Smooth::kNowhere;
  bool is_external =
      false;  ///< the user may define it: its name, and those of its derivatives, become members

  /// One is given: dimensions of expressions that call it are checked.
  bool has_units() const {
    return measure.is_anchored() || std::any_of(arguments.begin(), arguments.end(),
                                                [](const Argument& a) { return a.measure.is_anchored(); });
  }
};

/// `value` with these in place of its variables of Variable::Kind::kArgument, by number.
Expression with_arguments(const Expression& value, std::span<const Expression> arguments);

/// As `parse_expression`, where these may be called.
std::variant<MeasuredExpression, ExpressionError> parse_expression(
    std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope,
    const std::vector<Callable>& callables);

}  // namespace jourdain::model
