#include "dynamics/kinematic_functions.hpp"

#include <optional>

#include "dynamics/centroidal.hpp"
#include "dynamics/frame_kinematics.hpp"
#include "model/kinematic_kinds.hpp"

namespace jourdain::dynamics {

using model::KinematicQuantity;

namespace {

class OneFunction {
 public:
  OneFunction(const Scene& scene, const model::KinematicFunction& function,
              const std::function<std::vector<Ex>()>& gravity)
      : scene_(scene), gravity_(gravity), centroidal_(scene, "g" + function.name) {
    if (function.frame) frame_.emplace(scene, function);
  }

  std::vector<KinematicValues> values(KinematicQuantity quantity) {
    if (quantity == KinematicQuantity::kGravityCompensation) {
      const std::vector<Ex> tau = gravity_();
      return {{"tau_gravity", static_cast<int>(tau.size()), 0, tau}};
    }
    if (quantity == KinematicQuantity::kInverseOperationalInertia) return operational_jacobian();
    const std::vector<Ex> zdot = accelerations(quantity);
    return frame_ ? frame_->values(quantity, zdot) : centroidal_.values(quantity, zdot);
  }

 private:
  std::vector<KinematicValues> operational_jacobian() {
    std::vector<KinematicValues> arrays = frame_->values(KinematicQuantity::kJacobian, {});
    std::erase_if(arrays, [](const KinematicValues& array) { return array.name != "J"; });
    for (KinematicValues& array : arrays) array.name = kOperationalJacobian;
    return arrays;
  }

  std::vector<Ex> accelerations(KinematicQuantity quantity) const {
    const bool given = model::quantity_row(quantity).takes_acceleration || !scene_.mechanism.loops.empty();
    return given ? scene_.leaves.zdot : std::vector<Ex>(scene_.layout.velocity_count(), 0);
  }

  const Scene& scene_;
  const std::function<std::vector<Ex>()>& gravity_;
  Centroidal centroidal_;
  std::optional<FrameKinematics> frame_;
};

}  // namespace

std::vector<std::vector<KinematicValues>> derive_kinematic_functions(
    const Scene& scene, const std::function<std::vector<Ex>()>& gravity) {
  std::vector<std::vector<KinematicValues>> functions;
  for (const model::KinematicFunction& function : scene.mechanism.kinematics) {
    OneFunction one(scene, function, gravity);
    std::vector<KinematicValues>& arrays = functions.emplace_back();
    for (const KinematicQuantity quantity : function.quantities)
      for (KinematicValues& array : one.values(quantity)) arrays.push_back(std::move(array));
  }
  return functions;
}

}  // namespace jourdain::dynamics
