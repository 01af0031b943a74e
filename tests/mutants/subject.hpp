// A mechanism with everything that the compiler makes of it before emission, derived once: what faults are planted in.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "loops/record/loop_plan.hpp"

namespace jourdain::tests {

struct Subject {
  std::string name;
  model::Mechanism mechanism;
  std::optional<loops::LoopPlan> plan;  ///< where there are loops
  dynamics::Equations equations;
  ir::Module module;  ///< every function that holds a program, on request or not; optimised
};

/// How the loops of a mechanism are closed; none for trees.
std::optional<loops::LoopPlan> plan_of(const model::Mechanism& mechanism);

/// `treatment` and the other keys of [loops] as the mechanism has them.
Subject subject_of(const std::string& name, model::Mechanism mechanism);

/// Every program of `equations`, optimised. With loops `plan` says how.
ir::Module programs_of(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                       const std::optional<loops::LoopPlan>& plan);

/// Does the compiler refuse to write `module` for `mechanism` with these equations?
bool refuses(const model::Mechanism& mechanism, const dynamics::Equations& equations,
             const std::optional<loops::LoopPlan>& plan, const ir::Module& module);

/// The same where functions of derivatives are promised: with quaternions of unit length, with reduced
/// treatments of loops closed; to the rounding of doubles.
std::vector<ir::LeafValues<double>> lawful_states(const Subject& subject, std::size_t count);

/// Values of all leaves at seeded random states: anywhere for trees; with loops near the plan's start, open.
std::vector<ir::LeafValues<double>> random_states(const Subject& subject, std::size_t count);

}  // namespace jourdain::tests
