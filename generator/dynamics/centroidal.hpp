// Centre of mass, momentum and their derivatives, of all bodies.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/scene.hpp"
#include "model/kinematic_function.hpp"

namespace jourdain::dynamics {

/// Regrouped mass parameters serve as well as those of the bodies: what was moved to a parent moves with both. What
/// went to the ground has no momentum, but it counts for the centre of mass.
class Centroidal {
 public:
  Centroidal(const Scene& scene, std::string name);

  /// Arrays of a quantity of the whole mechanism but gravity compensation; `zdot` by entry of z, for biases.
  std::vector<KinematicValues> values(model::KinematicQuantity quantity, const std::vector<Ex>& zdot);

 private:
  /// World axes in W of a link, and where its origin is from the centre of mass, in world axes.
  struct Place {
    std::array<Vector3, 3> axes;
    Vector3 arm;
  };

  Vector3 bind(const std::string& what, const Vector3& v) const;
  std::vector<std::size_t> roots() const;
  bool hangs_on_one_free_link() const;
  Ex mass();
  Vector3 per_mass(const Vector3& v);
  /// From the centre of mass to the origin of a root link, in the axes of its W.
  Vector3 arm(std::size_t root);
  Vector3 center_of_mass();
  Wrench about_center(std::size_t root, const Wrench& at_root, const std::string& what);
  Wrench rate(const std::vector<Ex>& zdot);
  Wrench momentum();
  void place_links();
  Vector3 in_world(const Place& place, const Vector3& v_W, const std::string& name) const;
  Wrench column_momentum(std::size_t link, std::size_t c);
  std::vector<KinematicValues> columns(const char* matrix, const char* drift, bool of_momentum);

  const Scene& scene_;
  std::string name_;
  std::optional<Vector3> center_;
  std::vector<Place> places_;  ///< by link
};

}  // namespace jourdain::dynamics
