// Arrays of functions of the kinematics in 77 digits, and which of their entries a program computes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "validate/programs.hpp"

namespace jourdain::validate {

/// By name; a vector is one column.
using KinematicArrays = std::map<std::string, ExactMatrix>;

KinematicArrays kinematic_arrays(const std::vector<dynamics::KinematicValues>& arrays,
                                 const dynamics::HighPrecision& exact);

/// The entries that are outputs of the program, in its order. One that the program leaves out and that is not zero
/// throws: emitted code would clear it.
std::vector<ScaledReal> entries_of(const ir::Program& program, const KinematicArrays& arrays);

}  // namespace jourdain::validate
