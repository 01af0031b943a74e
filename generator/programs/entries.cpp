#include "programs/entries.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "model/output_kinds.hpp"
#include "programs/output_names.hpp"

namespace jourdain::programs {

namespace {

/// Entries of the tree's joints, in order; names are those of the layout.
class TreeEntries {
 public:
  explicit TreeEntries(const model::Mechanism& mechanism)
      : layout_(model::lay_out_coordinates(mechanism)), values_(model::default_values(mechanism)) {
    for (const model::JointIndex index : model::depth_first(mechanism)) {
      const model::Joint& joint = mechanism.joints[index.value];
      joint_ = index;
      subject_ = fmt::format("{} joint '{}'", model::joint_kind(joint).name, joint.name);
      for (std::size_t k = 0; k < joint.coordinates.size(); ++k)
        if (!joint.coordinates[k].motion) scalar(joint.coordinates[k], k);
      const std::string& child = mechanism.bodies[joint.child.value].name;
      if (model::joint_kind(joint).has_origin()) origin(joint, child);
      if (model::joint_kind(joint).has_quaternion()) turning(joint, child);
    }
    for (const model::StateVariable& state : mechanism.states)
      entries.velocities.push_back({state.name, state.unit, state.description, {}, {}, value(state.initial)});
    inputs(mechanism);
  }

  Entries entries;

 private:
  double value(const model::Expression& expression) const {
    return expression.evaluate(std::span<const double>(values_));
  }

  void scalar(const model::Coordinate& coordinate, std::size_t k) {
    const char* what = coordinate.angular ? "angle" : "displacement";
    position(position_unit(coordinate), what, coordinate.initial_position).coordinate = k;
    velocity(velocity_unit(coordinate), fmt::format("rate of the {}", what), coordinate.initial_velocity)
        .coordinate = k;
  }

  void origin(const model::Joint& joint, const std::string& child) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string of = fmt::format("{} of the origin of '{}', inertial frame", "xyz"[k], child);
      position("m", "position " + of, joint.initial_origin[k]);
      velocity("m/s", "velocity " + of, joint.initial_origin_velocity[k]);
    }
  }

  void turning(const model::Joint& joint, const std::string& child) {
    for (std::size_t k = 0; k < 4; ++k)
      position("1", fmt::format("{} of the unit quaternion from '{}' to the joint's frame", "wxyz"[k], child),
               joint.initial_orientation[k]);
    for (std::size_t k = 0; k < 3; ++k)
      velocity("rad/s", fmt::format("relative angular velocity {} of '{}', its own axes", "xyz"[k], child),
               joint.initial_spin[k]);
  }

  Entry& position(const char* unit, const std::string& what, const model::Expression& initial) {
    const std::string& name = layout_.position_names[entries.positions.size()];
    return entries.positions.emplace_back(
        Entry{name, unit, fmt::format("{}: {}", subject_, what), joint_, {}, value(initial)});
  }

  Entry& velocity(const char* unit, const std::string& what, const model::Expression& initial) {
    const std::string& name = layout_.velocity_names[entries.velocities.size()];
    return entries.velocities.emplace_back(
        Entry{name, unit, fmt::format("{}: {}", subject_, what), joint_, {}, value(initial)});
  }

  void inputs(const model::Mechanism& mechanism) {
    for (const model::Actuator& actuator : mechanism.actuators) {
      const model::Joint& joint = mechanism.joints[actuator.joint.value];
      const model::Coordinate& coordinate = joint.coordinates[actuator.coordinate];
      entries.inputs.push_back(
          {actuator.name, force_unit(coordinate),
           fmt::format("drive of '{}', before the gear, positive towards greater values", coordinate.name),
           actuator.joint, actuator.coordinate});
    }
    for (const model::Input& input : mechanism.inputs)
      entries.inputs.push_back({input.name, input.unit, input.description});
  }

  model::CoordinateLayout layout_;
  std::vector<double> values_;
  model::JointIndex joint_;
  std::string subject_;
};

/// Unit of a member of an output.
std::string output_unit(const model::Mechanism& mechanism, const model::Output& output,
                        const std::string& member) {
  const std::span<const model::OutputMemberKind> members = model::output_kind(output.kind).members;
  const auto found = std::ranges::find(members, member, &model::OutputMemberKind::name);
  if (found == members.end()) return "";
  if (found->unit == model::kForceOnCoordinate)
    return force_unit(mechanism.joints[output.joint.value].coordinates[output.coordinate]);
  return std::string(found->unit);
}

}  // namespace

Entries entries_of(const model::Mechanism& mechanism, const loops::LoopPlan* plan) {
  Entries entries = TreeEntries(mechanism).entries;
  if (!plan) return entries;
  for (std::size_t i = 0; i < entries.positions.size(); ++i) entries.positions[i].initial = plan->y[i];
  for (std::size_t i = 0; i < entries.velocities.size(); ++i) entries.velocities[i].initial = plan->z[i];
  if (!plan->is_reduced()) return entries;
  const std::vector<Entry> all = std::move(entries.velocities);
  entries.velocities.clear();
  for (const std::size_t k : plan->independent) entries.velocities.push_back(all[k]);
  return entries;
}

const char* position_unit(const model::Coordinate& coordinate) { return coordinate.angular ? "rad" : "m"; }
const char* velocity_unit(const model::Coordinate& coordinate) {
  return coordinate.angular ? "rad/s" : "m/s";
}
const char* force_unit(const model::Coordinate& coordinate) { return coordinate.angular ? "N m" : "N"; }

std::vector<OutputNumber> output_numbers(const model::Mechanism& mechanism,
                                         const std::vector<OutputFacts>& declared) {
  std::vector<OutputNumber> numbers;
  for (std::size_t k = 0; k < declared.size(); ++k)
    for (const OutputMember& member : declared[k].members)
      for (const std::string& name : number_names(declared[k], member))
        numbers.push_back(
            {name, declared[k].name, output_unit(mechanism, mechanism.outputs[k], member.name)});
  return numbers;
}

}  // namespace jourdain::programs
