#include "model/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// Constant angles that `Mechanism::snap` changes by more than rounding.
int snapped_angles(const Rotation& rotation) {
  constexpr double kRounding = 1e-15, kQuarter = std::numbers::pi / 2;
  int count = 0;
  for (const Expression& angle : rotation.rpy) {
    if (!angle.is_constant()) continue;
    const double turns = angle.constant() / kQuarter;
    const double distance = std::abs(turns - std::round(turns)) * kQuarter;
    count += distance > kRounding * std::max(1.0, std::abs(turns)) && distance <= kSnapTolerance ? 1 : 0;
  }
  return count;
}

/// An axis within kSnapTolerance of a coordinate axis becomes that; others stay. Whether it changed.
bool snap_axis(std::array<double, 3>& axis) {
  const auto size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double largest = *std::max_element(axis.begin(), axis.end(), size);
  std::array<double, 3> snapped = axis;
  for (double& entry : snapped)
    if (std::abs(entry) <= kSnapTolerance * std::abs(largest)) entry = 0;
  if (std::count(snapped.begin(), snapped.end(), 0.0) != 2 || snapped == axis) return false;
  axis = snapped;
  return true;
}

void snap_directions(Mechanism& mechanism, Diagnostics& diagnostics) {
  int count = 0;
  std::optional<SourceRange> first;
  const auto add = [&](const Rotation& rotation, const SourceRange& owner) {
    const int entries = snapped_angles(rotation);
    const SourceRange& where = rotation.where.line == 0 ? owner : rotation.where;
    if (entries > 0 && (!first || where.line < first->line)) first = where;
    count += entries;
  };
  for (const Body& body : mechanism.bodies) add(body.inertia_axes, body.where);
  for (const Joint& joint : mechanism.joints) add(joint.placement.rotation, joint.where);
  for (Joint& joint : mechanism.joints) {
    snap_axis(joint.axis);
    snap_axis(joint.second_axis);
  }
  for (Loop& loop : mechanism.loops) {
    snap_axis(loop.axis);
    snap_axis(loop.to_axis);
  }
  if (count == 0) return;
  const std::string angles = count == 1 ? "1 angle" : fmt::format("{} angles", count);
  diagnostics.note(*first, fmt::format("{} within 1e-9 rad of a quarter turn read as exact", angles),
                   "--no-snap keeps them");
}

}  // namespace

std::optional<Mechanism> finish_reading(Mechanism mechanism, const Completeness& complete,
                                        const ReadOptions& options, support::Severity triangle,
                                        Diagnostics& diagnostics) {
  mechanism.snap = options.snap;
  if (complete.structure) lock_joints(mechanism, options, diagnostics);
  if (mechanism.snap) snap_directions(mechanism, diagnostics);
  check_numbers(mechanism, diagnostics);
  const bool tree = complete.structure && check_graph(mechanism, diagnostics);
  if (tree) check_loops(mechanism, diagnostics);
  if (tree && complete.numbers) check_inertias(mechanism, diagnostics, triangle);
  if (diagnostics.has_errors()) return {};
  return mechanism;
}

}  // namespace jourdain::model
