#include "report/conserved_energy.hpp"

#include <algorithm>

#include "model/time_dependence.hpp"

namespace jourdain::report {

namespace {

/// Whether its force may work: what it keeps at zero is not zero at rest.
bool drives(const model::Loop& loop) {
  if (loop.type != model::LoopType::kVelocity) return false;
  return !loop.residual
              .substituted([](const model::Variable& variable) {
                return variable.is_rate() ? model::Expression(0.0) : model::Expression::variable(variable);
              })
              .is_zero();
}

}  // namespace

bool conserves_energy(const model::Mechanism& mechanism) {
  if (model::time_dependence(mechanism).positions || std::ranges::any_of(mechanism.loops, drives))
    return false;
  for (const model::Joint& joint : mechanism.joints) {
    if (!joint.spin_damping.is_zero()) return false;
    for (const model::Coordinate& c : joint.coordinates)
      if (!c.damping.is_zero() || !c.friction.is_zero() || c.motion) return false;
  }
  return !model::any_force_element(mechanism,
                                   [](const auto& element) { return !element.conserves_energy(); });
}

}  // namespace jourdain::report
