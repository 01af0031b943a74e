#include "emit/model_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "emit/body.hpp"
#include "emit/parameters.hpp"
#include "support/check.hpp"

namespace jourdain::emit {

namespace {

using ir::LeafKind;
using programs::FunctionInfo;
using programs::Shape;

const std::set<std::string> kNamesOfModel = {"Scalar",
                                             "Time",
                                             "Parameters",
                                             "State",
                                             "Input",
                                             "Model",
                                             "Real",
                                             "position_count",
                                             "velocity_count",
                                             "input_count",
                                             "parameter_count",
                                             "output_count",
                                             "constraint_count",
                                             "least_regularity",
                                             "greatest_opening",
                                             "range_count",
                                             "loops_closed",
                                             "loops_proven",
                                             "Outputs",
                                             "parameters",
                                             "model",
                                             "Functions",
                                             "functions",
                                             "detail",
                                             "w",
                                             "RateHistory",
                                             "Accelerations",
                                             "Linearization"};

std::vector<std::string> constant_names(const programs::SceneFacts& scene, const ir::Program& constants) {
  Names names(kNamesOfModel);
  std::vector<std::string> list;
  for (const ir::Output& output : constants.outputs) {
    const ir::Node& node = constants[output.value];
    const std::string label =
        node.op == ir::Op::kLeaf ? scene.parameters[node.index].name : constants.labels[output.value.value];
    list.push_back(names.unique(label, fmt::format("c{}", list.size())));
  }
  return list;
}

/// The entry of `array` that an output says.
Expression entry(Expression array, const ir::Output& output) {
  if (output.row >= 0) array = array[output.row];
  return output.column >= 0 ? array[output.column] : array;
}

/// Velocities of bodies; g++ -O2 takes 0.5 (60 of a chain) to 0.8 (38 of TALOS) of the time for the whole file.
constexpr std::size_t kMostWrittenTwice = 24;

class CodeBuilder {
 public:
  CodeBuilder(const programs::SceneFacts& scene, const ir::Module& module)
      : scene_(scene), module_(module), constants_(constant_names(scene, module.constants)) {}

  const std::vector<std::string>& constants() const { return constants_; }

  CutFunction constructor() const {
    std::set<std::string> reserved(constants_.begin(), constants_.end());
    reserved.insert({"parameters", "w", "n", "Scalar", "position_count", "velocity_count", "input_count",
                     "parameter_count", "constraint_count"});
    const auto body = [&](const StoredValues& stored) {
      return body_of(
          module_.constants, Names(reserved), [this](LeafKind kind, std::size_t i) { return place(kind, i); },
          [this](const ir::Output& output, const Expression& value) {
            return set(name(constants_[static_cast<std::size_t>(output.row)]), value);
          },
          stored);
    };
    StoredValues members;
    for (const ir::Output& output : module_.constants.outputs)
      members[output.value] = constants_[static_cast<std::size_t>(output.row)];
    Body whole = body(members);
    if (whole.parts.size() > 1) whole = body({});  // parts are not members and cannot assign to them
    return cut({"constants", "", {{struct_type("Parameters"), "parameters"}}}, whole);
  }

  CutFunction of_program(const FunctionInfo& info) const {
    std::set<std::string> reserved = {"model",   "state",  "input", "zdot",   "h",      "w",
                                      "initial", "detail", "Real",  "closed", "result", info.result};
    for (const programs::ArrayResult& array : info.arrays) reserved.insert(array.name);
    if (info.shape == Shape::kArrays || info.shape == Shape::kLinearization || info.shape == Shape::kMatrix)
      reserved.insert({"i", "j"});
    if (info.shape == Shape::kSampling) reserved.insert("sampled");
    CutFunction made = cut(
        {info.name, "", parameters_of(info, scene_)},
        body_of(
            program(info), Names(reserved), [this](LeafKind kind, std::size_t i) { return place(kind, i); },
            [&](const ir::Output& output, const Expression& value) { return result(info, output, value); }));
    if (info.shape == Shape::kScalar) made.function.result = kRealType;
    Statements& body = made.function.body;
    for (const programs::ArrayResult& array : info.arrays)
      if (programs::has_entries(scene_, array)) clear(info, array, body);
    if (info.shape == Shape::kMatrix && is_mirrored()) body.push_back(mirror(name(info.result)));
    if (info.shape == Shape::kCorrection) frame_correction(body);
    if (info.shape == Shape::kSampling) frame_sampling(program(info), body);
    if (info.shape == Shape::kState) {
      frame_state(body);
      made.function.result = struct_type("State");
    }
    return made;
  }

 private:
  const ir::Program& program(const FunctionInfo& info) const {
    const ir::Program* found = ir::find_program(module_, info.name);
    JD_CHECK(found, "no program '{}'", info.name);
    return *found;
  }

  Expression place(LeafKind kind, std::size_t index) const {
    if (kind == LeafKind::kParameter) return name("parameters").dot(scene_.parameters[index].name);
    return kind == LeafKind::kConstant ? name("model").dot(constants_[index]) : place_of(kind, index);
  }

