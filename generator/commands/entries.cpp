#include "commands/entries.hpp"

#include <algorithm>

#include "emit/output_names.hpp"
#include "model/joint_kinds.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::commands {

namespace {

/// Entries of the tree's joints, in order; names are those of the layout.
class TreeEntries {
 public:
  explicit TreeEntries(const model::Mechanism& mechanism)
      : layout_(model::lay_out_coordinates(mechanism)), values_(model::default_values(mechanism)) {
    for (const model::JointIndex index : model::depth_first(mechanism)) {
      const model::Joint& joint = mechanism.joints[index.value];
      joint_ = index;
      for (std::size_t k = 0; k < joint.coordinates.size(); ++k)
        if (!joint.coordinates[k].motion) scalar(joint.coordinates[k], k);
      if (model::joint_kind(joint).has_origin()) {
        for (std::size_t k = 0; k < 3; ++k) {
          position("m", joint.initial_origin[k]);
          velocity("m/s", joint.initial_origin_velocity[k]);
        }
      }
      if (model::joint_kind(joint).has_quaternion()) turning(joint);
    }
    inputs(mechanism);
  }

  Entries entries;

 private:
  double value(const model::Expression& expression) const {
    return expression.evaluate(std::span<const double>(values_));
  }

  void scalar(const model::Coordinate& coordinate, std::size_t k) {
    position(position_unit(coordinate), coordinate.initial_position).coordinate = k;
    velocity(velocity_unit(coordinate), coordinate.initial_velocity).coordinate = k;
  }

  void turning(const model::Joint& joint) {
    for (const model::Expression& component : joint.initial_orientation) position("1", component);
    for (const model::Expression& spin : joint.initial_spin) velocity("rad/s", spin);
  }

  Entry& position(const char* unit, const model::Expression& initial) {
    const std::string& name = layout_.position_names[entries.positions.size()];
    return entries.positions.emplace_back(Entry{name, unit, joint_, {}, value(initial)});
  }

  Entry& velocity(const char* unit, const model::Expression& initial) {
    const std::string& name = layout_.velocity_names[entries.velocities.size()];
    return entries.velocities.emplace_back(Entry{name, unit, joint_, {}, value(initial)});
  }

  void inputs(const model::Mechanism& mechanism) {
    for (const model::Actuator& actuator : mechanism.actuators) {
      const model::Joint& joint = mechanism.joints[actuator.joint.value];
      entries.inputs.push_back({actuator.name, force_unit(joint.coordinates[actuator.coordinate]),
                                actuator.joint, actuator.coordinate});
    }
    for (const model::Input& input : mechanism.inputs) entries.inputs.push_back({input.name, input.unit});
  }

  model::CoordinateLayout layout_;
  std::vector<double> values_;
  model::JointIndex joint_;
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

Entries entries_of(const LoadedMechanism& loaded) {
  Entries entries = TreeEntries(loaded.mechanism).entries;
  const loops::LoopPlan* plan = loaded.plan();
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
                                         const std::vector<programs::OutputFacts>& declared) {
  std::vector<OutputNumber> numbers;
  for (std::size_t k = 0; k < declared.size(); ++k)
    for (const programs::OutputMember& member : declared[k].members)
      for (const std::string& name : emit::number_names(declared[k], member))
        numbers.push_back(
            {name, declared[k].name, output_unit(mechanism, mechanism.outputs[k], member.name)});
  return numbers;
}

}  // namespace jourdain::commands
