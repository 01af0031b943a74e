#include "emit/signature.hpp"

#include <fmt/format.h>

#include "emit/layout.hpp"

namespace jourdain::emit {

std::string Argument::text(bool named) const {
  if (!bounds.empty()) return fmt::format("{} (&{}){}", type, named ? name : "", bounds);
  return named ? type + " " + name : type;
}

std::string bounds_of(const programs::ArrayResult& array, const programs::SceneFacts& scene) {
  std::string bounds;
  for (const programs::Extent extent : array.extents)
    bounds += fmt::format("[{}]", programs::count(scene, extent));
  return bounds;
}

std::string argument_entry(ir::LeafKind kind, std::size_t index) {
  switch (kind) {
    case ir::LeafKind::kPosition:
      return fmt::format("state.y[{}]", index);
    case ir::LeafKind::kVelocity:
      return fmt::format("state.z[{}]", index);
    case ir::LeafKind::kAcceleration:
      return fmt::format("zdot[{}]", index);
    case ir::LeafKind::kInput:
      return fmt::format("input.u[{}]", index);
    case ir::LeafKind::kTime:
      return "state.t";
    case ir::LeafKind::kParameter:
    case ir::LeafKind::kConstant:
    case ir::LeafKind::kMultiplier:
      break;
  }
  JD_CHECK(false, "a {} is no argument", ir::leaf_name(kind));
  return "";
}

std::vector<Argument> arguments(const programs::FunctionInfo& function, const std::string& real,
                                const programs::SceneFacts& scene) {
  const std::size_t nz = scene.velocities.size();
  std::vector<Argument> list = {{fmt::format("const Model<{}>&", real), "model", ""}};
  if (function.shape == programs::Shape::kState) return list;
  const bool step = function.shape == programs::Shape::kStep;
  const bool changes = step || function.shape == programs::Shape::kCorrection;
  list.push_back({fmt::format("{}State<{}>&", changes ? "" : "const ", real), "state", ""});
  if (function.takes_input) list.push_back({fmt::format("const Input<{}>&", real), "input", ""});
  if (function.takes_acceleration) list.push_back({"const " + real, "zdot", fmt::format("[{}]", nz)});
  if (step) list.push_back({real, "h", ""});
  if (step && function.stepper->history > 0)
    list.push_back({fmt::format("RateHistory<{}, {}>&", function.stepper->history, real), "history", ""});
  if (step && function.stepper->implicit)
    list.push_back({fmt::format("Accelerations<{}>&", real), "accelerations", ""});
  if (function.shape == programs::Shape::kVector)
    list.push_back({real, function.result, fmt::format("[{}]", nz)});
  if (function.shape == programs::Shape::kRate)
    list.push_back({real, function.result, fmt::format("[{}]", scene.positions.size())});
  if (function.shape == programs::Shape::kOutputs)
    list.push_back({fmt::format("Outputs<{}>&", real), "result", ""});
  if (function.shape == programs::Shape::kMatrix)
    list.push_back({real, function.result, fmt::format("[{0}][{0}]", nz)});
  if (function.shape == programs::Shape::kLinearization)
    list.push_back({fmt::format("Linearization<{}>&", real), "result", ""});
  if (function.shape == programs::Shape::kArrays)
    for (const programs::ArrayResult& array : function.arrays)
      if (programs::has_entries(scene, array)) list.push_back({real, array.name, bounds_of(array, scene)});
  return list;
}

std::string signature(const programs::FunctionInfo& function, const std::string& real,
                      const programs::SceneFacts& scene, const std::string* body) {
  const std::string result = function.shape == programs::Shape::kState    ? fmt::format("State<{}> ", real)
                             : function.shape == programs::Shape::kScalar ? real + " "
                                                                          : "void ";
  std::string text;
  for (const Argument& argument : arguments(function, real, scene))
    text += (text.empty() ? "" : ", ") + argument.text(!body || mentions(*body, argument.name));
  return result + function.name + "(" + text + ") noexcept";
}

}  // namespace jourdain::emit
