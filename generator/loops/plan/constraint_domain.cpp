#include "loops/plan/constraint_domain.hpp"

#include <fmt/format.h>

#include <optional>

#include "model/hidden_kinks.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::loops {

namespace {

using support::Interval;

model::ExpressionRanges declared_ranges(const model::Mechanism& mechanism) {
  model::ExpressionRanges ranges;
  for (const model::Parameter& parameter : mechanism.parameters)
    ranges.parameters.push_back(parameter.range ? Interval{(*parameter.range)[0], (*parameter.range)[1]}
                                                : Interval::point(parameter.value));
  ranges.variable = [&mechanism](const model::Variable& variable) {
    if (variable.kind != model::Variable::Kind::kPosition) return model::widest_range(variable);
    const auto& range = mechanism.joints[variable.index].coordinates[variable.component].range;
    return range ? Interval{(*range)[0], (*range)[1]} : model::widest_range(variable);
  };
  return ranges;
}

}  // namespace

std::string why_undefined(const model::Mechanism& mechanism, bool with_roots) {
  const model::ExpressionRanges ranges = declared_ranges(mechanism);
  for (const model::Loop& loop : mechanism.loops)
    if (const auto part = model::undefined_part(loop.residual, ranges, with_roots))
      return fmt::format("{} may have no value in the declared ranges: {}", model::in_words(loop),
                         model::in_words(*part));
  return "";
}

}  // namespace jourdain::loops
