#include "to_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <vector>

#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;

class Writer {
 public:
  explicit Writer(const model::Mechanism& mechanism) : mechanism_(mechanism) {}

  std::string run() {
    text_ =
        fmt::format("[model]\nname = \"{}\"\ngravity = {}\n", mechanism_.name, vector(mechanism_.gravity));
    if (!mechanism_.parameters.empty()) text_ += "\n[parameters]\n";
    for (const model::Parameter& parameter : mechanism_.parameters)
      text_ += fmt::format("{} = {}\n", parameter.name, parameter_text(parameter));
    for (const model::Body& body : mechanism_.bodies) add(body);
    for (const model::Joint& joint : mechanism_.joints) add(joint);
    add_frames();
    for_each_force_element(mechanism_, [this](const auto& element) { add(element); });
    for (const model::Loop& loop : mechanism_.loops) add(loop);
    if (!mechanism_.loops.empty()) add(mechanism_.loop_options);
    for (const model::Output& output : mechanism_.outputs) add(output);
    return text_;
  }

 private:
  static std::string number(double value) {
    const std::string digits = fmt::format("{}", value);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
  }

  static std::string parameter_text(const model::Parameter& parameter) {
    if (!parameter.range) return number(parameter.value);
    return fmt::format("{{ value = {}, range = [{}, {}] }}", number(parameter.value),
                       number((*parameter.range)[0]), number((*parameter.range)[1]));
  }

  std::string infix(const Expression& expression, std::size_t index) const {
    const Expression::Node& node = expression.nodes()[index];
    const auto side = [&](std::size_t operand) { return infix(expression, operand); };
    switch (node.op) {
      case Expression::Op::kLiteral:
        return fmt::format("({})", number(node.value));
      case Expression::Op::kParameter:
        return mechanism_.parameters[node.parameter.value].name;
      case Expression::Op::kVariable:
        return variable(node.variable);
      case Expression::Op::kNegate:
        return fmt::format("(-{})", side(node.left));
      case Expression::Op::kAdd:
        return fmt::format("({} + {})", side(node.left), side(node.right));
      case Expression::Op::kSubtract:
        return fmt::format("({} - {})", side(node.left), side(node.right));
      case Expression::Op::kMultiply:
        return fmt::format("({} * {})", side(node.left), side(node.right));
      case Expression::Op::kDivide:
        return fmt::format("({} / {})", side(node.left), side(node.right));
      case Expression::Op::kPower:
        return fmt::format("({}^({}))", side(node.left), node.exponent);
      case Expression::Op::kSqrt:
        return fmt::format("sqrt({})", side(node.left));
      case Expression::Op::kSin:
        return fmt::format("sin({})", side(node.left));
      case Expression::Op::kCos:
        return fmt::format("cos({})", side(node.left));
      case Expression::Op::kFunction:
        return call(node.function, side(node.left), side(node.right));
    }
    return "";
  }

  static std::string call(support::Function function, const std::string& a, const std::string& b) {
    if (function == support::Function::kWhereNegative) return fmt::format("if({} < 0, {}, 0)", a, b);
    if (function == support::Function::kWhereNotNegative) return fmt::format("if({} < 0, 0, {})", a, b);
    const support::FunctionFacts& facts = support::facts_of(function);
    return facts.operands == 1 ? fmt::format("{}({})", facts.name, a)
                               : fmt::format("{}({}, {})", facts.name, a, b);
  }

  std::string variable(const model::Variable& v) const {
    using Kind = model::Variable::Kind;
    constexpr const char* kAxes[] = {"x", "y", "z"};
    switch (v.kind) {
      case Kind::kTime:
        return "t";
      case Kind::kPosition:
      case Kind::kVelocity:
        return mechanism_.joints[v.index].coordinates[v.component].name +
               (v.kind == Kind::kVelocity ? ".rate" : "");
      case Kind::kInput:
        return v.index < mechanism_.actuators.size()
                   ? mechanism_.actuators[v.index].name
                   : mechanism_.inputs[v.index - mechanism_.actuators.size()].name;
      case Kind::kFramePosition:
        return fmt::format("{}.{}", mechanism_.frames[v.index].name, kAxes[v.component]);
      case Kind::kFrameVelocity:
        return fmt::format("{}.v{}", mechanism_.frames[v.index].name, kAxes[v.component]);
      case Kind::kFrameSpin:
        return fmt::format("{}.w{}", mechanism_.frames[v.index].name, kAxes[v.component]);
      case Kind::kFrameWorldSpin:
        return fmt::format("{}.world_w{}", mechanism_.frames[v.index].name, kAxes[v.component]);
      case Kind::kFrameDirection:
        return fmt::format("{}.R_{}{}", mechanism_.frames[v.index].name, kAxes[v.component / 3],
                           kAxes[v.component % 3]);
      case Kind::kState:
        return mechanism_.states[v.index].name;
      case Kind::kStepLength:
        return "no name";
      case Kind::kArgument:
        return arguments_[v.component];
    }
    return "";
  }

