#include "programs/functions.hpp"

#include <algorithm>
#include <set>

#include "model/kinematic_kinds.hpp"

namespace jourdain::programs {

using ir::FunctionId;
using ir::name_of;
using model::TimeDependence;

namespace {

/// Derivatives by positions are by small displacements, one per velocity; states have none.
constexpr const char* kByDisplacements =
    "\nBy y means by displacements, one per velocity: small rotations in body axes for quaternions.";
constexpr const char* kNoDisplacements = "States have no displacements: their columns by y are zero.";

constexpr Extent kZ = Extent::kVelocities, kY = Extent::kDisplaced, kX = Extent::kStates,
                 kU = Extent::kInputs, kO = Extent::kOutputs, kG = Extent::kConstraints;

/// A row for each function, in the order of emission.
std::vector<FunctionInfo> function_table() {
  return {
      {.id = FunctionId::kInitialState,
       .shape = Shape::kState,
       .comment = "The state that the model description starts from, at t = 0.",
       .comment_reduced =
           "It closes the loops at the parameters' default values; at others call close_loops.",
       .comment_multipliers =
           "It closes the loops at the parameters' default values; at others call project, several times."},
      {.id = FunctionId::kPositionRate,
       .shape = Shape::kRate,
       .result = "ydot",
       .comment = "dy/dt = Z(y) z: quaternions turn with half their product with the angular velocity, other "
                  "coordinates have their\nvelocity.",
       .comment_reduced = "Dependent positions move as the loops make them.",
       .comment_states = "States have no positions."},
      {.id = FunctionId::kMassMatrix,
       .shape = Shape::kMatrix,
       .result = "M",
       .comment =
           "Mass matrix M(y) of M zdot = k_bar - q_bar; symmetric positive definite, both triangles are "
           "filled.",
       .comment_states = "States have rows of a unit matrix."},
      {.id = FunctionId::kKBar,
       .result = "k",
       .holds_accelerations = true,
       .comment = "Inertia terms k_bar: Coriolis, centrifugal and those of prescribed motion; no gravity."},
      {.id = FunctionId::kQBar,
       .result = "q",
       .takes_input = true,
       .comment =
           "Applied forces q_bar: gravity, springs, dampers, loads, inputs. Sign as in M zdot = k_bar - "
           "q_bar:\na force that pushes a coordinate forward makes its entry negative.",
       .comment_states = "Entries of states are their rates, negative."},
      {.id = FunctionId::kForwardDynamics,
       .result = "zdot",
       .takes_input = true,
       .comment = "Accelerations zdot = M^-1 (k_bar - q_bar), rad/s^2 or m/s^2.",
       .comment_multipliers =
           "The loops add their forces: M zdot = k_bar - q_bar - G^T lambda, see constraint_forces.",
       .comment_states = "Entries of states are their rates."},
      {.id = FunctionId::kInverseDynamics,
       .result = "tau",
       .holds_accelerations = true,
       .takes_acceleration = true,
       .comment = "Generalized forces tau = M zdot - k_bar + q_bar at u = 0 that are missing for the given "
                  "accelerations\n`zdot`, N m or N.",
       .comment_multipliers = "The loops' forces -G^T lambda count as missing.",
       .comment_states = "Entries of states are zdot less their rates."},
      {.id = FunctionId::kKineticEnergy, .shape = Shape::kScalar, .comment = "Kinetic energy, J."},
      {.id = FunctionId::kPotentialEnergy,
       .shape = Shape::kScalar,
       .comment =
           "Potential energy of gravity (zero at the origin of the inertial frame) and of springs, J."},
      {.id = FunctionId::kOutputs,
       .shape = Shape::kOutputs,
       .takes_input = true,
       .comment = "The outputs that the model description asks for."},
      {.id = FunctionId::kSample,
       .shape = Shape::kSampling,
       .takes_input = true,
       .comment =
           "Sets the states that are sampled to what they are in the step of length h (s) that begins at "
           "this state.\nSteps begin with it."},
      {.id = FunctionId::kCloseLoops,
       .shape = Shape::kCorrection,
       .comment = "Sets the dependent positions to those that close the loops at state.t and the independent "
                  "positions, near\nwhere they are. Call it after changing a state; steps end with it."},
      {.id = FunctionId::kProject,
       .shape = Shape::kCorrection,
       .comment =
           "Moves positions and velocities to the nearest ones that the loops allow, to first "
           "order.\nCall it after changing a state, several times where that was far; steps end with it."},
      {.id = FunctionId::kConstraintResidual,
       .shape = Shape::kArrays,
       .comment =
           "How far the loops are open: g(y, t), zero where they are closed, in m (rows without a length: "
           "without unit),\nand its rate G z + g_t. Rows as in constraint_names.",
       .arrays = {{"g", {kG}}, {"g_rate", {kG}}}},
      {.id = FunctionId::kConstraintForces,
       .shape = Shape::kArrays,
       .takes_input = true,
       .comment =
           "Multipliers lambda of M zdot = k_bar - q_bar - G^T lambda over all coordinates of the tree; the "
           "force of the\nconstraints is -G^T lambda. N; N m for rows without a length.",
       .arrays = {{"lambda", {kG}}}},
      {.id = FunctionId::kResidual,
       .shape = Shape::kArrays,
       .takes_input = true,
       .takes_acceleration = true,
       .comment = "r = M zdot - k_bar + q_bar for the given accelerations and inputs, N m or N: zero where "
                  "they fit.",
       .comment_multipliers = "The loops' forces are added: M zdot - k_bar + q_bar + G^T lambda.",
       .comment_states = "Entries of states are zdot less their rates.",
       .on_request = true,
       .holds_derivatives = true,
       .arrays = {{"r", {kZ}}}},
      {.id = FunctionId::kResidualDerivatives,
       .shape = Shape::kArrays,
       .takes_input = true,
       .takes_acceleration = true,
       .comment = std::string("Mass matrix, and derivatives of the residual by y, z, u and t at fixed "
                              "accelerations.") +
                  kByDisplacements,
       .comment_states = kNoDisplacements,
       .on_request = true,
       .holds_derivatives = true,
       .arrays = {{"M", {kZ, kZ}},
                  {"r_y", {kZ, kY}},
                  {"r_z", {kZ, kZ}},
                  {"r_u", {kZ, kU}},
                  {"r_t", {kZ}, &TimeDependence::dynamics}}},
      {.id = FunctionId::kForwardDynamicsDerivatives,
       .shape = Shape::kArrays,
       .takes_input = true,
       .comment = std::string("Accelerations zdot and their derivatives by y and z.") + kByDisplacements,
       .comment_states = kNoDisplacements,
       .on_request = true,
       .holds_derivatives = true,
       .arrays = {{"zdot", {kZ}}, {"zdot_y", {kZ, kY}}, {"zdot_z", {kZ, kZ}}}},
      {.id = FunctionId::kLinearize,
       .shape = Shape::kLinearization,
       .takes_input = true,
       .comment = "Linearisation at a state and input, not only at an equilibrium; see Linearization.",
       .on_request = true,
       .holds_derivatives = true,
       .arrays = {{"A", {kX, kX}},
                  {"B", {kX, kU}},
                  {"C", {kO, kX}},
                  {"D", {kO, kU}},
                  {"rate_t", {kX}, &TimeDependence::dynamics},
                  {"output_t", {kO}, &TimeDependence::outputs}}},
  };
}

std::string number_word(int n) {
  static const char* const words[] = {"no", "One", "Two", "Three", "Four", "Five", "Six", "Seven"};
  return n < 8 ? words[n] : std::to_string(n);
}

FunctionInfo step_function(const Stepper& stepper) {
  FunctionInfo info;
  info.name = stepper.name + "_step";
  info.shape = Shape::kStep;
  info.takes_input = true;
  info.needs = {name_of(FunctionId::kPositionRate), name_of(FunctionId::kForwardDynamics),
                name_of(FunctionId::kSample)};
  if (stepper.implicit)
    info.needs.insert(info.needs.end(),
                      {name_of(FunctionId::kResidual), name_of(FunctionId::kResidualDerivatives)});
  info.needs.insert(info.needs.end(), {name_of(FunctionId::kCloseLoops), name_of(FunctionId::kProject)});
  for (const std::string& used : stepper.uses) info.needs.push_back(used + "_step");
  const std::string calls =
      number_word(stepper.evaluations) + " call" + (stepper.evaluations == 1 ? "" : "s") + " of ";
  info.comment =
      "One step of length h (s) with the " + stepper.comment + "; inputs are held over the step. " +
      (stepper.implicit ? calls + "residual, one of residual_derivatives." : calls + "forward_dynamics.");
  info.stepper = &stepper;
  return info;
}

Extent extent_of(model::ArrayExtent extent) {
  switch (extent) {
    case model::ArrayExtent::kThree:
      return Extent::kThree;
    case model::ArrayExtent::kSix:
      return Extent::kSix;
    case model::ArrayExtent::kVelocities:
      break;
  }
  return Extent::kVelocities;
}

ArrayResult array_result(const model::KinematicArray& array) {
  ArrayResult result{std::string(array.name), {}};
  for (const model::ArrayExtent extent : array.extents) result.extents.push_back(extent_of(extent));
  if (array.is_drift) result.only_if = &TimeDependence::drift;
  return result;
}

}  // namespace

std::size_t count(const SceneFacts& scene, Extent extent) {
  switch (extent) {
    case Extent::kVelocities:
      return scene.velocities.size();
    case Extent::kDisplaced:
      return scene.velocities.size() + scene.carried.size();
    case Extent::kStates:
      return scene.displacements() + scene.velocities.size();
    case Extent::kInputs:
      return scene.inputs.size();
    case Extent::kOutputs:
      return scene.output_numbers();
    case Extent::kConstraints:
      return scene.constraints.size();
    case Extent::kThree:
      return 3;
    case Extent::kSix:
      return 6;
  }
  return 0;
}

bool has_entries(const SceneFacts& scene, const ArrayResult& array) {
  return (!array.only_if || scene.time.*array.only_if) &&
         std::all_of(array.extents.begin(), array.extents.end(),
                     [&](Extent e) { return count(scene, e) > 0; });
}

const char* correction(const SceneFacts& scene) {
  if (scene.constraints.empty()) return "";
  return name_of(scene.is_reduced ? FunctionId::kCloseLoops : FunctionId::kProject);
}

const char* sampling(const SceneFacts& scene) {
  const bool any = std::any_of(scene.states.begin(), scene.states.end(),
                               [](const model::StateVariable& state) { return state.sampled.has_value(); });
  return any ? name_of(FunctionId::kSample) : "";
}

bool is_listed(const FunctionInfo& function) {
  return function.shape != Shape::kState && function.shape != Shape::kSampling &&
         function.shape != Shape::kStep;
}

const std::vector<FunctionInfo>& all_functions() {
  static const std::vector<FunctionInfo> functions = [] {
    std::vector<FunctionInfo> list = function_table();
    for (FunctionInfo& function : list) function.name = name_of(*function.id);
    for (const Stepper& stepper : all_steppers()) list.push_back(step_function(stepper));
    return list;
  }();
  return functions;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const FunctionInfo& function : all_functions()) names.push_back(function.name);
  return names;
}

