// All variables of a scene with what other tools ask of each: the one table behind the emitted manifest and the C
// interface.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/mechanism.hpp"
#include "programs/scene_facts.hpp"

namespace jourdain::programs {

/// What a variable is to who steps the model. Within a role numbers are indexed as the emitted arrays are.
enum class Role {
  kTime,
  kPosition,      ///< entry of y
  kVelocity,      ///< entry of z
  kPositionRate,  ///< entry of dy/dt
  kAcceleration,  ///< entry of dz/dt
  kInput,         ///< entry of u
  kOutput,        ///< numbers of all outputs, in their order
  kParameter,     ///< tunable at run time
  kConstant       ///< baked into the emitted code
};

/// What its unit measures.
enum class Quantity {
  kTime,
  kAngle,
  kLength,
  kQuaternionPart,
  kQuaternionRate,
  kAngularVelocity,
  kVelocity,
  kAngularAcceleration,
  kAcceleration,
  kForce,
  kMoment,
  kMass,
  kInertia,
  kEnergy,
  kRotationMatrix,
  kOther  ///< what the description says, or does not say
};

struct Variable {
  std::string name;
  std::string description;
  std::string unit;  ///< "1" without dimension; empty: the description does not say
  Role role = Role::kConstant;
  Quantity quantity = Quantity::kOther;
  std::size_t index = 0;             ///< of its first number among those of its role
  int rows = 1, columns = 1;         ///< a vector has one column
  bool is_array = false;             ///< its numbers have subscripts
  std::vector<std::string> numbers;  ///< names of its numbers, row by row
  std::vector<double> start;         ///< at default parameters, row by row; empty: it follows from others
  std::optional<std::array<double, 2>> range = {};  ///< of values it may have; masses: none below 0
  std::optional<std::size_t> derivative_of = {};    ///< variable of the table whose rate it is
};

std::string_view role_name(Role role);              ///< "position_rate", …
std::string_view quantity_name(Quantity quantity);  ///< "quaternion_part", …

/// Time where states hold it, positions, velocities, their rates, inputs, outputs, parameters, constants. `facts` are
/// those of the mechanism, but for the variables.
std::vector<Variable> variables_of(const model::Mechanism& mechanism, const loops::LoopPlan* plan,
                                   const SceneFacts& facts);

}  // namespace jourdain::programs
