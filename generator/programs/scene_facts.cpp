#include "programs/scene_facts.hpp"

#include <fmt/format.h>

#include <optional>

namespace jourdain::programs {

namespace {

/// What an output is, in words.
std::string describe(const model::Mechanism& mechanism, const model::Output& output) {
  const auto frame = [&] { return mechanism.frames[output.frame.value].name; };
  const auto joint = [&] { return mechanism.joints[output.joint.value].name; };
  switch (output.kind) {
    case model::OutputKind::kPose:
      return fmt::format("Position (inertial frame) and rotation matrix (frame to inertial) of '{}'.",
                         frame());
    case model::OutputKind::kVelocity:
      return fmt::format("Velocity (inertial frame) and angular velocity (frame components) of '{}'.",
                         frame());
    case model::OutputKind::kAcceleration:
      return fmt::format("Acceleration (inertial frame) and angular acceleration (frame components) of '{}'.",
                         frame());
    case model::OutputKind::kJacobian:
      return fmt::format(
          "Jacobians of '{}': v = J_t z + v_bar, a = J_t zdot + a_bar (inertial frame); omega = J_r z + "
          "omega_bar, "
          "omega_dot = J_r zdot + zeta_bar (frame components).",
          frame());
    case model::OutputKind::kReaction:
      return fmt::format("What joint '{}' transmits to its child, at the child's origin, child components.",
                         joint());
    case model::OutputKind::kDrive:
      return fmt::format("Force or torque that the prescribed motion of '{}' needs.",
                         mechanism.joints[output.joint.value].coordinates[output.coordinate].name);
    case model::OutputKind::kKineticEnergy:
      return "Kinetic energy, J.";
    case model::OutputKind::kPotentialEnergy:
      return "Potential energy, J.";
    case model::OutputKind::kExpression:
      return "Expression of the model description.";
  }
  return "";
}

std::vector<OutputMember> members_of(model::OutputKind kind, std::size_t velocities) {
  const auto vector = [](const char* name) { return OutputMember{name, 3, 1, false}; };
  const auto matrix = [](const char* name, std::size_t columns) {
    return OutputMember{name, 3, static_cast<int>(columns), true};
  };
  switch (kind) {
    case model::OutputKind::kPose:
      return {vector("position"), matrix("rotation", 3)};
    case model::OutputKind::kVelocity:
      return {vector("v"), vector("omega")};
    case model::OutputKind::kAcceleration:
      return {vector("a"), vector("omega_dot")};
    case model::OutputKind::kJacobian:
      if (velocities == 0) return {vector("v_bar"), vector("omega_bar"), vector("a_bar"), vector("zeta_bar")};
      return {matrix("J_t", velocities), matrix("J_r", velocities), vector("v_bar"),
              vector("omega_bar"),       vector("a_bar"),           vector("zeta_bar")};
    case model::OutputKind::kReaction:
      return {vector("force"), vector("moment")};
    case model::OutputKind::kDrive:
    case model::OutputKind::kKineticEnergy:
    case model::OutputKind::kPotentialEnergy:
    case model::OutputKind::kExpression:
      return {{}};
  }
  return {};
}

/// Position of each velocity of the tree among the independent ones.
std::vector<std::optional<std::size_t>> places(const loops::LoopPlan& plan) {
  std::vector<std::optional<std::size_t>> list(plan.z.size());
  for (std::size_t j = 0; j < plan.independent.size(); ++j) list[plan.independent[j]] = j;
  return list;
}

model::Tangent independent_tangent(const loops::LoopPlan& plan, const model::Tangent& tree) {
  const auto place = places(plan);
  model::Tangent tangent;
  for (const model::Tangent::Scalar& s : tree.scalars)
    if (place[s.velocity]) tangent.scalars.push_back({s.position, *place[s.velocity]});
  for (const model::Tangent::Scalar& s : tree.quaternions)
    if (place[s.velocity]) tangent.quaternions.push_back({s.position, *place[s.velocity]});
  return tangent;
}

std::vector<std::size_t> dependent_positions(const loops::LoopPlan& plan, const model::Tangent& tree) {
  std::vector<std::size_t> entries;
  if (!plan.is_reduced()) return entries;
  const auto place = places(plan);
  for (const model::Tangent::Scalar& s : tree.scalars)
    if (!place[s.velocity]) entries.push_back(s.position);
  for (const model::Tangent::Scalar& s : tree.quaternions)
    for (std::size_t k = 0; !place[s.velocity] && k < 4; ++k) entries.push_back(s.position + k);
  std::sort(entries.begin(), entries.end());
  return entries;
}

void set_loop_facts(const model::Mechanism& mechanism, const loops::LoopPlan& plan, SceneFacts& facts) {
  facts.constraints = loops::row_names(mechanism);
  facts.is_reduced = plan.is_reduced();
  facts.closings = plan.closings();
  if (!plan.is_reduced()) return;
  facts.dependents = dependent_positions(plan, facts.tangent);
  facts.tangent = independent_tangent(plan, facts.tangent);
  std::vector<std::string> independent;
  for (const std::size_t k : plan.independent) independent.push_back(facts.velocities[k]);
  facts.velocities = independent;
}

}  // namespace

std::size_t SceneFacts::output_numbers() const {
  std::size_t count = 0;
  for (const OutputFacts& output : outputs)
    for (const OutputMember& member : output.members) count += member.numbers();
  return count;
}

SceneFacts scene_facts(const model::Mechanism& mechanism, const loops::LoopPlan* plan,
                       const SceneWishes& wishes) {
  SceneFacts facts;
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  facts.positions = layout.position_names;
  facts.velocities = layout.velocity_names;
  facts.inputs = layout.input_names;
  facts.parameters = mechanism.parameters;
  facts.tangent = layout.tangent;
  facts.time = model::time_dependence(mechanism);
  facts.all_derivatives = wishes.all_derivatives;
  facts.clock = wishes.clock || facts.time.any() || !facts.inputs.empty();
  if (plan) set_loop_facts(mechanism, *plan, facts);
  for (const model::Output& output : mechanism.outputs)
    facts.outputs.push_back(
        {output.name, describe(mechanism, output), members_of(output.kind, facts.velocities.size())});
  return facts;
}

}  // namespace jourdain::programs