std::vector<std::string> default_functions() {
  std::vector<std::string> names;
  for (const FunctionInfo& function : all_functions())
    if (function.stepper ? function.stepper->name == "rk4" : !function.on_request)
      names.push_back(function.name);
  return names;
}

bool takes_input(const FunctionInfo& function, const SceneFacts& scene) {
  return function.takes_input || (function.holds_accelerations && scene.motions_take_inputs);
}

std::string comment_of(const FunctionInfo& function, const SceneFacts& scene) {
  std::string comment = function.comment;
  const auto add = [&comment](const std::string& remark) {
    if (!remark.empty()) comment += "\n" + remark;
  };
  if (!scene.states.empty()) add(function.comment_states);
  const bool is_by_displacements =
      std::any_of(function.arrays.begin(), function.arrays.end(), [](const ArrayResult& array) {
        return std::find(array.extents.begin(), array.extents.end(), Extent::kDisplaced) !=
               array.extents.end();
      });
  if (is_by_displacements && !scene.carried.empty())
    add("The last columns by y are those of coordinates that are carried along: " + scene.carried_names() +
        ".");
  if (function.holds_accelerations && scene.motions_take_inputs)
    add("Inputs push nothing here: prescribed accelerations depend on them.");
  if (!scene.constraints.empty())
    add(scene.is_reduced ? function.comment_reduced : function.comment_multipliers);
  return comment;
}

