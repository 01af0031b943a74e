#include "report/conserved_energy.hpp"

namespace jourdain::report {

bool conserves_energy(const model::Mechanism& mechanism) {
  for (const model::Joint& joint : mechanism.joints) {
    if (!joint.spin_damping.is_zero()) return false;
    for (const model::Coordinate& c : joint.coordinates)
      if (!c.damping.is_zero() || !c.friction.is_zero() || c.motion) return false;
  }
  for (const model::Spring& spring : mechanism.springs)
    if (!spring.damping.is_zero() || (!spring.law.is_zero() && !spring.potential)) return false;
  return mechanism.loads.empty() && mechanism.coordinate_forces.empty();
}

}  // namespace jourdain::report
