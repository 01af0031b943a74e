// A multibody mechanism as read from its description: plain data, no derived quantities.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/expression.hpp"
#include "support/diagnostics.hpp"
#include "support/index.hpp"

namespace jourdain::model {

using support::SourceRange;
using BodyIndex = support::Index<struct BodyTag>;
using JointIndex = support::Index<struct JointTag>;

using Vector3 = std::array<Expression, 3>;

/// Orientation by roll, pitch, yaw (rad): R = Rz(yaw) Ry(pitch) Rx(roll), columns are the rotated axes.
struct Rotation {
  Vector3 rpy;
  SourceRange where = {};  ///< of the three angles; line 0 where they were left out
};

/// Pose of a frame in its parent frame: origin (m) and orientation.
struct Placement {
  Vector3 position;
  Rotation rotation;
};

struct Parameter {
  std::string name;  ///< a C++ identifier
  double value = 0;  ///< default
  std::string unit;
  std::string description;
  SourceRange where = {};
};

/// Inertia tensor (kg m²), symmetric.
struct Inertia {
  Expression xx, yy, zz, xy, xz, yz;
};

enum class InertiaPoint { kCenterOfMass, kOrigin };

struct Body {
  std::string name;
  Expression mass;         ///< kg
  Vector3 center_of_mass;  ///< m, in the body frame
  Inertia inertia;         ///< about `inertia_point`, in the axes `inertia_axes`
  InertiaPoint inertia_point = InertiaPoint::kCenterOfMass;
  Rotation inertia_axes;  ///< orientation of the inertia's axes in the body frame
  bool lumped =
      false;  ///< published parameter set that need not be one rigid body's (no triangle inequality)
  SourceRange where = {};
  SourceRange mass_where = {};     ///< of the mass (or of what it follows from); line 0: use `where`
  SourceRange inertia_where = {};  ///< of the inertia or shape; line 0: use `where`
};

enum class JointType { kFixed, kRevolute, kPrismatic };

/// A joint; the child body's frame is the joint frame, moved by the joint's coordinate about or along `axis`.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::optional<BodyIndex> parent;  ///< none: the world (inertial frame)
  BodyIndex child;
  Placement placement;                  ///< joint frame in the parent body's frame, at coordinate zero
  std::array<double, 3> axis{0, 0, 1};  ///< in the joint frame, not normalised; as read
  Expression stiffness;                 ///< N m/rad or N/m; force −stiffness (y − rest)
  Expression rest;                      ///< rad or m
  Expression damping;                   ///< N m s/rad or N s/m; force −damping z
  Expression initial_position;          ///< rad or m
  Expression initial_velocity;          ///< rad/s or m/s
  SourceRange where = {};
  SourceRange child_where = {};  ///< of the child's name; line 0: use `where`
  SourceRange axis_where = {};   ///< of the axis; line 0: use `where`
};

/// A generalized force on one joint's coordinate, given at run time.
struct Actuator {
  std::string name;
  JointIndex joint;
  SourceRange where = {};
};

struct Mechanism {
  std::string name;  ///< as the user wrote it; see `cpp_name`
  std::string description;
  std::string source;  ///< where its numbers come from
  Vector3 gravity;     ///< m/s², inertial frame
  std::vector<Parameter> parameters;
  std::vector<Body> bodies;
  std::vector<Joint> joints;  ///< as declared
  std::vector<Actuator> actuators;
  /// Constant rotation matrices whose entries lie within kSnapTolerance of 0 or ±1 are read as those exact values.
  bool snap = true;
};

inline constexpr double kSnapTolerance = 1e-9;

/// Joints parent before child, depth first from the world, siblings in order of declaration. This is the order of
/// the coordinates (joints of type kFixed have none). The mechanism must have passed `check_mechanism`.
std::vector<JointIndex> depth_first(const Mechanism& mechanism);

/// Those of `depth_first` that have a coordinate: entry i belongs to y[i] and z[i].
std::vector<JointIndex> moving_joints(const Mechanism& mechanism);

}  // namespace jourdain::model
