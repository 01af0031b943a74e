#include "emit/step_functions.hpp"

#include <algorithm>

#include "emit/explicit_step.hpp"
#include "emit/implicit_step.hpp"
#include "emit/parameters.hpp"

namespace jourdain::emit {

namespace {

using Access = Parameter::Access;

bool any_step(const std::vector<programs::FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [](const programs::FunctionInfo& f) { return f.shape == programs::Shape::kStep; });
}

/// At a stage.
Function accelerations(const programs::SceneFacts& scene) {
  const Expression model = name("model"), stage = name("stage"), zdot = name("zdot");
  return {kAccelerations,
          "",
          {{struct_type("Model"), "model"},
           {struct_type("State"), "stage"},
           {struct_type("Input"), "input", Access::kRead, {}, false, !scene.inputs.empty()},
           {kRealType, "zdot", Access::kWrite, {scene.velocities.size()}}},
          {},
          {{Call{"forward_dynamics", {model, stage, inputs_at(stage), zdot}}}}};
}

Function normalise() {
  const Expression quaternion = name("quaternion"), i = name("i"), square = name("square");
  return {"normalise",
          "",
          {{kRealType, "quaternion", Access::kWrite, {}, true}},
          {},
          {{Declare{kRealType, Declare::Change::kFree, {{"square", {}, 0.0}}}},
           loop("i", 4, {set(square, square + quaternion[i] * quaternion[i])}),
           constant("factor", 1.0 / square_root(square)),
           loop("i", 4, {set(quaternion[i], name("factor") * quaternion[i])})}};
}

Statements step_body(const programs::SceneFacts& scene, const programs::Stepper& stepper) {
  const Expression model = name("model"), state = name("state");
  const std::string correction = programs::correction(scene), sampling = programs::sampling(scene);
  Statements body;
  int corrections = 1;
  if (scene.velocities.empty()) {
    if (scene.clock) body.push_back(set(state.dot("t"), state.dot("t") + name("h")));
    corrections = scene.closings;
  } else if (const Rosenbrock* method = find_rosenbrock(stepper.name)) {
    body = rosenbrock_step(scene, *method);
    if (!scene.dependents.empty()) corrections = scene.closings;
  } else {
    body = explicit_step(stepper, scene);
    for (const model::Tangent::Scalar& quaternion : scene.tangent.quaternions)
      body.push_back({Call{"normalise", {state.dot("y").from(quaternion.position)}, true}});
  }
  if (!sampling.empty())
    body.insert(body.begin(), {Call{sampling, {model, state, inputs_at(state), name("h")}}});
  if (!correction.empty())
    for (int k = 0; k < corrections; ++k) body.push_back({Call{correction, {model, state}}});
  return body;
}

}  // namespace

Support step_support(const programs::SceneFacts& scene, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module) {
  if (!any_step(functions) || scene.velocities.empty()) return {};
  Support support{{}, {}, {accelerations(scene)}};
  if (!scene.tangent.quaternions.empty()) support.functions.push_back(normalise());
  const bool implicit = std::any_of(functions.begin(), functions.end(), [](const programs::FunctionInfo& f) {
    return f.stepper && f.stepper->implicit;
  });
  if (implicit)
    add_implicit_support(scene, *find_program(module, ir::FunctionId::kResidualDerivatives), support);
  return support;
}

Function step_function(const programs::SceneFacts& scene, const programs::FunctionInfo& function) {
  return {function.name, "", parameters_of(function, scene), {}, step_body(scene, *function.stepper)};
}

std::vector<Struct> memory_structs(const programs::SceneFacts& scene,
                                   const std::vector<programs::FunctionInfo>& functions) {
  const std::size_t ny = scene.positions.size(), nz = scene.velocities.size();
  bool history = false, implicit = false;
  for (const programs::FunctionInfo& f : functions) {
    history = history || (f.stepper && f.stepper->history > 0);
    implicit = implicit || (f.stepper && f.stepper->implicit);
  }
  const Members count{{{"count", {}, 0}}, kIntegerType};
  std::vector<Struct> structs;
  if (history) {
    structs.push_back(
        {"RateHistory",
         "What a multistep method remembers: rates of y and z at the last `count` of `depth` steps, newest "
         "first. One trajectory and one step length have one; a fresh one starts anew.",
         {count},
         true});
    if (nz > 0)
      for (const auto& [rates, entries] : {std::pair("ydot", ny), {"zdot", nz}})
        structs.back().members.push_back({{{rates, {name("depth"), entries}, 0.0}}});
  }
  if (implicit) {
    structs.push_back(
        {"Accelerations",
         "What linearly implicit methods remember: accelerations at the end of the last step. One trajectory "
         "has one; a fresh one starts from forward_dynamics.",
         {count}});
    structs.back().members[0].comment = "0: fresh";
    if (nz > 0) structs.back().members.push_back({{{"zdot", {nz}, 0.0}}});
  }
  return structs;
}

}  // namespace jourdain::emit
