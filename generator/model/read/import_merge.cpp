#include "model/read/import_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "model/read/input_numbers.hpp"
#include "model/read/members.hpp"

namespace jourdain::model {

namespace {

using Kind = Variable::Kind;

template <class Named>
void prefix_names(std::vector<Named>& list, const std::string& prefix) {
  for (Named& element : list) element.name = prefix + element.name;
}

template <class A, class B>
std::optional<NameClash> clash(const char* what, const std::vector<A>& first, const std::vector<B>& second) {
  std::unordered_map<std::string_view, SourceRange> names;
  for (const A& element : first) names.emplace(element.name, element.where);
  for (const B& element : second) {
    const auto same = names.find(element.name);
    if (same != names.end())
      return NameClash{fmt::format("{} '{}'", what, support::shown(element.name)), same->second};
  }
  return {};
}

/// The frames that a description declares: not those that stand for a body or the world.
std::vector<Frame> declared_frames(const Mechanism& mechanism) {
  std::vector<Frame> frames = mechanism.frames;
  std::erase_if(frames, [](const Frame& frame) { return frame.where.line == 0; });
  return frames;
}

struct Named {
  std::string name;
  SourceRange where;
};

/// What expressions name beside frames: coordinates, inputs, states; an actuator may have the name of its coordinate.
std::vector<Named> signals(const Mechanism& mechanism) {
  std::vector<Named> names;
  for (const Joint& joint : mechanism.joints)
    for (const Coordinate& coordinate : joint.coordinates) names.push_back({coordinate.name, joint.where});
  for (const Actuator& actuator : mechanism.actuators) names.push_back({actuator.name, actuator.where});
  for (const Input& input : mechanism.inputs) names.push_back({input.name, input.where});
  for (const StateVariable& state : mechanism.states) names.push_back({state.name, state.where});
  return names;
}

std::vector<Named> all_parameters(const Mechanism& mechanism) {
  std::vector<Named> names;
  for (const Parameter& parameter : mechanism.parameters) names.push_back({parameter.name, parameter.where});
  for (const DerivedParameter& derived : mechanism.derived) names.push_back({derived.name, derived.where});
  return names;
}

template <class Element>
void append(std::vector<Element>& list, std::vector<Element>&& more) {
  std::move(more.begin(), more.end(), std::back_inserter(list));
}

/// What the indices of a part become in the mechanism that it is merged into.
class Renumber {
 public:
  Renumber(const Mechanism& mechanism, const Mechanism& part, const Merge& how)
      : file_(how.file),
        bodies_(mechanism.bodies.size()),
        joints_(mechanism.joints.size()),
        frames_(mechanism.frames.size()),
        actuators_(mechanism.actuators.size()),
        inputs_(mechanism.inputs.size()),
        states_(mechanism.states.size()),
        own_actuators_(part.actuators.size()) {
    std::size_t count = mechanism.parameters.size();
    for (const std::optional<Expression>& given : how.parameters)
      parameters_.push_back(given ? *given : Expression::parameter(ParameterIndex(count++)));
  }

  void operator()(BodyIndex& body) const { body = BodyIndex(body.value + bodies_); }
  void operator()(JointIndex& joint) const { joint = JointIndex(joint.value + joints_); }
  void operator()(FrameIndex& frame) const { frame = FrameIndex(frame.value + frames_); }
  void operator()(SourceRange& where) const {
    if (where.line > 0) where.file += file_;
  }

  void operator()(Expression& expression) {
    if (expression.is_constant()) return;
    std::size_t size = 0;
    for (const Expression::Node& node : expression.nodes())
      size += node.op == Expression::Op::kParameter ? parameters_[node.parameter.value].nodes().size() : 1;
    too_long_ = too_long_ || size > kMaximumExpressionSize;
    if (too_long_) return;
    // Variables first: what takes a parameter's place has none.
    expression =
        expression.substituted([this](const Variable& v) { return Expression::variable(renumbered(v)); })
            .with_parameters([this](ParameterIndex i) { return parameters_[i.value]; });
    // A product of itself with itself has two nodes, and the power of two of a long chain no room in any number.
    too_long_ = expression.has_no_variable() && expression.written_out_size() > kMaximumWrittenOutSize;
  }

  bool too_long() const { return too_long_; }