  Statement result(const FunctionInfo& info, const ir::Output& output, const Expression& value) const {
    switch (info.shape) {
      case Shape::kState:
        return set(entry(name("initial").dot(output.name), output), value);
      case Shape::kCorrection:
        return set(entry(name("closed").dot(output.name), output), value);
      case Shape::kSampling:
        return set(sampled(output), value);
      case Shape::kScalar:
        return {Return{value}};
      case Shape::kVector:
      case Shape::kRate:
        return set(name(info.result)[output.row], value);
      case Shape::kOutputs:
      case Shape::kLinearization:
        return set(entry(name("result").dot(output.name), output), value);
      case Shape::kArrays:
        return set(entry(name(output.name), output), value);
      case Shape::kMatrix: {
        const Expression M = name(info.result);
        if (output.row == output.column || is_mirrored()) return set(M[output.row][output.column], value);
        return {Set{{M[output.row][output.column], M[output.column][output.row]}, value}};
      }
      case Shape::kStep:
        break;
    }
    JD_CHECK(false, "{} has no outputs", info.name);
    return {Return{value}};
  }

  /// A loop copies the upper triangle into the lower one: compilers take much longer for thousands of stores.
  bool is_mirrored() const { return scene_.moving() > kMostWrittenTwice; }

  Statement mirror(const Expression& M) const {
    const Expression i = name("i"), j = name("j");
    return {Loop{"i", 1, scene_.velocities.size(), false, {Loop{"j", 0, i, false, {set(M[i][j], M[j][i])}}}}};
  }

  /// The function with the last part as its body, after calls of the others.
  static CutFunction cut(Function function, const Body& body) {
    CutFunction made{std::move(function)};
    if (body.work_size > 0 || body.parts.size() > 1)
      made.function.body.push_back({Declare{kRealType,
                                            Declare::Change::kFree,
                                            {{"w", {std::max<std::size_t>(body.work_size, 1)}}},
                                            "values that pass from part to part"}});
    for (std::size_t k = 0; k + 1 < body.parts.size(); ++k) {
      Function part{fmt::format("{}_{}", made.function.name, k + 1), "", {}, {}, body.parts[k]};
      Call call{part.name, {}, true};
      for (const Parameter& parameter : made.function.parameters) {
        if (!mentions(part.body, parameter.name)) continue;
        part.parameters.push_back(parameter);
        call.arguments.push_back(name(parameter.name));
      }
      part.parameters.push_back({kRealType, "w", Parameter::Access::kWrite, {}, true});
      call.arguments.push_back(name("w"));
      made.parts.push_back(std::move(part));
      made.function.body.push_back({call});
    }
    Statements& whole = made.function.body;
    whole.insert(whole.end(), body.parts.back().begin(), body.parts.back().end());
    return made;
  }

  /// Begins with zeros for an array of which the program does not write every entry.
  void clear(const FunctionInfo& info, const programs::ArrayResult& array, Statements& body) const {
    const std::vector<std::size_t> extents = extents_of(array, scene_);
    std::size_t entries = 1;
    for (const std::size_t extent : extents) entries *= extent;
    for (const ir::Output& output : program(info).outputs) entries -= output.name == array.name;
    if (entries == 0) return;
    const Expression target =
        info.shape == Shape::kLinearization ? name("result").dot(array.name) : name(array.name);
    const Expression row = target[name("i")];
    const Statement cleared =
        extents.size() == 1 ? set(row, 0.0) : loop("j", extents[1], {set(row[name("j")], 0.0)});
    body.insert(body.begin(), loop("i", extents[0], {cleared}));
  }

  static void frame_correction(Statements& body) {
    const Expression state = name("state"), closed = name("closed");
    body.insert(body.begin(),
                {Declare{struct_type("State"), Declare::Change::kFree, {{"closed", {}, state}}}});
    body.push_back(set(state, closed));
  }

  /// Where a state's value waits until all are known.
  Expression sampled(const ir::Output& output) const {
    return name("sampled")[static_cast<std::size_t>(output.row) - scene_.moving()];
  }

  void frame_sampling(const ir::Program& program, Statements& body) const {
    body.insert(body.begin(),
                {Declare{kRealType, Declare::Change::kFree, {{"sampled", {scene_.states.size()}}}}});
    for (const ir::Output& output : program.outputs)
      body.push_back(set(name("state").dot("z")[output.row], sampled(output)));
  }

  void frame_state(Statements& body) const {
    if (scene_.clock) body.insert(body.begin(), set(name("initial").dot("t"), 0.0));
    body.insert(body.begin(), {Declare{struct_type("State"), Declare::Change::kFree, {{"initial"}}}});
    body.push_back({Return{name("initial")}});
  }

  const programs::SceneFacts& scene_;
  const ir::Module& module_;
  std::vector<std::string> constants_;
};

}  // namespace

ModelCode model_code(const programs::SceneFacts& scene, const std::vector<FunctionInfo>& functions,
                     const ir::Module& module) {
  const CodeBuilder builder(scene, module);
  ModelCode code{builder.constants(),
                 builder.constructor(),
                 {},
                 step_support(scene, functions, module),
                 memory_structs(scene, functions)};
  for (const FunctionInfo& function : functions) {
    if (function.stepper) {
      code.functions.push_back({step_function(scene, function)});
      continue;
    }
    code.functions.push_back(builder.of_program(function));
    code.has_angle = code.has_angle || turns_with_time(*find_program(module, function.name));
  }
  return code;
}

}  // namespace jourdain::emit
