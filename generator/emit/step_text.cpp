#include "emit/step_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "emit/implicit_step.hpp"
#include "emit/layout.hpp"
#include "emit/signature.hpp"
#include "emit/templates.hpp"

namespace jourdain::emit {

namespace {

constexpr const char* kInputAt = R"(
// Inputs at a stage: held over the step, or sampled there.
template <class Real>
const Input<Real>& input_at(const Input<Real>& held, const State<Real>&) noexcept {
  return held;
}
template <class Real, class InputAt>
Input<Real> input_at(const InputAt& sampled, const State<Real>& stage) noexcept {
  return sampled(stage);
}
)";

constexpr const char* kNormalise = R"(
template <class Real>
void normalise(Real* quaternion) noexcept {
  Real square = Real(0.0);
  for (int i = 0; i < 4; ++i) square = square + quaternion[i] * quaternion[i];
  const Real factor = Real(1.0) / square_root(square);
  for (int i = 0; i < 4; ++i) quaternion[i] = factor * quaternion[i];
}
)";

bool any_step(const std::vector<programs::FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [](const programs::FunctionInfo& f) { return f.shape == programs::Shape::kStep; });
}

bool moves_clock(const std::string& line) { return line.find(".t = ") != std::string::npos; }

/// The text of an explicit step, without its clock where states hold no time.
std::string explicit_body(const programs::SceneFacts& scene, const programs::FunctionInfo& function) {
  std::istringstream lines{std::string(template_text(function.name + ".in"))};
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (scene.clock || !moves_clock(line)) text += line + "\n";
  return text;
}

/// Operations that move the clock in an explicit step, with the products that say by how much.
long clock_operations(const programs::Stepper& stepper) {
  std::istringstream lines{std::string(template_text(stepper.name + "_step.in"))};
  long count = 0;
  for (std::string line; std::getline(lines, line);)
    if (moves_clock(line)) count += programs::kClockOperations + std::count(line.begin(), line.end(), '*');
  return count;
}

std::string body(const programs::SceneFacts& scene, const programs::FunctionInfo& function) {
  const std::string correction = programs::correction(scene);
  const std::string corrected = correction.empty() ? "" : fmt::format("  {}(model, state);\n", correction);
  if (scene.velocities.empty()) {
    std::string text = scene.clock ? "  state.t = state.t + h;\n" : "";
    for (int k = 0; k < scene.closings; ++k) text += corrected;
    return text;
  }
  if (const Rosenbrock* method = find_rosenbrock(function.stepper->name)) {
    std::string text = rosenbrock_body(scene, *method) + corrected;
    for (int k = 1; k < scene.closings && scene.is_reduced; ++k) text += corrected;
    return text;
  }
  std::string text = explicit_body(scene, function);
  for (const model::Tangent::Scalar& quaternion : scene.tangent.quaternions)
    text += fmt::format("  detail::normalise(state.y + {});\n", quaternion.position);
  return text + corrected;
}

}  // namespace

std::string step_support(const programs::SceneFacts& scene,
                         const std::vector<programs::FunctionInfo>& functions, const ir::Module& module) {
  const bool has_input = !scene.inputs.empty();
  if (!any_step(functions) || scene.velocities.empty()) return "";
  std::map<std::string, std::string> holes = {
      {"NY", fmt::format("{}", scene.positions.size())},
      {"NZ", fmt::format("{}", scene.velocities.size())},
      {"VELOCITIES", scene.has_rate()
                         ? "  position_rate(model, stage, ydot);\n"
                         : "  for (int i = 0; i < Model<Real>::position_count; ++i) ydot[i] = stage.z[i];\n"},
      {"TEMPLATE", has_input ? "template <class Real, class Inputs>" : "template <class Real>"},
      {"INPUTS", has_input ? "const Inputs&" : "const Input<Real>&"},
      {"INPUT", has_input ? "input_at(input, stage)" : "input"},
      {"VELOCITIES_MODEL", scene.has_rate() ? " model" : ""}};
  std::string text = has_input ? kInputAt : "";
  text += fill(template_text("rates.in"), holes);
  if (!scene.tangent.quaternions.empty()) text += kNormalise;
  return text +
         implicit_support(scene, functions, find_program(module, ir::FunctionId::kResidualDerivatives));
}

