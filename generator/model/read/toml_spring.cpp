// [[spring]]
#include <fmt/format.h>

#include "model/expression_functions.hpp"
#include "model/expression_sums.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Of a spring's length, and of its rate too where that is asked for.
Scope spring_scope(bool with_rate) {
  Scope scope = {{"length", {.kind = Variable::Kind::kArgument}, Measure::variable(needed::kLength)}};
  if (with_rate)
    scope.push_back(
        {"rate", {.kind = Variable::Kind::kArgument, .component = 1}, Measure::variable(needed::kSpeed)});
  return scope;
}

/// Makes stiffness and damping a law that never pushes, or never pulls: max(k e + c e′, 0) at a stretch e > 0, or at a
/// compression.
void make_one_sided(Spring& spring, bool pulls) {
  const Expression length = Expression::variable({.kind = Variable::Kind::kArgument}),
                   rate = Expression::variable({.kind = Variable::Kind::kArgument, .component = 1});
  const Expression stretch = pulls ? minus(length, spring.free_length) : minus(spring.free_length, length);
  const Expression growth = pulls ? rate : Expression::unary(Expression::Op::kNegate, rate);
  const Expression both = plus(times(spring.stiffness, stretch), times(spring.damping, growth));
  const Expression force =
      where_less(0.0, stretch, false, Expression::function(support::Function::kMax, both, 0.0), 0.0);
  const Expression taut = Expression::function(support::Function::kMax, stretch, 0.0);
  const bool conserves = spring.damping.is_zero() && (spring.law.is_zero() || spring.potential);
  if (conserves)
    spring.potential =
        plus(spring.potential.value_or(0.0), times(times(0.5, spring.stiffness), times(taut, taut)));
  else
    spring.potential.reset();
  spring.law = pulls ? plus(spring.law, force) : minus(spring.law, force);
  spring.stiffness = spring.damping = 0.0;
}

}  // namespace

void read_springs(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    Spring spring;
    spring.name = name_or_number(file, *node.as_table(), "spring", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("spring '{}'", shown(spring.name)),
                          file.range(node.source()), keys_of("spring"));
    const auto ends = find_ends(file, table, mechanism);
    spring.where = table.where("from");
    spring.stiffness = table.number("stiffness", needed::kStiffness);
    spring.damping = table.number("damping", needed::kDamping);
    spring.free_length = table.number("free_length", needed::kLength);
    spring.law = table.function("law", needed::kForce, spring_scope(true));
    if (table.has("potential"))
      spring.potential = table.function("potential", needed::kEnergy, spring_scope(false));
    const std::optional<std::size_t> acts = table.choice("acts", {"both ways", "pulling", "pushing"});
    if (acts.value_or(0) != 0 && !table.has("stiffness"))
      table.error("acts", fmt::format("{} has no 'stiffness'", table.what()),
                  "a law says itself where it acts");
    if (acts.value_or(0) != 0) make_one_sided(spring, acts == 1);
    if (!ends) continue;
    spring.from = ends->first;
    spring.to = ends->second;
    mechanism.springs.push_back(spring);
  }
}

}  // namespace jourdain::model
