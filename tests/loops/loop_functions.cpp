#include "loops/loop_functions.hpp"

#include "loops/plan/plan.hpp"
#include "programs/loop_functions.hpp"

namespace jourdain::tests {

using ir::LeafKind;

namespace {

loops::LoopPlan planned(const model::Mechanism& mechanism) {
  support::Diagnostics diagnostics("model", "");
  const auto plan = loops::plan_loops(mechanism, diagnostics);
  JD_CHECK(plan, "{}", diagnostics.format());
  return *plan;
}

}  // namespace

LoopFunctions::LoopFunctions(const model::Mechanism& mechanism)
    : mechanism_(mechanism), plan_(planned(mechanism_)), closed_(mechanism_, {}, plan_) {}

std::vector<double> LoopFunctions::operator()(const std::string& function, const std::vector<double>& y,
                                              const std::vector<double>& z, const std::vector<double>& zdot,
                                              const std::vector<double>& u) const {
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kParameter] = model::default_values(mechanism_);
  leaves[LeafKind::kPosition] = y;
  leaves[LeafKind::kVelocity] = z;
  leaves[LeafKind::kAcceleration] = zdot;
  leaves[LeafKind::kInput] = u;
  leaves[LeafKind::kTime] = {0};
  return ir::interpret(closed_.program(*ir::function_named(function)), leaves);
}

std::vector<double> LoopFunctions::closed(const std::string& function, std::vector<double> y) const {
  const ir::Program program = closed_.program(*ir::function_named(function));
  const std::vector<double> values = (*this)(function, y, std::vector<double>(y.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (program.outputs[k].name == "y") y[static_cast<std::size_t>(program.outputs[k].row)] = values[k];
  return y;
}

}  // namespace jourdain::tests