std::string history_struct(const programs::SceneFacts& scene,
                           const std::vector<programs::FunctionInfo>& functions) {
  const bool remembers = std::any_of(functions.begin(), functions.end(), [](const programs::FunctionInfo& f) {
    return f.stepper && f.stepper->history > 0;
  });
  std::string accelerations = accelerations_struct(scene, functions);
  if (!remembers) return accelerations;
  std::string text = wrapped_doc(
      "What a multistep method remembers: rates of y and z at the last `count` of `depth` steps, newest "
      "first. One "
      "trajectory and one step length have one; a fresh one starts anew.",
      0);
  text += "template <int depth, class Real = double>\nstruct RateHistory {\n  int count = 0;\n";
  if (!scene.velocities.empty())
    text += fmt::format("  Real ydot[depth][{}] = {{}};\n  Real zdot[depth][{}] = {{}};\n",
                        scene.positions.size(), scene.velocities.size());
  return text + "};\n\n" + accelerations;
}

std::string step_definitions(const programs::SceneFacts& scene, const programs::FunctionInfo& function) {
  const std::string text = body(scene, function);
  const bool sampled = !scene.inputs.empty() && !scene.velocities.empty();
  const std::string held = wrapped(signature(function, "Real", scene, sampled ? nullptr : &text) + " {", 0);
  if (!sampled) return "\ntemplate <class Real>\n" + held + text + "}\n";

  std::string general, call;
  for (Argument argument : arguments(function, "Real", scene)) {
    if (argument.name == "input") argument.type = "const InputAt&";
    general += (general.empty() ? "" : ", ") + argument.text(true);
    call += (call.empty() ? "" : ", ") + argument.name;
  }
  std::string definitions = fmt::format(
      "\n// `input` may be a function that gives the Input at the state of a stage.\n"
      "template <class Real, class InputAt>\n{}{}}}\n",
      wrapped(fmt::format("void {}({}) noexcept {{", function.name, general), 0), text);
  std::string named;
  for (const Argument& argument : arguments(function, "Real", scene))
    named += (named.empty() ? "" : ", ") + argument.text(true);
  definitions += "\ntemplate <class Real>\n" +
                 wrapped(fmt::format("void {}({}) noexcept {{", function.name, named), 0) +
                 wrapped(fmt::format("{}<Real, Input<Real>>({});", function.name, call), 2) + "}\n";
  return definitions;
}

long step_operations(const programs::SceneFacts& scene, const programs::Stepper& stepper,
                     const ir::Module& module) {
  const auto count = [&module](const auto& name) {
    const ir::Program* program = find_program(module, name);
    return program ? static_cast<long>(ir::count_operations(*program).arithmetic()) : 0;
  };
  const long correction = !scene.constraints.empty() ? count(programs::correction(scene)) : 0;
  if (scene.velocities.empty()) return scene.clock * programs::kClockOperations + scene.closings * correction;
  if (const Rosenbrock* method = find_rosenbrock(stepper.name))
    return correction * (1 + closings_of(scene, *method)) + count(ir::FunctionId::kResidualDerivatives) +
           stepper.evaluations * count(ir::FunctionId::kResidual) +
           rosenbrock_operations(scene, *method, *find_program(module, ir::FunctionId::kResidualDerivatives));
  const long entries = static_cast<long>(scene.positions.size() + scene.velocities.size());
  return correction +
         stepper.evaluations *
             (count(ir::FunctionId::kForwardDynamics) + count(ir::FunctionId::kPositionRate)) +
         stepper.fixed_operations + (scene.clock ? clock_operations(stepper) : 0) +
         stepper.entry_operations * entries +
         programs::kNormaliseOperations * static_cast<long>(scene.tangent.quaternions.size());
}

}  // namespace jourdain::emit
