// The optimised programs of a mechanism with loops, computed in double.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "loops/record/loop_plan.hpp"
#include "properties/consistent_state.hpp"

namespace jourdain::tests {

/// Of one mechanism, at the parameters' default values.
class ClosedPrograms {
 public:
  explicit ClosedPrograms(const model::Mechanism& mechanism, bool with_linearization = false);

  const loops::LoopPlan& plan() const { return plan_; }
  const model::CoordinateLayout& layout() const { return layout_; }

  /// ż of the independent velocities; `state` is of the tree.
  reference::VectorX<long double> accelerations(const LoopState& state,
                                                const reference::VectorX<long double>& u) const;
  reference::VectorX<long double> multipliers(const LoopState& state,
                                              const reference::VectorX<long double>& u) const;

  /// Where rounding chooses the side of a kink, forces may jump.
  bool is_on_a_kink(const LoopState& state, const reference::VectorX<long double>& u) const;

  /// Arithmetic operations of an emitted function.
  std::size_t operations(const std::string& function) const;

  /// Outputs of an emitted function by name and subscripts, at y of the tree and z of the independent velocities.
  std::map<std::string, double> values(const std::string& function, double t, const std::vector<double>& y,
                                       const std::vector<double>& z, const std::vector<double>& u) const;

 private:
  std::vector<double> velocities(const LoopState& state) const;
  reference::VectorX<long double> vector(const std::string& function, const LoopState& state,
                                         const reference::VectorX<long double>& u) const;

  model::Mechanism mechanism_;
  model::CoordinateLayout layout_;
  loops::LoopPlan plan_;
  ir::Module module_;
};

/// Names of the models of models/ with loops.
std::vector<std::string> models_with_loops();

}  // namespace jourdain::tests
