#include "to_toml.hpp"

#include <fmt/format.h>

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
      text_ += fmt::format("{} = {}\n", parameter.name, number(parameter.value));
    for (const model::Body& body : mechanism_.bodies) add(body);
    for (const model::Joint& joint : mechanism_.joints) add(joint);
    for (const model::Actuator& actuator : mechanism_.actuators)
      text_ += fmt::format("\n[[actuator]]\njoint = \"{}\"\nname = \"{}\"\n",
                           mechanism_.joints[actuator.joint.value].name, actuator.name);
    return text_;
  }

 private:
  static std::string number(double value) {
    const std::string digits = fmt::format("{}", value);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
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
        return "t";
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

  void add(const model::Joint& joint) {
    static constexpr const char* kTypes[] = {"fixed", "revolute", "prismatic"};
    text_ += fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                         joint.name, kTypes[std::size_t(joint.type)],
                         joint.parent ? mechanism_.bodies[joint.parent->value].name : "world",
                         mechanism_.bodies[joint.child.value].name);
    text_ += fmt::format("position = {}\nrpy = {}\n", vector(joint.placement.position),
                         vector(joint.placement.rotation.rpy));
    if (joint.type == model::JointType::kFixed) return;
    text_ +=
        fmt::format("axis = [{}, {}, {}]\nstiffness = {}\nrest = {}\ndamping = {}\n", number(joint.axis[0]),
                    number(joint.axis[1]), number(joint.axis[2]), value(joint.coordinates[0].stiffness),
                    value(joint.coordinates[0].rest), value(joint.coordinates[0].damping));
    text_ += fmt::format("initial_position = {}\ninitial_velocity = {}\n",
                         value(joint.coordinates[0].initial_position),
                         value(joint.coordinates[0].initial_velocity));
  }

  const model::Mechanism& mechanism_;
  std::string text_;
};

}  // namespace

std::string to_toml(const model::Mechanism& mechanism) { return Writer(mechanism).run(); }

}  // namespace jourdain::tests
