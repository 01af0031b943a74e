// Positions and rates of the links, as leaves y, z of free coordinates; prescribed ones as functions of t and of
// states.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kinematics/link_tree.hpp"
#include "kinematics/numbers.hpp"
#include "model/coordinates.hpp"

namespace jourdain::kinematics {

/// The symbols that the equations are functions of.
struct Leaves {
  std::vector<Ex> parameters, y, z, zdot, lambda, u;
  std::size_t first_state = 0;  ///< entry in z
  Ex t = 0, h = 0;

  Leaves(const model::Mechanism& mechanism, const model::CoordinateLayout& layout, Statements& statements);
};

/// Motion of a link relative to its parent.
struct LinkState {
  std::optional<std::size_t> entry;  ///< its (first) entry in z; none where the coordinate is prescribed
  Ex position = 0;  ///< turn, slide, screw: about or along the link's +z, that is sign·y; curve: y
  Ex rate = 0;
  Ex acceleration = 0;           ///< prescribed part
  std::array<Ex, 4> quaternion;  ///< ball, free: w x y z, child to joint frame
  Vector3 spin = zero_vector();  ///< ball, free: relative angular velocity, link axes
  Vector3 origin = zero_vector(), velocity = zero_vector();  ///< free: of the child's origin, inertial frame
  /// Curve: point, its derivative and its second derivative by the coordinate, joint frame.
  Vector3 place = zero_vector(), slope = zero_vector(), curvature = zero_vector();

  /// Entries in z of the link: one for a scalar coordinate, ω for a ball, v and ω for a free link.
  std::size_t column_count(const Link& link) const;
};

std::vector<LinkState> derive_link_states(const model::Mechanism& mechanism,
                                          const model::CoordinateLayout& layout, const LinkTree& tree,
                                          const Leaves& leaves, Statements& statements);

/// The same state of motion of a scalar coordinate as the model sees it, not signed along the link's axis.
Taylor coordinate_motion(const Link& link, const LinkState& state);

}  // namespace jourdain::kinematics
