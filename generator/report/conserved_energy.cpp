#include "report/conserved_energy.hpp"

namespace jourdain::report {

bool conserves_energy(const model::Mechanism& mechanism) {
  for (const model::Joint& joint : mechanism.joints) {
    if (!joint.spin_damping.is_zero()) return false;
    for (const model::Coordinate& c : joint.coordinates)
      if (!c.damping.is_zero() || !c.friction.is_zero() || c.motion) return false;
  }
  return !model::any_force_element(mechanism,
                                   [](const auto& element) { return !element.conserves_energy(); });
}

}  // namespace jourdain::report
