// Where each joint's coordinates sit in y and z.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Entries of one joint in y and z. Prescribed coordinates have none.
struct JointEntries {
  std::size_t first_position = 0, position_count = 0;
  std::size_t first_velocity = 0, velocity_count = 0;
  /// For each scalar coordinate its entry in y, and in z.
  std::vector<std::optional<std::size_t>> position, velocity;
};

/// Small displacements, one per velocity but those of states: of a scalar coordinate or a position its change, of a
/// quaternion a small rotation δθ in body axes, δquat = ½ quat ⊗ (0, δθ).
struct Tangent {
  struct Scalar {
    std::size_t position = 0, velocity = 0;  ///< entry in y, and in z
  };
  std::vector<Scalar> scalars;
  std::vector<Scalar> quaternions;  ///< entry in y of w, and in z of ω_x
};

/// Coordinates joint by joint in the order of `depth_first`, each joint's in its own order: scalar coordinates that are
/// not prescribed; spherical: quaternion w x y z, and ω; free: position and quaternion, v and ω. Behind all joints' the
/// states, which are entries of z alone.
/// Inputs: those of the actuators, then `Mechanism::inputs`.
struct CoordinateLayout {
  std::vector<JointEntries> joints;  ///< by JointIndex
  std::vector<std::string> position_names, velocity_names, input_names;
  std::vector<std::size_t> quaternions;  ///< entry in y of each quaternion's w
  std::size_t state_count = 0;           ///< last entries of z, which have no position
  Tangent tangent;

  std::size_t position_count() const { return position_names.size(); }
  std::size_t velocity_count() const { return velocity_names.size(); }
  std::size_t first_state() const { return velocity_count() - state_count; }
  std::size_t input_count() const { return input_names.size(); }
};

CoordinateLayout lay_out_coordinates(const Mechanism& mechanism);

}  // namespace jourdain::model
