// What the finished files must say, as far as it does not come from programs: filled in by the compiler from
// the mechanism and its plan.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ir/module.hpp"
#include "ir/text_choices.hpp"
#include "support/called_function.hpp"
#include "support/files.hpp"

namespace jourdain::readback {

struct ExpectedParameter {
  std::string name;
  double value = 0;
  std::optional<std::array<double, 2>> range = {};
};

/// A member of an output; a scalar output has one without a name.
struct ExpectedMember {
  std::string name;
  int rows = 1, columns = 1;
  bool is_matrix = false;
};

struct ExpectedOutput {
  std::string name;
  std::vector<ExpectedMember> members;
};

struct ExpectedArray {
  std::string name;
  std::vector<std::size_t> extents;
};

/// A function of the kinematics and the arrays that it fills.
struct ExpectedKinematics {
  std::string name;
  bool takes_acceleration = false, takes_input = false;
  std::vector<ExpectedArray> arrays;
};

/// A position or parameter and the values that something is proven for.
struct ExpectedRange {
  std::size_t index = 0;
  double low = 0, high = 0;
};

/// An entry of y and the one of z that moves it: of a quaternion w and ω_x.
struct ExpectedTangent {
  std::size_t position = 0, velocity = 0;
};

/// A row of the table of variables, but for what it depends on, which follows from the programs.
struct ExpectedVariable {
  std::string name, role, quantity, unit, description;
  std::size_t index = 0;
  int rows = 1, columns = 1;
  bool is_array = false;
  std::vector<std::string> numbers;
  std::vector<double> start;
  std::optional<std::array<double, 2>> range = {};
  std::string derivative_of;  ///< empty: of nothing
};

struct Expected {
  const ir::Module* module = nullptr;
  ir::TextChoices choices;
  bool is_float = false;                    ///< of the files of C that are read: numbers are floats
  std::string name;                         ///< of namespace and files
  std::string title, path, sha256;          ///< of the description
  std::vector<support::FileHash> imported;  ///< files that it imports
  std::vector<std::string> options;         ///< of the command line
  std::vector<std::string> positions, velocities, inputs, constraints;  ///< names in order
  std::size_t states = 0;    ///< last entries of z, which displace nothing
  bool has_samples = false;  ///< some of them are sampled where a step begins
  std::vector<ExpectedParameter> parameters;
  std::vector<ExpectedVariable> variables;
  std::vector<ExpectedOutput> outputs;
  std::vector<ExpectedKinematics> kinematics;
  std::vector<ExpectedTangent> scalars, quaternions;  ///< of the independent coordinates
  bool is_reduced = false;                            ///< some velocities follow from others
  std::vector<std::size_t> dependents;                ///< entries of y that close_loops sets
  std::vector<std::size_t> carried;                   ///< entries of y whose velocities alone follow
  bool motions_take_inputs = false;                   ///< prescribed accelerations depend on inputs
  bool dynamics_depend_on_time = false, outputs_depend_on_time = false;
  bool clock = false;             ///< states hold the time
  bool rate_is_velocity = false;  ///< dy/dt = z
  bool all_derivatives = true;
  int closings = 1;  ///< calls of close_loops where dependent positions were not moved along
  double least_regularity = 0, greatest_opening = 0;
  std::vector<ExpectedRange> proven_positions, proven_parameters;
  std::vector<std::string> assumptions, left_out;  ///< sentences
  std::vector<std::string> sentences;              ///< all that the header says at its top
  double backward_error = 0, condition = 0;
  std::vector<std::string> functions;  ///< in the order of emission

  /// What programs call and the user defines, by its member's name.
  std::map<std::string, support::CalledFunction> user_functions() const;
};

}  // namespace jourdain::readback
