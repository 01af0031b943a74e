// What each kind of force element does: one overload per kind, in the file that is named after it.
#pragma once

#include <string>
#include <vector>

#include "dynamics/points.hpp"

namespace jourdain::dynamics {

/// kZero: as if all inputs were zero.
enum class Inputs { kGiven, kZero };

/// Wrench of a force element on a body: about the origin of the body's link, in W (the inertial frame for a body that
/// is fixed to it).
struct BodyWrench {
  model::BodyIndex body;
  Wrench wrench;
};

struct AppliedForces {
  std::vector<Wrench> on_link;         ///< of loads, about the link's origin, in W
  std::vector<std::vector<Ex>> along;  ///< of all others, per link and column; positive pushes forward
  std::vector<BodyWrench> on_bodies;   ///< loads and elements between frames, body by body
  std::vector<Ex> on_states;           ///< rates of the states
};

/// Applied forces as they are added up.
struct ForceSum {
  ForceSum(const Scene& scene, Inputs inputs);

  void push(std::size_t link, std::size_t column, const Ex& force);
  /// A force and a moment at the end of a path, in W of its ancestor: their share along each column on the way, and the
  /// wrench on the end's link. Its other half acts at another path of the same ancestor.
  void act(const model::Frame& frame, const PointPath& path, const Wrench& wrench, const std::string& name);

  const Scene& scene;
  Inputs inputs;
  AppliedForces forces;
};

/// Value of an expression over time, coordinates, velocities, inputs, frames and states.
Ex general_value(const Scene& scene, const std::string& name, const model::Expression& expression,
                 Inputs inputs);

void add_forces(const model::Actuator& actuator, ForceSum& sum);
void add_forces(const model::CoordinateForce& force, ForceSum& sum);
void add_forces(const model::Spring& spring, ForceSum& sum);
void add_forces(const model::Load& load, ForceSum& sum);
void add_forces(const model::Bushing& bushing, ForceSum& sum);
void add_forces(const model::StateVariable& state, ForceSum& sum);

/// J; of a kind without potential zero.
Ex potential(const model::Spring& spring, const Scene& scene);
Ex potential(const model::Bushing& bushing, const Scene& scene);
inline Ex potential(const model::Actuator&, const Scene&) { return 0; }
inline Ex potential(const model::CoordinateForce&, const Scene&) { return 0; }
inline Ex potential(const model::Load&, const Scene&) { return 0; }
inline Ex potential(const model::StateVariable&, const Scene&) { return 0; }

}  // namespace jourdain::dynamics