  std::string value(const Expression& expression) const {
    if (expression.is_constant()) return number(expression.constant());
    return fmt::format("\"{}\"", infix(expression, expression.nodes().size() - 1));
  }

  std::string vector(const model::Vector3& v) const {
    return fmt::format("[{}, {}, {}]", value(v[0]), value(v[1]), value(v[2]));
  }

  void add(const model::StateVariable& state) {
    text_ += state.sampled
                 ? fmt::format("\n[[memory]]\nname = \"{}\"\nperiod = 0\nupdate = {}\ninitial = {}\n",
                               state.name, value(*state.sampled), value(state.initial))
                 : fmt::format("\n[[state]]\nname = \"{}\"\nrate = {}\ninitial = {}\n", state.name,
                               value(state.rate), value(state.initial));
    if (!state.unit.empty()) text_ += fmt::format("unit = \"{}\"\n", state.unit);
  }

  void add(const model::Body& body) {
    const model::Inertia& I = body.inertia;
    text_ += fmt::format("\n[[body]]\nname = \"{}\"\nmass = {}\ncenter_of_mass = {}\n", body.name,
                         value(body.mass), vector(body.center_of_mass));
    text_ += fmt::format("inertia = {{ xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {} }}\n",
                         value(I.xx), value(I.yy), value(I.zz), value(I.xy), value(I.xz), value(I.yz));
    text_ += fmt::format("inertia_rpy = {}\ninertia_at = \"{}\"\ninertia_kind = \"{}\"\n",
                         vector(body.inertia_axes.rpy),
                         body.inertia_point == model::InertiaPoint::kOrigin ? "origin" : "center_of_mass",
                         body.lumped ? "lumped" : "rigid");
  }

  static std::string axis(const char* key, const std::array<double, 3>& a) {
    return fmt::format("{} = [{}, {}, {}]\n", key, number(a[0]), number(a[1]), number(a[2]));
  }

  std::string own_key(const model::Joint& joint, std::string_view key) {
    if (key == "axis") return axis("axis", joint.axis);
    if (key == "second_axis") return axis("second_axis", joint.second_axis);
    if (key == "pitch") return fmt::format("pitch = {}\n", value(joint.pitch));
    if (key == "curve") return fmt::format("curve = {}\n", with({"s"}, joint.curve));
    if (key == "sequence") return fmt::format("sequence = \"{}\"\n", model::sequence_text(joint));
    if (key == "damping") return fmt::format("damping = {}\n", value(joint.spin_damping));
    if (key == "initial_position")
      return fmt::format("initial_position = {}\n", vector(joint.initial_origin));
    if (key == "initial_velocity")
      return fmt::format("initial_velocity = {}\n", vector(joint.initial_origin_velocity));
    if (key == "initial_angular_velocity")
      return fmt::format("initial_angular_velocity = {}\n", vector(joint.initial_spin));
    JD_CHECK(key == "initial_orientation", "no words for the key '{}' of a joint", key);
    const auto& q = joint.initial_orientation;
    return fmt::format("initial_orientation = [{}, {}, {}, {}]\n", value(q[0]), value(q[1]), value(q[2]),
                       value(q[3]));
  }

