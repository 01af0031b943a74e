#include "model/snap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jourdain::model {

namespace {

struct PlacedRotation {
  Rotation* rotation;
  SourceRange owner;  ///< of what it belongs to
};

/// In an order that depends on the bodies, joints and frames alone.
std::vector<PlacedRotation> rotations(Mechanism& mechanism) {
  std::vector<PlacedRotation> list;
  for (Body& body : mechanism.bodies) list.push_back({&body.inertia_axes, body.where});
  for (Joint& joint : mechanism.joints) list.push_back({&joint.placement.rotation, joint.where});
  for (Frame& frame : mechanism.frames) list.push_back({&frame.placement.rotation, frame.where});
  return list;
}

struct PlacedAxis {
  std::array<double, 3>* axis;
  SourceRange owner;
};

std::vector<PlacedAxis> axes(Mechanism& mechanism) {
  std::vector<PlacedAxis> list;
  for (Joint& joint : mechanism.joints) {
    const SourceRange& where = joint.axis_where.line == 0 ? joint.where : joint.axis_where;
    list.push_back({&joint.axis, where});
    list.push_back({&joint.second_axis, where});
  }
  for (Loop& loop : mechanism.loops) {
    list.push_back({&loop.axis, loop.where});
    list.push_back({&loop.to_axis, loop.where});
  }
  return list;
}

/// The double nearest to the multiple of a quarter turn that a constant angle is within `tolerance` of, but
/// not by rounding alone.
std::optional<double> snapped_angle(const Expression& angle, double tolerance) {
  if (!angle.is_constant()) return {};
  constexpr long double kQuarter = std::numbers::pi_v<long double> / 2;
  const double read = angle.constant();
  const long double turns = std::round(static_cast<long double>(read) / kQuarter);
  const long double distance = std::abs(static_cast<long double>(read) - turns * kQuarter);
  if (distance <= kAngleRounding * std::max(1.0L, std::abs(turns)) || distance > tolerance) return {};
  return static_cast<double>(turns * kQuarter);
}

/// The axis with zeros for entries that are within `tolerance` of its largest, where that changes it.
std::optional<std::array<double, 3>> snapped_axis(const std::array<double, 3>& axis, double tolerance) {
  const auto size = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double largest = *std::max_element(axis.begin(), axis.end(), size);
  std::array<double, 3> snapped = axis;
  for (double& entry : snapped)
    if (std::abs(entry) <= tolerance * std::abs(largest)) entry = 0;
  return snapped == axis ? std::nullopt : std::optional(snapped);
}

/// The radius of gyration, m, of all bodies whose mass and inertia are numbers, each about an axis of its own; 0: none.
double size_of(const Mechanism& mechanism) {
  double inertia = 0, mass = 0;
  for (const Body& body : mechanism.bodies) {
    const auto& [xx, yy, zz, xy, xz, yz] = body.inertia;
    if (!body.mass.is_constant() || !xx.is_constant() || !yy.is_constant() || !zz.is_constant()) continue;
    inertia += std::max({xx.constant(), yy.constant(), zz.constant()});
    mass += body.mass.constant();
  }
  const double size = std::sqrt(inertia / mass);
  return std::isfinite(size) ? size : 0;
}

/// Numbers that are no larger than `rounding` become 0.
void drop(Expression& number, double rounding) {
  if (number.is_constant() && std::abs(number.constant()) <= rounding) number = 0.0;
}

/// Lengths below the rounding of the mechanism's size, and products of inertia below that of its moments, which
/// programs that export robots leave where zeros were meant.
void drop_rounding(Mechanism& mechanism) {
  const double rounding = kLengthRounding * size_of(mechanism);
  const auto drop_in = [rounding](Vector3& position) {
    for (Expression& length : position) drop(length, rounding);
  };
  for (Joint& joint : mechanism.joints) drop_in(joint.placement.position);
  for (Frame& frame : mechanism.frames) drop_in(frame.placement.position);
  for (Body& body : mechanism.bodies) {
    drop_in(body.center_of_mass);
    auto& [xx, yy, zz, xy, xz, yz] = body.inertia;
    if (!xx.is_constant() || !yy.is_constant() || !zz.is_constant()) continue;
    const double least = std::min({xx.constant(), yy.constant(), zz.constant()});
    for (Expression* product : {&xy, &xz, &yz}) drop(*product, kLengthRounding * least);
  }
}

/// "1 angle", "3 angles", "".
std::string counted(std::size_t count, const char* singular, const char* plural) {
  return count == 0 ? "" : fmt::format("{} {}", count, count == 1 ? singular : plural);
}

class Snapping {
 public:
  Snapping(Mechanism& mechanism, double tolerance) : mechanism_(mechanism), tolerance_(tolerance) {}

