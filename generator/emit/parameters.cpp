#include "emit/parameters.hpp"

#include "support/check.hpp"

namespace jourdain::emit {

using programs::Shape;
using Access = Parameter::Access;

Type struct_type(const std::string& name) { return {Type::Kind::kStruct, name}; }

std::vector<std::size_t> extents_of(const programs::ArrayResult& array, const programs::SceneFacts& scene) {
  std::vector<std::size_t> extents;
  for (const programs::Extent extent : array.extents) extents.push_back(programs::count(scene, extent));
  return extents;
}

Expression place_of(ir::LeafKind kind, std::size_t index) {
  switch (kind) {
    case ir::LeafKind::kPosition:
      return name("state").dot("y")[index];
    case ir::LeafKind::kVelocity:
      return name("state").dot("z")[index];
    case ir::LeafKind::kAcceleration:
      return name("zdot")[index];
    case ir::LeafKind::kInput:
      return name("input").dot("u")[index];
    case ir::LeafKind::kTime:
      return name("state").dot("t");
    case ir::LeafKind::kStepLength:
      return name("h");
    case ir::LeafKind::kParameter:
    case ir::LeafKind::kConstant:
    case ir::LeafKind::kMultiplier:
    case ir::LeafKind::kHeld:
      break;
  }
  JD_CHECK(false, "a {} is no argument", ir::leaf_name(kind));
  return {};
}

std::vector<Parameter> parameters_of(const programs::FunctionInfo& function,
                                     const programs::SceneFacts& scene) {
  const std::size_t nz = scene.velocities.size();
  const bool step = function.shape == Shape::kStep, sampling = function.shape == Shape::kSampling;
  const auto array = [](const std::string& of, std::vector<std::size_t> extents) {
    return Parameter{kRealType, of, Access::kWrite, std::move(extents)};
  };
  std::vector<Parameter> list = {{struct_type("Model"), "model"}};
  if (function.shape == Shape::kState) return list;
  list.push_back({struct_type("State"), "state",
                  step || sampling || function.shape == Shape::kCorrection ? Access::kWrite : Access::kRead});
  if (function.takes_input)
    list.push_back(
        {struct_type("Input"), "input", Access::kRead, {}, false, step && nz > 0 && !scene.inputs.empty()});
  if (function.takes_acceleration) list.push_back({kRealType, "zdot", Access::kRead, {nz}});
  if (step || sampling) list.push_back({kRealType, "h", Access::kValue});
  if (step && function.stepper->history > 0)
    list.push_back(
        {{Type::Kind::kStruct, "RateHistory", false, function.stepper->history}, "history", Access::kWrite});
  if (step && function.stepper->implicit)
    list.push_back({struct_type("Accelerations"), "accelerations", Access::kWrite});
  switch (function.shape) {
    case Shape::kVector:
      list.push_back(array(function.result, {nz}));
      break;
    case Shape::kRate:
      list.push_back(array(function.result, {scene.positions.size()}));
      break;
    case Shape::kMatrix:
      list.push_back(array(function.result, {nz, nz}));
      break;
    case Shape::kOutputs:
    case Shape::kLinearization:
      list.push_back({struct_type(function.shape == Shape::kOutputs ? "Outputs" : "Linearization"), "result",
                      Access::kWrite});
      break;
    case Shape::kArrays:
      for (const programs::ArrayResult& result : function.arrays)
        if (programs::has_entries(scene, result))
          list.push_back(array(result.name, extents_of(result, scene)));
      break;
    case Shape::kState:
    case Shape::kScalar:
    case Shape::kCorrection:
    case Shape::kSampling:
    case Shape::kStep:
      break;
  }
  return list;
}

}  // namespace jourdain::emit
