#include "mutants/mechanism_mutants.hpp"

#include <fmt/format.h>

#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::tests {

using model::Expression;
using model::Mechanism;

namespace {

/// Calls `visit` with each number of the mechanism and its name, always in the same order.
class Numbers {
 public:
  using Visit = std::function<void(const std::string& name, Expression& number)>;
  Numbers(Mechanism& mechanism, Visit visit) : mechanism_(mechanism), visit_(std::move(visit)) {}

  void run() {
    vector("gravity", mechanism_.gravity);
    for (model::Body& body : mechanism_.bodies) visit_body(body);
    for (model::Joint& joint : mechanism_.joints) visit_joint(joint);
    for (model::Frame& frame : mechanism_.frames) placement("frame " + frame.name, frame.placement);
    for_each_force_element(mechanism_, [this](auto& element) {
      std::vector<Expression*> numbers = element.expressions();
      if constexpr (requires { element.touch; })  // which no equation holds: reports read it
        if (element.touch) numbers.resize(numbers.size() - 2);
      for (Expression* number : numbers) visit_(fmt::format("{} {}", element.kKind, element.name), *number);
    });
    for (model::Output& output : mechanism_.outputs)
      if (output.kind == model::OutputKind::kExpression) visit_("output " + output.name, output.value);
    for (model::Loop& loop : mechanism_.loops) {
      const model::LoopKind& kind = model::loop_kind(loop);
      if (kind.takes("length") || kind.takes("radius")) visit_("length of " + loop.name, loop.length);
      if (kind.takes("radii")) vector("radii of " + loop.name, loop.radii);
      if (!loop.height.is_zero()) visit_("height of " + loop.name, loop.height);
    }
  }

 private:
  void vector(const std::string& name, model::Vector3& v) {
    for (std::size_t i = 0; i < 3; ++i) visit_(fmt::format("{} {}", name, "xyz"[i]), v[i]);
  }
  void placement(const std::string& name, model::Placement& p) {
    vector(name + " position", p.position);
    vector(name + " rpy", p.rotation.rpy);
  }
  void visit_body(model::Body& body) {
    visit_("mass of " + body.name, body.mass);
    vector("centre of " + body.name, body.center_of_mass);
    model::Inertia& I = body.inertia;
    for (Expression* entry : {&I.xx, &I.yy, &I.zz, &I.xy, &I.xz, &I.yz})
      visit_("inertia of " + body.name, *entry);
    vector("inertia axes of " + body.name, body.inertia_axes.rpy);
  }
  void visit_joint(model::Joint& joint) {
    placement("joint " + joint.name, joint.placement);
    if (model::joint_kind(joint).takes("pitch")) visit_("pitch of " + joint.name, joint.pitch);
    if (model::joint_kind(joint).takes("curve")) vector("curve of " + joint.name, joint.curve);
    for (model::Coordinate& c : joint.coordinates) {
      for (Expression* number : {&c.stiffness, &c.rest, &c.damping, &c.friction})
        visit_("force of " + c.name, *number);
      if (c.motion) visit_("motion of " + c.name, *c.motion);
      if (c.motion || !mechanism_.loops.empty()) continue;
      visit_("initial position of " + c.name, c.initial_position);
      visit_("initial velocity of " + c.name, c.initial_velocity);
    }
    if (model::joint_kind(joint).has_quaternion()) {
      visit_("spin damping of " + joint.name, joint.spin_damping);
      vector("initial spin of " + joint.name, joint.initial_spin);
    }
  }

