// One frame's pose, velocity, acceleration and Jacobian, in the axes that its functions ask for.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/points.hpp"
#include "model/kinematic_function.hpp"

namespace jourdain::dynamics {

class FrameKinematics {
 public:
  /// Of the function's frame. Where quantities that need the rotation are asked for together they share it.
  FrameKinematics(const Scene& scene, const model::KinematicFunction& function);

  /// Arrays of one of the quantities of a frame but the operational inertia; `zdot` by entry of z. The acceleration
  /// that is asked for as a bias is that at `zdot` too.
  std::vector<KinematicValues> values(model::KinematicQuantity quantity, const std::vector<Ex>& zdot);

 private:
  /// Linear and angular, in the axes of the function.
  struct Six {
    Vector3 linear = kinematics::zero_vector(), angular = kinematics::zero_vector();
  };
  /// The axes of the result, in W of a link of the way.
  using Triad = std::array<Vector3, 3>;

  bool is_fixed() const { return pose_.link == kinematics::kGround; }
  Vector3 bind(const std::string& what, const Vector3& v) const;
  Vector3 to_frame(const Vector3& v_W, const std::string& what) const;
  Vector3 to_world(const Vector3& v_W, const std::string& what);
  const std::vector<Vector3>& carried(std::size_t row);
  kinematics::Matrix3 rotation();
  const std::vector<Triad>& triads();
  Vector3 resolved(std::size_t k, const Vector3& v_W, const std::string& what);

  Six world_velocity();
  Six own_velocity();
  Six velocity();
  Six acceleration(const std::vector<Ex>& zdot);
  Six at_world_origin(const Six& v, const std::string& what) const;
  std::vector<KinematicValues> imu(const std::vector<Ex>& zdot);
  std::vector<KinematicValues> jacobian();

  const Scene& scene_;
  std::string name_;
  model::Axes axes_;
  bool shares_rotation_ = false;  ///< all rows of the rotation are at hand
  kinematics::BodyPose pose_;
  PointPath path_;
  std::array<std::vector<Vector3>, 3> carried_;  ///< world axes in W of the links of the way
  std::vector<Triad> triads_;
};

}  // namespace jourdain::dynamics