bool has_function(const FunctionInfo& function, const SceneFacts& scene) {
  switch (function.shape) {
    case Shape::kState:
    case Shape::kScalar:
      return true;
    case Shape::kStep:
      return (function.stepper->history == 0 || !*sampling(scene)) &&
             function.stepper->order_with(scene.has_whole_derivatives()) > 0;
    case Shape::kVector:
    case Shape::kMatrix:
    case Shape::kLinearization:
      return !scene.velocities.empty();
    case Shape::kArrays:
      return std::any_of(function.arrays.begin(), function.arrays.end(),
                         [&](const ArrayResult& array) { return has_entries(scene, array); });
    case Shape::kRate:
      return scene.has_rate();
    case Shape::kCorrection:
      return function.name == correction(scene);
    case Shape::kSampling:
      return function.name == sampling(scene);
    case Shape::kOutputs:
      return !scene.outputs.empty();
  }
  return false;
}

std::vector<FunctionInfo> with_needed(const std::vector<std::string>& wanted, const SceneFacts& scene) {
  std::set<std::string> names(wanted.begin(), wanted.end());
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const FunctionInfo& function : all_functions())
      if (names.count(function.name)) names.insert(function.needs.begin(), function.needs.end());
  }
  std::vector<FunctionInfo> chosen;
  for (const FunctionInfo& function : all_functions())
    if (names.count(function.name) && has_function(function, scene)) {
      chosen.push_back(function);
      chosen.back().takes_input = takes_input(function, scene);
    }
  return chosen;
}

std::vector<FunctionInfo> kinematic_functions(const SceneFacts& scene) {
  std::vector<FunctionInfo> list;
  for (std::size_t k = 0; k < scene.kinematics.size(); ++k) {
    FunctionInfo info;
    info.name = scene.kinematics[k].name;
    info.shape = Shape::kArrays;
    info.comment = scene.kinematics[k].comment;
    info.kinematic = k;
    for (const model::KinematicQuantity quantity : scene.kinematics[k].quantities) {
      const model::QuantityRow& row = model::quantity_row(quantity);
      const bool given = row.takes_acceleration && !scene.velocities.empty();
      info.takes_acceleration = info.takes_acceleration || given;
      info.holds_accelerations = info.holds_accelerations || row.holds_accelerations;
      for (const model::KinematicArray& array : row.arrays) info.arrays.push_back(array_result(array));
    }
    info.takes_input = takes_input(info, scene);
    if (has_function(info, scene)) list.push_back(std::move(info));
  }
  return list;
}

}  // namespace jourdain::programs