  void run() {
    const std::vector<PlacedRotation> rotation = rotations(mechanism_);
    for (std::size_t i = 0; i < rotation.size(); ++i) snap(i, rotation[i]);
    const std::vector<PlacedAxis> axis = axes(mechanism_);
    for (std::size_t i = 0; i < axis.size(); ++i) snap(i, axis[i]);
  }

  void note(support::Diagnostics& diagnostics) const {
    const std::string angles = counted(angles_, "angle", "angles");
    const std::string axes = counted(mechanism_.snapped.axes.size(), "axis", "axes");
    if (angles.empty() && axes.empty()) return;
    const std::string both = angles + (angles.empty() || axes.empty() ? "" : " and ") + axes;
    diagnostics.note(first_,
                     fmt::format("{} within {:g} rad of a right angle read as exact", both, tolerance_),
                     "--no-snap takes them as they are, --snap ANGLE changes how near is near");
  }

 private:
  void snap(std::size_t i, const PlacedRotation& placed) {
    const Vector3 read = placed.rotation->rpy;
    std::size_t count = 0;
    for (Expression& angle : placed.rotation->rpy)
      if (const std::optional<double> snapped = snapped_angle(angle, tolerance_)) {
        angle = *snapped;
        ++count;
      }
    if (count == 0) return;
    angles_ += count;
    mechanism_.snapped.rotations.push_back({i, read});
    found(placed.rotation->where.line == 0 ? placed.owner : placed.rotation->where);
  }

  void snap(std::size_t i, const PlacedAxis& placed) {
    const std::optional<std::array<double, 3>> snapped = snapped_axis(*placed.axis, tolerance_);
    if (!snapped) return;
    const bool is_rounding = snapped_axis(*placed.axis, kAngleRounding) == snapped;
    if (!is_rounding) {
      mechanism_.snapped.axes.push_back({i, *placed.axis});
      found(placed.owner);
    }
    *placed.axis = *snapped;
  }

  void found(const SourceRange& where) {
    if (first_.line == 0 || std::pair(where.file, where.line) < std::pair(first_.file, first_.line))
      first_ = where;
  }

  Mechanism& mechanism_;
  double tolerance_;
  std::size_t angles_ = 0;
  SourceRange first_;
};

}  // namespace

void snap_directions(Mechanism& mechanism, double tolerance, support::Diagnostics& diagnostics) {
  mechanism.snap = true;
  mechanism.snapped = {.tolerance = tolerance, .rotations = {}, .axes = {}};
  Snapping snapping(mechanism, tolerance);
  snapping.run();
  snapping.note(diagnostics);
  drop_rounding(mechanism);
}

Mechanism with_directions_as_read(Mechanism mechanism) {
  const std::vector<PlacedRotation> rotation = rotations(mechanism);
  for (const auto& [i, rpy] : mechanism.snapped.rotations) rotation.at(i).rotation->rpy = rpy;
  const std::vector<PlacedAxis> axis = axes(mechanism);
  for (const auto& [i, direction] : mechanism.snapped.axes) *axis.at(i).axis = direction;
  mechanism.snapped = {};
  mechanism.snap = false;
  return mechanism;
}

}  // namespace jourdain::model
