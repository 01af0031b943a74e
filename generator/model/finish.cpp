#include "model/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/checks.hpp"
#include "model/matrix3.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

/// Calls `change` with each expression that may name coordinates and inputs.
template <class Change>
void for_general_expressions(Mechanism& mechanism, Change&& change) {
  for (Load& load : mechanism.loads)
    for (std::size_t k = 0; k < 3; ++k) {
      change(load.force[k]);
      change(load.moment[k]);
    }
  for (CoordinateForce& force : mechanism.coordinate_forces) change(force.force);
  for (Output& output : mechanism.outputs) change(output.value);
  for (Loop& loop : mechanism.loops) change(loop.residual);
}

/// What acts on the joint goes with it; where an expression names its coordinates, their rates or its actuators'
/// inputs, zeros take their place.
void lock(Mechanism& mechanism, std::size_t j) {
  mechanism.joints[j].set_type(JointType::kFixed);
  const auto on_joint = [j](const auto& element) { return element.joint == JointIndex(j); };
  std::vector<std::optional<std::size_t>> input;  // new index of each input
  std::size_t kept = 0;
  for (const Actuator& actuator : mechanism.actuators)
    input.push_back(on_joint(actuator) ? std::nullopt : std::optional(kept++));
  for (std::size_t i = 0; i < mechanism.inputs.size(); ++i) input.emplace_back(kept++);
  std::erase_if(mechanism.actuators, on_joint);
  std::erase_if(mechanism.coordinate_forces, on_joint);
  std::erase_if(mechanism.loop_options.independent, on_joint);
  std::erase_if(mechanism.outputs, [&](const Output& output) {
    return output.kind == OutputKind::kDrive && output.joint == JointIndex(j);
  });
  for_general_expressions(mechanism, [&](Expression& expression) {
    expression = expression.substituted([&](const Variable& variable) {
      using Kind = Variable::Kind;
      const bool coordinate = variable.kind == Kind::kPosition || variable.kind == Kind::kVelocity;
      if (coordinate && variable.index == j) return Expression(0.0);
      if (variable.kind != Kind::kInput) return Expression::variable(variable);
      const std::optional<std::size_t> index = input[variable.index];
      return index ? Expression::variable({Kind::kInput, *index, 0}) : Expression(0.0);
    });
  });
}

void lock_joints(Mechanism& mechanism, const ReadOptions& options, Diagnostics& diagnostics) {
  for (const std::string& name : options.locked_joints) {
    const auto joint = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                    [&](const Joint& candidate) { return candidate.name == name; });
    if (joint != mechanism.joints.end()) {
      lock(mechanism, static_cast<std::size_t>(joint - mechanism.joints.begin()));
      continue;
    }
    std::vector<std::string> names;
    for (const Joint& candidate : mechanism.joints) names.push_back(candidate.name);
    const std::string close = support::nearest(name, names);
    diagnostics.error({}, fmt::format("there is no joint '{}' to lock", shown(name)),
                      close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  }
}

/// Entries of the rotation matrix that `Mechanism::snap` changes by more than rounding. 0 for tunable angles.
int snapped_entries(const Rotation& rotation) {
  constexpr double kRounding = 1e-15;  // a product of a few sines and cosines of exact quarter turns
  Numbers3 angles{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!rotation.rpy[i].is_constant()) return 0;
    angles[i] = rotation.rpy[i].constant();
  }
  int count = 0;
  for (const Numbers3& row : rotation_from_rpy(angles))
    for (const double entry : row) {
      const double distance = std::abs(entry - std::round(entry));
      count += distance > kRounding && distance <= kSnapTolerance ? 1 : 0;
    }
  return count;
}

void note_snapped_rotations(const Mechanism& mechanism, Diagnostics& diagnostics) {
  int count = 0;
  std::optional<SourceRange> first;
  const auto add = [&](const Rotation& rotation, const SourceRange& owner) {
    const int entries = snapped_entries(rotation);
    const SourceRange& where = rotation.where.line == 0 ? owner : rotation.where;
    if (entries > 0 && (!first || where.line < first->line)) first = where;
    count += entries;
  };
  for (const Body& body : mechanism.bodies) add(body.inertia_axes, body.where);
  for (const Joint& joint : mechanism.joints) add(joint.placement.rotation, joint.where);
  if (count == 0) return;
  const std::string entries = count == 1 ? "1 rotation entry" : fmt::format("{} rotation entries", count);
  diagnostics.note(*first, fmt::format("{} within 1e-9 of 0 or ±1 read as exact", entries),
                   "--no-snap keeps them");
}

}  // namespace

std::optional<Mechanism> finish_reading(Mechanism mechanism, const Completeness& complete,
                                        const ReadOptions& options, support::Severity triangle,
                                        Diagnostics& diagnostics) {
  mechanism.snap = options.snap;
  if (complete.structure) lock_joints(mechanism, options, diagnostics);
  if (mechanism.snap) note_snapped_rotations(mechanism, diagnostics);
  check_numbers(mechanism, diagnostics);
  const bool tree = complete.structure && check_graph(mechanism, diagnostics);
  if (tree) check_loops(mechanism, diagnostics);
  if (tree && complete.numbers) check_inertias(mechanism, diagnostics, triangle);
  if (diagnostics.has_errors()) return {};
  return mechanism;
}

}  // namespace jourdain::model