  Mechanism& mechanism_;
  Visit visit_;
};

Expression scaled(const Expression& number, double factor) {
  return Expression::binary(Expression::Op::kMultiply, number, Expression(factor));
}

/// One mutant for each number for which `change` gives another one.
void change_numbers(const Mechanism& mechanism, const std::string& fault,
                    const std::function<std::optional<Expression>(const Expression&)>& change,
                    std::vector<MechanismMutant>& mutants) {
  Mechanism copy = mechanism;
  Numbers(copy, [&](const std::string& name, Expression& number) {
    const std::optional<Expression> changed = change(number);
    if (!changed) return;
    const Expression original = number;
    number = *changed;
    mutants.push_back({fault, name, copy});
    number = original;
  }).run();
}

void change_joints(const Mechanism& mechanism, std::vector<MechanismMutant>& mutants) {
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const model::Joint& joint = mechanism.joints[j];
    if (joint.coordinates.empty()) continue;
    MechanismMutant reversed{"axis reversed", joint.name, mechanism};
    for (double& entry : reversed.mechanism.joints[j].axis) entry = -entry;
    mutants.push_back(reversed);
    MechanismMutant cycled{"axis of another direction", joint.name, mechanism};
    std::swap(cycled.mechanism.joints[j].axis[0], cycled.mechanism.joints[j].axis[1]);
    std::swap(cycled.mechanism.joints[j].axis[1], cycled.mechanism.joints[j].axis[2]);
    mutants.push_back(cycled);
    if (model::joint_kind(joint).takes("sequence")) {
      MechanismMutant other{"another sequence", joint.name, mechanism};
      for (std::size_t& axis : other.mechanism.joints[j].sequence) axis = (axis + 1) % 3;
      mutants.push_back(other);
    }
    if (!joint.parent) continue;
    MechanismMutant orphan{"parent is the world", joint.name, mechanism};
    orphan.mechanism.joints[j].parent = std::nullopt;
    mutants.push_back(orphan);
  }
}

void change_ends(const Mechanism& mechanism, std::vector<MechanismMutant>& mutants) {
  const std::size_t frames = mechanism.frames.size();
  const auto next = [&](model::FrameIndex frame) { return model::FrameIndex((frame.value + 1) % frames); };
  const auto add = [&](const char* fault, const std::string& where, const auto& change) {
    MechanismMutant mutant{fault, where, mechanism};
    change(mutant.mechanism);
    mutants.push_back(std::move(mutant));
  };
  for (std::size_t i = 0; i < mechanism.springs.size(); ++i)
    add("another frame", mechanism.springs[i].name,
        [&](Mechanism& m) { m.springs[i].to = next(m.springs[i].to); });
  for (std::size_t i = 0; i < mechanism.bushings.size(); ++i)
    add("ends of a bushing swapped", mechanism.bushings[i].name,
        [&](Mechanism& m) { std::swap(m.bushings[i].from, m.bushings[i].to); });
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    add("another frame", mechanism.loads[i].name,
        [&](Mechanism& m) { m.loads[i].frame = next(m.loads[i].frame); });
    add("axes of a load", mechanism.loads[i].name, [&](Mechanism& m) {
      m.loads[i].axes =
          m.loads[i].axes == model::LoadAxes::kFrame ? model::LoadAxes::kWorld : model::LoadAxes::kFrame;
    });
  }
  for (std::size_t i = 0; i < mechanism.outputs.size(); ++i)
    if (model::output_kind(mechanism.outputs[i].kind).subject == model::OutputSubject::kFrame)
      add("another frame", mechanism.outputs[i].name,
          [&](Mechanism& m) { m.outputs[i].frame = next(m.outputs[i].frame); });
  for (std::size_t i = 0; i < mechanism.loops.size(); ++i) {
    add("ends of a loop swapped", mechanism.loops[i].name,
        [&](Mechanism& m) { std::swap(m.loops[i].from, m.loops[i].to); });
    add("another frame", mechanism.loops[i].name, [&](Mechanism& m) { m.loops[i].to = next(m.loops[i].to); });
  }
}

}  // namespace

std::vector<MechanismMutant> mechanism_mutants(const Mechanism& mechanism) {
  using Changed = std::optional<Expression>;
  std::vector<MechanismMutant> mutants;
  const auto numbers = [&](const char* fault, bool of_zeros,
                           const std::function<Expression(const Expression&)>& f) {
    change_numbers(
        mechanism, fault,
        [&](const Expression& e) { return e.is_zero() == of_zeros ? Changed(f(e)) : Changed(); }, mutants);
  };
  numbers("number by 1e-9", false, [](const Expression& e) { return scaled(e, 1 + 1e-9); });
  numbers("sign of a number", false, [](const Expression& e) { return scaled(e, -1); });
  numbers("number dropped", false, [](const Expression&) { return Expression(0.0); });
  numbers("zero made 1e-6", true, [](const Expression&) { return Expression(1e-6); });
  change_joints(mechanism, mutants);
  change_ends(mechanism, mutants);
  return mutants;
}

}  // namespace jourdain::tests
