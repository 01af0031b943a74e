#include "programs/scene_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "model/kinematic_kinds.hpp"
#include "model/motion_sources.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::programs {

namespace {

std::vector<OutputMember> members_of(model::OutputKind kind, std::size_t velocities) {
  std::vector<OutputMember> members;
  for (const model::OutputMemberKind& member : model::output_kind(kind).members) {
    const std::string name(member.name);
    switch (member.shape) {
      case model::MemberShape::kScalar:
        members.push_back({name});
        break;
      case model::MemberShape::kVector:
        members.push_back({name, 3});
        break;
      case model::MemberShape::kRotation:
        members.push_back({name, 3, 3, true});
        break;
      case model::MemberShape::kPerVelocity:
        if (velocities > 0) members.push_back({name, 3, static_cast<int>(velocities), true});
        break;
    }
  }
  return members;
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
  const std::vector<std::size_t> carried = plan.carried();
  for (const model::Tangent::Scalar& s : tree.scalars)
    if (!place[s.velocity] && !std::binary_search(carried.begin(), carried.end(), s.velocity))
      entries.push_back(s.position);
  for (const model::Tangent::Scalar& s : tree.quaternions)
    for (std::size_t k = 0; !place[s.velocity] && k < 4; ++k) entries.push_back(s.position + k);
  std::sort(entries.begin(), entries.end());
  return entries;
}

std::vector<std::size_t> carried_positions(const loops::LoopPlan& plan, const model::Tangent& tree) {
  std::vector<std::size_t> entries;
  for (const std::size_t k : plan.carried())
    for (const model::Tangent::Scalar& s : tree.scalars)
      if (s.velocity == k) entries.push_back(s.position);
  return entries;
}

void set_loop_facts(const model::Mechanism& mechanism, const loops::LoopPlan& plan, SceneFacts& facts) {
  facts.constraints = loops::row_names(mechanism);
  facts.is_reduced = plan.is_reduced();
  facts.closings = plan.closings();
  for (std::size_t i = 0; i < plan.kept_y.size(); ++i)
    if (plan.kept_y[i]) facts.kept_positions.push_back(i);
  if (!plan.is_reduced()) {
    for (std::size_t j = 0; j < plan.kept_z.size(); ++j)
      if (plan.kept_z[j]) facts.kept_velocities.push_back(j);
    return;
  }
  facts.dependents = dependent_positions(plan, facts.tangent);
  facts.carried = carried_positions(plan, facts.tangent);
  facts.tangent = independent_tangent(plan, facts.tangent);
  std::vector<std::string> independent;
  for (const std::size_t k : plan.independent) {
    if (plan.kept_z[k]) facts.kept_velocities.push_back(independent.size());
    independent.push_back(facts.velocities[k]);
  }
  facts.velocities = independent;
}

/// What each quantity is, and in which axes.
/// `accelerations`: " at the given zdot"; empty where there are none.
std::string comment_of(const model::KinematicFunction& function, const model::Mechanism& mechanism,
                       const char* accelerations) {
  const std::string frame = function.frame ? mechanism.frames[function.frame->value].name : "";
  std::string comment;
  bool has_axes = false;
  for (const model::KinematicQuantity quantity : function.quantities) {
    const model::QuantityRow& row = model::quantity_row(quantity);
    comment += (comment.empty() ? "" : "\n") + fmt::format(fmt::runtime(row.text), frame, accelerations);
    has_axes = has_axes || row.has_axes;
  }
  if (has_axes) comment += fmt::format("\n{}", model::axes_text(function.axes));
  return comment;
}

}  // namespace

std::string SceneFacts::carried_names() const {
  std::string names;
  for (const std::size_t entry : carried) names += (names.empty() ? "" : ", ") + positions[entry];
  return names;
}

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
  facts.states = mechanism.states;
  facts.inputs = layout.input_names;
  facts.parameters = mechanism.parameters;
  facts.tangent = layout.tangent;
  facts.time = model::time_dependence(mechanism);
  facts.motions_follow_states = model::motions_follow_states(mechanism);
  facts.motions_take_inputs = model::motions_take_inputs(mechanism);
  facts.all_derivatives = wishes.all_derivatives;
  facts.clock = wishes.clock || facts.time.any() || !facts.inputs.empty();
  if (plan) set_loop_facts(mechanism, *plan, facts);
  for (const model::Output& output : mechanism.outputs)
    facts.outputs.push_back({output.name,
                             fmt::format(fmt::runtime(model::output_kind(output.kind).text),
                                         model::subject_name(mechanism, output)),
                             members_of(output.kind, facts.velocities.size())});
  const char* accelerations = facts.velocities.empty() ? "" : " at the given zdot";
  for (const model::KinematicFunction& function : mechanism.kinematics)
    facts.kinematics.push_back(
        {function.name, comment_of(function, mechanism, accelerations), function.quantities});
  return facts;
}

}  // namespace jourdain::programs