  void add(const model::Joint& joint) {
    const model::JointKind& kind = model::joint_kind(joint);
    text_ += fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                         joint.name, kind.name,
                         joint.parent ? mechanism_.bodies[joint.parent->value].name : "world",
                         mechanism_.bodies[joint.child.value].name);
    if (!kind.has_origin())
      text_ += fmt::format("position = {}\nrpy = {}\n", vector(joint.placement.position),
                           vector(joint.placement.rotation.rpy));
    for (const std::string_view key : kind.keys) text_ += own_key(joint, key);
    const std::span<const model::JointMotion> kinds = kind.coordinates();
    for (std::size_t c = 0; c < kinds.size(); ++c)
      if (kinds.size() == 1)
        text_ += element(joint.coordinates[c], "\n") + "\n";
      else
        text_ += fmt::format("{} = {{ {} }}\n", kinds[c].suffix, element(joint.coordinates[c], ", "));
  }

  std::string element(const model::Coordinate& c, const char* separator) const {
    std::string text = fmt::format(
        "stiffness = {1}{0}rest = {2}{0}damping = {3}{0}friction = {4}{0}friction_speed = {5}", separator,
        value(c.stiffness), value(c.rest), value(c.damping), value(c.friction), value(c.friction_speed));
    if (c.motion) return text + fmt::format("{}motion = {}", separator, value(*c.motion));
    if (c.range)
      text += fmt::format("{}range = [{}, {}]", separator, number((*c.range)[0]), number((*c.range)[1]));
    return text + fmt::format("{0}initial_position = {1}{0}initial_velocity = {2}", separator,
                              value(c.initial_position), value(c.initial_velocity));
  }

  /// A vector or value of functions of named arguments.
  template <class Functions>
  std::string with(std::vector<std::string> arguments, const Functions& functions) {
    arguments_ = std::move(arguments);
    if constexpr (std::is_same_v<Functions, Expression>)
      return value(functions);
    else
      return vector(functions);
  }

  std::string coordinate(model::JointIndex joint, std::size_t which) const {
    const model::Joint& j = mechanism_.joints[joint.value];
    const std::span<const model::JointMotion> kinds = model::joint_kind(j).coordinates();
    return fmt::format("joint = \"{}\"\n", j.name) +
           (kinds.size() > 1 ? fmt::format("coordinate = \"{}\"\n", kinds[which].suffix) : "");
  }

  const std::string& frame(model::FrameIndex index) const { return mechanism_.frames[index.value].name; }

  /// A frame that stands for a body or the world is not declared.
  bool is_body(const std::string& name) const {
    return name == "world" || std::any_of(mechanism_.bodies.begin(), mechanism_.bodies.end(),
                                          [&](const model::Body& body) { return body.name == name; });
  }

  void add_frames() {
    for (const model::Frame& f : mechanism_.frames)
      if (!is_body(f.name))
        text_ += fmt::format("\n[[frame]]\nname = \"{}\"\nbody = \"{}\"\nposition = {}\nrpy = {}\n", f.name,
                             f.body ? mechanism_.bodies[f.body->value].name : "world",
                             vector(f.placement.position), vector(f.placement.rotation.rpy));
    for (const model::Input& input : mechanism_.inputs)
      text_ += fmt::format("\n[[input]]\nname = \"{}\"\n", input.name);
  }

  void add(const model::Actuator& actuator) {
    text_ += fmt::format("\n[[actuator]]\nname = \"{}\"\n{}gear_ratio = {}\nrotor_inertia = {}\n",
                         actuator.name, coordinate(actuator.joint, actuator.coordinate),
                         value(actuator.gear_ratio), value(actuator.rotor_inertia));
  }

  void add(const model::Load& load) {
    text_ +=
        fmt::format("\n[[force]]\nname = \"{}\"\nframe = \"{}\"\nforce = {}\nmoment = {}\naxes = \"{}\"\n",
                    load.name, frame(load.frame), vector(load.force), vector(load.moment),
                    load.axes == model::LoadAxes::kFrame ? "frame" : "world");
  }

  void add(const model::CoordinateForce& force) {
    text_ += fmt::format("\n[[force]]\nname = \"{}\"\n{}value = {}\n", force.name,
                         coordinate(force.joint, force.coordinate), value(force.force));
  }

  void add(const model::Spring& spring) {
    text_ += fmt::format(
        "\n[[spring]]\nname = \"{}\"\nfrom = \"{}\"\nto = \"{}\"\nstiffness = {}\ndamping = {}\n"
        "free_length = {}\nlaw = {}\n",
        spring.name, frame(spring.from), frame(spring.to), value(spring.stiffness), value(spring.damping),
        value(spring.free_length), with({"length", "rate"}, spring.law));
    if (spring.potential) text_ += fmt::format("potential = {}\n", with({"length"}, *spring.potential));
  }

  void add(const model::Bushing& bushing) {
    text_ += fmt::format(
        "\n[[bushing]]\nname = \"{}\"\nfrom = \"{}\"\nto = \"{}\"\nstiffness = {}\ndamping = {}\n"
        "torsional_stiffness = {}\ntorsional_damping = {}\n",
        bushing.name, frame(bushing.from), frame(bushing.to), vector(bushing.stiffness),
        vector(bushing.damping), vector(bushing.torsional_stiffness), vector(bushing.torsional_damping));
  }

  void add(const model::Loop& loop) {
    const model::LoopKind& kind = model::loop_kind(loop);
    text_ += fmt::format("\n[[{}]]\nname = \"{}\"\ntype = \"{}\"\n",
                         kind.is_constraint() ? "constraint" : "loop", loop.name, kind.name);
    for (const std::string_view key : kind.keys)
      text_ += kind.is_constraint() ? key_of_constraint(loop, key) : own_key(loop, key);
  }

  std::string key_of_constraint(const model::Loop& loop, std::string_view key) {
    if (key == "frame") return fmt::format("frame = \"{}\"\n", frame(loop.to));
    if (key == "plane") return fmt::format("plane = \"{}\"\n", frame(loop.from));
    if (key == "axis") return axis("axis", loop.to_axis);
    if (key == "normal") return axis("normal", loop.axis);
    if (key == "radii") return fmt::format("radii = {}\n", vector(loop.radii));
    if (key == "radius") return fmt::format("radius = {}\n", value(loop.length));
    if (key == "height") return fmt::format("height = {}\n", with({"x", "y", "z"}, loop.height));
    if (key == "approaches")
      return loop.height.is_zero() ? "" : fmt::format("approaches = {}\n", loop.approaches);
    JD_CHECK(key == "velocity", "no words for the key '{}' of a constraint", key);
    return fmt::format("velocity = {}\n", value(loop.residual));
  }

  std::string own_key(const model::Loop& loop, std::string_view key) const {
    if (key == "from") return fmt::format("from = \"{}\"\n", frame(loop.from));
    if (key == "to") return fmt::format("to = \"{}\"\n", frame(loop.to));
    if (key == "axis") return axis("axis", loop.axis);
    if (key == "to_axis") return axis("to_axis", loop.to_axis);
    if (key == "length") return fmt::format("length = {}\n", value(loop.length));
    JD_CHECK(key == "residual", "no words for the key '{}' of a loop", key);
    return fmt::format("residual = {}\n", value(loop.residual));
  }

  void add(const model::LoopOptions& options) {
    using Treatment = model::LoopTreatment;
    static constexpr const char* kTreatments[] = {"explicit", "partitioned", "multipliers"};
    text_ += "\n[loops]\n";
    if (options.treatment)
      text_ += fmt::format("treatment = \"{}\"\n", kTreatments[std::size_t(*options.treatment)]);
    std::vector<std::string> names;
    for (const auto& [joint, coordinate] : options.independent)
      names.push_back(fmt::format("\"{}\"", mechanism_.joints[joint.value].coordinates[coordinate].name));
    if (!names.empty()) text_ += fmt::format("independent = [{}]\n", fmt::join(names, ", "));
    if (options.treatment != Treatment::kExplicit)
      text_ += fmt::format("iterations = {}\n", options.iterations);
    if (options.treatment.value_or(Treatment::kMultipliers) == Treatment::kMultipliers)
      text_ += fmt::format("stabilisation = {}\n", number(options.stabilisation));
  }

  void add(const model::Output& output) {
    const model::OutputKindRow& kind = model::output_kind(output.kind);
    text_ += fmt::format("\n[[output]]\nname = \"{}\"\nkind = \"{}\"\n", output.name, kind.name);
    switch (kind.subject) {
      case model::OutputSubject::kNone:
        break;
      case model::OutputSubject::kFrame:
        text_ += fmt::format("frame = \"{}\"\n", frame(output.frame));
        break;
      case model::OutputSubject::kJoint:
        text_ += fmt::format("joint = \"{}\"\n", mechanism_.joints[output.joint.value].name);
        break;
      case model::OutputSubject::kCoordinate:
        text_ += coordinate(output.joint, output.coordinate);
        break;
      case model::OutputSubject::kValue:
        text_ += fmt::format("value = {}\n", value(output.value));
        break;
    }
  }

  const model::Mechanism& mechanism_;
  std::vector<std::string> arguments_;  // names of kArgument where the writer is
  std::string text_;
};

}  // namespace

std::string to_toml(const model::Mechanism& mechanism) { return Writer(mechanism).run(); }

}  // namespace jourdain::tests
