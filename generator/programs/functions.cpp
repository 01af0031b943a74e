#include "programs/functions.hpp"

#include <algorithm>
#include <set>

namespace jourdain::programs {

using model::TimeDependence;

namespace {

std::vector<FunctionInfo> computed_functions() {
  return {
      {"initial_state",
       Shape::kState,
       "",
       false,
       false,
       {},
       "The state that the model description starts from, at t = 0."},
      {"position_rate",
       Shape::kRate,
       "ydot",
       false,
       false,
       {},
       "dy/dt = Z(y) z: quaternions turn with half their product with the angular velocity, other "
       "coordinates have "
       "their\nvelocity."},
      {"mass_matrix",
       Shape::kMatrix,
       "M",
       false,
       false,
       {},
       "Mass matrix M(y) of M zdot = k_bar - q_bar; symmetric positive definite, both triangles are filled."},
      {"k_bar",
       Shape::kVector,
       "k",
       false,
       false,
       {},
       "Inertia terms k_bar: Coriolis, centrifugal and those of prescribed motion; no gravity."},
      {"q_bar",
       Shape::kVector,
       "q",
       true,
       false,
       {},
       "Applied forces q_bar: gravity, springs, dampers, loads, inputs. Sign as in M zdot = k_bar - q_bar:\n"
       "a force that pushes a coordinate forward makes its entry negative."},
      {"forward_dynamics",
       Shape::kVector,
       "zdot",
       true,
       false,
       {},
       "Accelerations zdot = M^-1 (k_bar - q_bar), rad/s^2 or m/s^2."},
      {"inverse_dynamics",
       Shape::kVector,
       "tau",
       false,
       true,
       {},
       "Generalized forces tau = M zdot - k_bar + q_bar at u = 0 that are missing for the given "
       "accelerations\n"
       "`zdot`, N m or N."},
      {"kinetic_energy", Shape::kScalar, "", false, false, {}, "Kinetic energy, J."},
      {"potential_energy",
       Shape::kScalar,
       "",
       false,
       false,
       {},
       "Potential energy of gravity (zero at the origin of the inertial frame) and of springs, J."},
      {"outputs", Shape::kOutputs, "", true, false, {}, "The outputs that the model description asks for."},
  };
}

FunctionInfo correction(const char* name, const char* comment) {
  FunctionInfo info;
  info.name = name;
  info.shape = Shape::kCorrection;
  info.comment = comment;
  return info;
}

FunctionInfo array_function(const std::string& name, bool takes_acceleration, std::vector<ArrayResult> arrays,
                            const std::string& comment) {
  FunctionInfo info;
  info.name = name;
  info.shape = Shape::kArrays;
  info.takes_input = true;
  info.takes_acceleration = takes_acceleration;
  info.comment = comment;
  info.on_request = info.holds_derivatives = true;
  info.arrays = std::move(arrays);
  return info;
}

/// Functions of derivatives. Positions are differentiated by small displacements, one per velocity.
std::vector<FunctionInfo> derivative_functions() {
  constexpr Extent z = Extent::kVelocities, x = Extent::kStates, u = Extent::kInputs, o = Extent::kOutputs;
  const std::string displacement =
      "\nBy y means by displacements, one per velocity: small rotations in body axes for quaternions.";
  std::vector<FunctionInfo> list = {
      array_function("residual", true, {{"r", {z}}},
                     "r = M zdot - k_bar + q_bar for the given accelerations and inputs, N m or N: zero "
                     "where they fit."),
      array_function("residual_derivatives", true,
                     {{"M", {z, z}},
                      {"r_y", {z, z}},
                      {"r_z", {z, z}},
                      {"r_u", {z, u}},
                      {"r_t", {z}, &TimeDependence::dynamics}},
                     "Mass matrix, and derivatives of the residual by y, z, u and t at fixed accelerations." +
                         displacement),
      array_function("forward_dynamics_derivatives", false,
                     {{"zdot", {z}}, {"zdot_y", {z, z}}, {"zdot_z", {z, z}}},
                     "Accelerations zdot and their derivatives by y and z." + displacement),
      array_function("linearize", false,
                     {{"A", {x, x}},
                      {"B", {x, u}},
                      {"C", {o, x}},
                      {"D", {o, u}},
                      {"rate_t", {x}, &TimeDependence::dynamics},
                      {"output_t", {o}, &TimeDependence::outputs}},
                     "Linearisation at a state and input, not only at an equilibrium; see Linearization."),
  };
  list.back().shape = Shape::kLinearization;
  return list;
}

/// Functions of mechanisms with loops.
std::vector<FunctionInfo> loop_functions() {
  std::vector<FunctionInfo> list = {
      correction("close_loops",
                 "Sets the dependent positions to those that close the loops at state.t and the independent "
                 "positions, near\nwhere they are. Call it after changing a state; steps end with it."),
      correction("project",
                 "Moves positions and velocities to the nearest ones that the loops allow, to first "
                 "order.\nCall it after changing a state, several times where that was far; steps end "
                 "with it."),
      array_function("constraint_residual", false,
                     {{"g", {Extent::kConstraints}}, {"g_rate", {Extent::kConstraints}}},
                     "How far the loops are open: g(y, t), zero where they are closed, in m (rows without a "
                     "length: without unit),\nand its rate G z + g_t. Rows as in constraint_names."),
      array_function("constraint_forces", false, {{"lambda", {Extent::kConstraints}}},
                     "Multipliers lambda of M zdot = k_bar - q_bar - G^T lambda over all coordinates of the "
                     "tree; the force of the\nconstraints is -G^T lambda. N; N m for rows without a length."),
  };
  list[2].takes_input = false;
  for (FunctionInfo& function : list) function.on_request = function.holds_derivatives = false;
  return list;
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
  info.needs = {"position_rate", "forward_dynamics"};
  if (stepper.implicit) info.needs.insert(info.needs.end(), {"residual", "residual_derivatives"});
  info.needs.insert(info.needs.end(), {"close_loops", "project"});
  for (const std::string& used : stepper.uses) info.needs.push_back(used + "_step");
  const std::string calls =
      number_word(stepper.evaluations) + " call" + (stepper.evaluations == 1 ? "" : "s") + " of ";
  info.comment =
      "One step of length h (s) with the " + stepper.comment + "; inputs are held over the step. " +
      (stepper.implicit ? calls + "residual, one of residual_derivatives." : calls + "forward_dynamics.");
  info.stepper = &stepper;
  return info;
}

}  // namespace

std::size_t SceneShape::count(Extent extent) const {
  switch (extent) {
    case Extent::kVelocities:
      return velocities;
    case Extent::kStates:
      return 2 * velocities;
    case Extent::kInputs:
      return inputs;
    case Extent::kOutputs:
      return output_numbers;
    case Extent::kConstraints:
      return constraints;
  }
  return 0;
}

bool SceneShape::has(const ArrayResult& array) const {
  return (!array.only_if || time.*array.only_if) &&
         std::all_of(array.extents.begin(), array.extents.end(), [this](Extent e) { return count(e) > 0; });
}

const std::vector<FunctionInfo>& all_functions() {
  static const std::vector<FunctionInfo> functions = [] {
    std::vector<FunctionInfo> list = computed_functions();
    for (const FunctionInfo& function : loop_functions()) list.push_back(function);
    for (const FunctionInfo& function : derivative_functions()) list.push_back(function);
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

std::string comment_of(const FunctionInfo& function, const SceneShape& shape) {
  struct Remark {
    const char* function;
    bool has_dependents;
    const char* text;
  };
  static const Remark remarks[] = {
      {"position_rate", true, "Dependent positions move as the loops make them."},
      {"forward_dynamics", false,
       "The loops add their forces: M zdot = k_bar - q_bar - G^T lambda, see constraint_forces."},
      {"inverse_dynamics", false, "The loops' forces -G^T lambda count as missing."},
      {"residual", false, "The loops' forces are added: M zdot - k_bar + q_bar + G^T lambda."}};
  std::string comment = function.comment;
  for (const Remark& remark : remarks)
    if (shape.constraints > 0 && function.name == remark.function &&
        shape.has_dependents == remark.has_dependents)
      comment += std::string("\n") + remark.text;
  return comment;
}

bool has_function(const FunctionInfo& function, const SceneShape& shape) {
  switch (function.shape) {
    case Shape::kState:
    case Shape::kScalar:
    case Shape::kStep:
      return true;
    case Shape::kVector:
    case Shape::kMatrix:
    case Shape::kLinearization:
      return shape.velocities > 0;
    case Shape::kArrays:
      return shape.has(function.arrays.front());
    case Shape::kRate:
      return shape.has_rate();
    case Shape::kCorrection:
      return function.name == shape.correction();
    case Shape::kOutputs:
      return shape.outputs > 0;
  }
  return false;
}

std::vector<FunctionInfo> with_needed(const std::vector<std::string>& wanted, const SceneShape& shape) {
  std::set<std::string> names(wanted.begin(), wanted.end());
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const FunctionInfo& function : all_functions())
      if (names.count(function.name)) names.insert(function.needs.begin(), function.needs.end());
  }
  std::vector<FunctionInfo> chosen;
  for (const FunctionInfo& function : all_functions())
    if (names.count(function.name) && has_function(function, shape)) chosen.push_back(function);
  return chosen;
}

}  // namespace jourdain::programs
