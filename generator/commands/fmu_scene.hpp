// A model as an FMU has it: every number a variable of its own, by reference.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "programs/variables.hpp"

namespace jourdain::commands {

enum class FmiVersion { k2, k3 };

/// One number of the table of variables. Its value reference is its place in the list.
struct FmuNumber {
  std::string name;  ///< no other number has it
  std::string description;
  std::string unit;  ///< as programs::Variable has it
  programs::Role role = programs::Role::kConstant;
  std::size_t index = 0;  ///< among the numbers of its role
  std::optional<double> start = {};
  std::optional<double> nominal = {};  ///< of states beside the mechanism
  std::optional<std::array<double, 2>> range = {};
  bool is_state = false;                          ///< a continuous state
  std::optional<std::size_t> derivative_of = {};  ///< reference of the continuous state whose rate it is
  /// References of the time, the continuous states and the inputs that it is computed from; none: not known.
  std::optional<std::vector<std::size_t>> depends_on = {};
};

struct FmuScene {
  std::string name;         ///< of files and functions
  std::string title;        ///< the model's own name
  std::string description;  ///< of the model; may be empty
  std::string generator;
  std::string method;  ///< of co-simulation
  double step = 0;     ///< s
  programs::SceneFacts facts;
  std::vector<FmuNumber> numbers;      ///< time, then those of the table in its order
  std::string correction;              ///< function that closes loops; empty: none
  bool has_derivatives = false;        ///< directional ones
  bool drifts = false;                 ///< a solver may leave the states that the mechanism can have
  std::vector<std::size_t> positions;  ///< entries of y that are continuous states, in order
};

/// Whether `linearize` gives the derivatives of the continuous states as they are: neither quaternions among them nor
/// loops that are held by multipliers.
bool has_fmu_derivatives(const programs::SceneFacts& facts);

/// Of a model that was compiled for an FMU; `method` is the stepper's name, `step` in s.
FmuScene fmu_scene(const model::Mechanism& mechanism, const CompileOptions& options,
                   const CompiledModel& compiled, const std::string& method, double step);

/// References of the continuous states, in order: positions, velocities.
std::vector<std::size_t> state_references(const FmuScene& scene);

}  // namespace jourdain::commands
