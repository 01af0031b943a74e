// [[spring]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/expression_functions.hpp"
#include "model/expression_sums.hpp"
#include "model/expression_taylor.hpp"
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
  if (spring.conserves_energy())
    spring.potential =
        plus(spring.potential.value_or(0.0), times(times(0.5, spring.stiffness), times(taut, taut)));
  else
    spring.potential.reset();
  spring.law = pulls ? plus(spring.law, force) : minus(spring.law, force);
  spring.stiffness = spring.damping = 0.0;
}

Taylor<double> at_length(const TomlFile& file, const Expression& function, double length) {
  return taylor_of<double>(function, file.values(), [length](const Variable& variable) {
    return variable.component == 0 ? Taylor<double>{length, 1, 0} : Taylor<double>{0, 0, 0};
  });
}

/// The slope of the potential is the tension at rest; looked at from short lengths to long ones.
void check_potential(TomlFile& file, const TomlTable& table, const Spring& spring) {
  constexpr double kShortest = 0.0137, kRatio = 1.37, kShare = 1e-3;
  constexpr int kLengths = 29;  // up to 92 m
  double largest = 0, worst = 0, where = 0, slope_there = 0, pull_there = 0;
  for (int k = 0; k < kLengths; ++k) {
    const double length = kShortest * std::pow(kRatio, k);
    const double slope = at_length(file, *spring.potential, length).first,
                 pull = at_length(file, spring.law, length).value;
    if (!std::isfinite(slope) || !std::isfinite(pull)) continue;
    const double size = std::max(std::fabs(slope), std::fabs(pull)), off = std::fabs(slope - pull);
    largest = std::max(largest, size);
    if (!(off > kShare * size) || !(off > worst)) continue;
    worst = off;
    where = length;
    slope_there = slope;
    pull_there = pull;
  }
  if (worst > kShare * kShare * largest)
    table.error("potential",
                fmt::format("{} is not that of the law: at a length of {:.3g} m it rises by {:.6g} N, the "
                            "law pulls with {:.6g} N",
                            table.quoted("potential"), where, slope_there, pull_there),
                "its derivative by length is the law at rest");
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
    const std::size_t mark = file.error_count();
    spring.stiffness = table.number("stiffness", needed::kStiffness);
    spring.damping = table.number("damping", needed::kDamping);
    spring.free_length = table.number("free_length", needed::kLength);
    spring.law = table.function("law", needed::kForce, spring_scope(true));
    if (table.has("potential")) {
      spring.potential = table.function("potential", needed::kEnergy, spring_scope(false));
      const bool is_known =
          !spring.law.calls(support::Function::kCall) && !spring.potential->calls(support::Function::kCall);
      if (file.error_count() == mark && is_known) check_potential(file, table, spring);
    }
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
