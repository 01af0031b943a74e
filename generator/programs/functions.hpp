// The functions that can be emitted, a row each in the table of functions.cpp; steps come from the list of steppers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ir/function_id.hpp"
#include "programs/scene_facts.hpp"
#include "programs/steppers.hpp"

namespace jourdain::programs {

enum class Shape {
  kState,          ///< returns a State
  kScalar,         ///< returns a Real
  kVector,         ///< fills Real (&)[nz]
  kRate,           ///< fills Real (&)[ny]
  kMatrix,         ///< fills Real (&)[nz][nz]
  kOutputs,        ///< fills an Outputs
  kArrays,         ///< fills several arrays
  kLinearization,  ///< fills a Linearization, whose members are the arrays
  kCorrection,     ///< replaces entries of a State
  kSampling,       ///< replaces entries of a State where a step begins: takes inputs and the step's length
  kStep            ///< advances a State; it calls other functions and has no program
};

/// How far a subscript runs.
enum class Extent {
  kVelocities,  ///< nz
  kDisplaced,   ///< nz, then what is carried along
  kStates,      ///< displacements and velocities
  kInputs,
  kOutputs,      ///< numbers of all outputs
  kConstraints,  ///< rows of all loops
  kThree,
  kSix,  ///< linear before angular
};

/// An array that a function fills; entries without an output of the program are zero.
struct ArrayResult {
  std::string name;
  std::vector<Extent> extents;
  bool model::TimeDependence::*only_if = nullptr;  ///< only where this depends on time
};

struct FunctionInfo {
  std::optional<ir::FunctionId> id = {};  ///< none: a step, or of the kinematics
  std::string name = {};
  Shape shape = Shape::kVector;
  std::string result = {};  ///< name of the array, and of the program's outputs
  bool takes_input = false;
  bool holds_accelerations = false;           ///< takes inputs where prescribed accelerations depend on them
  bool takes_acceleration = false;            ///< Real (&zdot)[nz]
  std::vector<std::string> needs = {};        ///< functions that its body calls
  std::string comment = {};                   ///< doc comment, lines separated by '\n'
  std::string comment_reduced = {};           ///< a line more where coordinates depend on others
  std::string comment_multipliers = {};       ///< a line more where loops are held by multipliers
  std::string comment_states = {};            ///< a line more where there are states
  const Stepper* stepper = nullptr;           ///< of a step
  std::optional<std::size_t> kinematic = {};  ///< in SceneFacts::kinematics
  bool on_request = false;                    ///< not emitted unless asked for or needed
  bool holds_derivatives = false;             ///< its program is not lowered from the equations alone
  std::vector<ArrayResult> arrays = {};       ///< kArrays, kLinearization
};

std::size_t count(const SceneFacts& scene, Extent extent);

/// Whether the array has entries.
bool has_entries(const SceneFacts& scene, const ArrayResult& array);

/// The function that brings a state back to the closed loops at the end of a step; empty for trees.
const char* correction(const SceneFacts& scene);

/// What a step begins with, "sample"; empty where no state is sampled.
const char* sampling(const SceneFacts& scene);

/// Whether tables of functions of an emitted model list it: it works on a state, and is no step or part of one.
bool is_listed(const FunctionInfo& function);

/// Whether the scene has the function: vectors and matrices of length zero are left out, the rate of the
/// positions where it is z, outputs where there are none.
bool has_function(const FunctionInfo& function, const SceneFacts& scene);

/// Whether it takes inputs there.
bool takes_input(const FunctionInfo& function, const SceneFacts& scene);

/// The function's comment, with what is different where loops are closed.
std::string comment_of(const FunctionInfo& function, const SceneFacts& scene);

/// In the order of emission.
const std::vector<FunctionInfo>& all_functions();

std::vector<std::string> function_names();

/// What is emitted unless the user says otherwise: all functions, and of the steps rk4_step.
std::vector<std::string> default_functions();

/// `wanted` with the functions they need, in the order of emission, as far as the scene has them.
std::vector<FunctionInfo> with_needed(const std::vector<std::string>& wanted, const SceneFacts& scene);

/// The scene's own functions of the kinematics, as asked for.
std::vector<FunctionInfo> kinematic_functions(const SceneFacts& scene);

}  // namespace jourdain::programs
