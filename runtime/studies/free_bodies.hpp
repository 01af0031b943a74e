// The same scene as equations of the first kind that the compiler takes: what a joint moves becomes a free
// body, the joint a loop.
#pragma once

#include <optional>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::studies {

/// Joints that move become free joints of their children and loops that multipliers close; fixed ones stay.
/// Torques and forces of actuators and viscous damping of revolute joints become loads on both bodies,
/// actuators inputs of their names, in the same order. Starts where `mechanism` does at the parameters'
/// default values. No outputs. Nothing where that cannot be said: other joints than revolute, prismatic,
/// cylindrical, universal (across), spherical and free ones; loops, prescribed motion, springs, friction and
/// rotors of coordinates, damping of others than revolute joints, loads and forces by expressions; bodies that
/// cannot move freely, for want of inertia.
std::optional<model::Mechanism> as_free_bodies(const model::Mechanism& mechanism);

/// y and z of `free`, a result of `as_free_bodies`, where its bodies are and move like these.
std::vector<double> free_state(const model::Mechanism& free, const std::vector<double>& parameters,
                               const std::vector<reference::AbsoluteBody<double>>& bodies);

}  // namespace jourdain::studies