 private:
  Variable renumbered(Variable variable) const {
    switch (variable.kind) {
      case Kind::kTime:
      case Kind::kStepLength:
      case Kind::kArgument:
        break;
      case Kind::kPosition:
      case Kind::kVelocity:
        variable.index += joints_;
        break;
      case Kind::kInput:
        variable.index += actuators_ + (variable.index < own_actuators_ ? 0 : inputs_);
        break;
      case Kind::kState:
        variable.index += states_;
        break;
      case Kind::kFramePosition:
      case Kind::kFrameVelocity:
      case Kind::kFrameSpin:
      case Kind::kFrameWorldSpin:
      case Kind::kFrameDirection:
        variable.index += frames_;
        break;
    }
    return variable;
  }

  int file_;
  std::vector<Expression> parameters_;
  std::size_t bodies_, joints_, frames_, actuators_, inputs_, states_, own_actuators_;
  bool too_long_ = false;
};

}  // namespace

void add_prefix(Mechanism& mechanism, const std::string& prefix) {
  prefix_names(mechanism.parameters, prefix);
  prefix_names(mechanism.derived, prefix);
  prefix_names(mechanism.bodies, prefix);
  prefix_names(mechanism.joints, prefix);
  for (Joint& joint : mechanism.joints) prefix_names(joint.coordinates, prefix);
  for (Frame& frame : mechanism.frames)
    if (frame.name != "world") frame.name = prefix + frame.name;
  prefix_names(mechanism.inputs, prefix);
  prefix_names(mechanism.outputs, prefix);
  prefix_names(mechanism.kinematics, prefix);
  prefix_names(mechanism.loops, prefix);
  for_each_force_list(mechanism, [&prefix](auto& list) { prefix_names(list, prefix); });
  for (ImportedFile& imported : mechanism.imports) imported.prefix = prefix + imported.prefix;
}

std::optional<NameClash> name_clash(const Mechanism& mechanism, const Mechanism& part) {
  const std::vector<Frame> here = declared_frames(mechanism), there = declared_frames(part);
  const std::optional<NameClash> found[] = {
      clash("bodies", mechanism.bodies, part.bodies),
      clash("joints", mechanism.joints, part.joints),
      clash("frames", here, there),
      clash("frames or bodies", here, part.bodies),
      clash("frames or bodies", mechanism.bodies, there),
      clash("coordinates, inputs or states", signals(mechanism), signals(part)),
      clash("outputs", mechanism.outputs, part.outputs),
      clash("functions", mechanism.kinematics, part.kinematics),
      clash("loops", mechanism.loops, part.loops),
      clash("parameters", all_parameters(mechanism), all_parameters(part))};
  for (const std::optional<NameClash>& one : found)
    if (one) return one;
  return {};
}

bool merge(Mechanism& mechanism, Mechanism part, const Merge& how) {
  Renumber renumber(mechanism, part, how);
  Members(renumber).of(part);
  if (renumber.too_long()) return false;
  const std::size_t first_input = mechanism.actuators.size(), added = part.actuators.size();
  if (added > 0 && !mechanism.inputs.empty())
    replace_inputs(mechanism, [&](std::size_t input) {
      return Expression::variable({Kind::kInput, input < first_input ? input : input + added, 0});
    });
  for (std::size_t i = 0; i < part.parameters.size(); ++i)
    if (!how.parameters[i]) mechanism.parameters.push_back(std::move(part.parameters[i]));
  append(mechanism.derived, std::move(part.derived));
  append(mechanism.bodies, std::move(part.bodies));
  append(mechanism.joints, std::move(part.joints));
  append(mechanism.frames, std::move(part.frames));
  append(mechanism.inputs, std::move(part.inputs));
  append(mechanism.outputs, std::move(part.outputs));
  append(mechanism.kinematics, std::move(part.kinematics));
  append(mechanism.loops, std::move(part.loops));
  append(mechanism.grounds, std::move(part.grounds));
  for_each_force_list(mechanism, [&part](auto& list) {
    using Element = typename std::remove_reference_t<decltype(list)>::value_type;
    append(list, std::move(list_of<Element>(part)));
  });
  if (part.loop_options.where.line > 0) mechanism.loop_options = part.loop_options;
  for (ImportedFile& imported : part.imports) imported.file += how.file;
  append(mechanism.imports, std::move(part.imports));
  return true;
}

}  // namespace jourdain::model
