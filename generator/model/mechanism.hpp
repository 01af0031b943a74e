// A multibody mechanism as read from its description: plain data, no derived quantities.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/expression.hpp"
#include "model/force_elements.hpp"
#include "model/indices.hpp"
#include "model/kinematic_function.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

using support::SourceRange;

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
  /// Values it may have at run time; what the compiler proves about loops it proves for all of them. None: the
  /// default only.
  std::optional<std::array<double, 2>> range = {};
};

/// A name that a description gives to an expression of its parameters. What names it holds the expression itself.
struct DerivedParameter {
  std::string name;  ///< an identifier that no parameter has
  Expression value;  ///< of parameters, SI units
  std::string unit;  ///< empty: not known
  SourceRange where = {};
};

/// Inertia tensor (kg m²), symmetric.
struct Inertia {
  Expression xx, yy, zz, xy, xz, yz;
};

enum class InertiaPoint { kCenterOfMass, kOrigin };

/// Lengths in m; kBox uses `size`, the others `radius`, `length` and `axis` as far as they have them.
struct Shape {
  enum class Kind { kBox, kCylinder, kSphere, kRod };
  Kind kind = Kind::kBox;
  Vector3 size = {};
  Expression radius = {};
  Expression length = {};
  std::size_t axis = 2;  ///< 0, 1, 2: the length lies along x, y, z
};

struct Body {
  std::string name;
  Expression mass;         ///< kg
  Vector3 center_of_mass;  ///< m, in the body frame
  Inertia inertia;         ///< about `inertia_point`, in the axes `inertia_axes`
  InertiaPoint inertia_point = InertiaPoint::kCenterOfMass;
  Rotation inertia_axes;            ///< orientation of the inertia's axes in the body frame
  std::optional<Shape> shape = {};  ///< that the inertia follows from, about the centre of mass in its axes
  bool lumped =
      false;  ///< published parameter set that need not be one rigid body's (no triangle inequality)
  bool lenient =
      false;  ///< where no rigid body has its inertia, that is a warning: its file is of such a format
  SourceRange where = {};
  SourceRange mass_where = {};     ///< of the mass (or of what it follows from); line 0: use `where`
  SourceRange inertia_where = {};  ///< of the inertia or shape; line 0: use `where`
};

enum class JointType {
  kFixed,
  kRevolute,
  kPrismatic,
  kScrew,        ///< turns about `axis` by y and moves along it by `pitch` y
  kCylindrical,  ///< (angle about `axis`, displacement along it)
  kUniversal,    ///< (angle about `axis`, then angle about `second_axis`, which is fixed in the turned frame)
  kPlanar,  ///< (displacements along the two directions of `plane_axes`, then angle about the normal `axis`)
  kSpherical,  ///< unit quaternion (w, x, y, z), child to joint frame; z: angular velocity relative to the parent,
               ///< child components
  kFree,       ///< parent is the world, no placement: position, quaternion; z: velocity of the child's origin
               ///< (inertial frame), ω (child components)
  kCurve,   ///< the child's origin is at `curve`(y) in the joint frame; the child does not turn
  kGimbal,  ///< three angles, each about the axis of the frame turned so far that `sequence` names
  kPoint    ///< displacements along x, y and z of the joint frame; the child does not turn
};

/// One scalar coordinate of a joint. Force on it: −stiffness (y − rest) − damping z − friction z/√(z² +
/// friction_speed²).
struct Coordinate {
  std::string
      name;  ///< of the entry in y and z: the joint's name, for several coordinates "<joint>_<suffix>"
  bool angular = true;               ///< rad, otherwise m
  Expression stiffness;              ///< N m/rad or N/m
  Expression rest;                   ///< rad or m
  Expression damping;                ///< N m s/rad or N s/m
  Expression friction;               ///< Coulomb friction, N m or N
  Expression friction_speed = 1e-3;  ///< speed over which its sign is smoothed, rad/s or m/s
  Expression initial_position;       ///< rad or m
  Expression initial_velocity;       ///< rad/s or m/s
  SourceRange position_where =
      {};  ///< of the initial position where the description gives it; otherwise line 0
  SourceRange velocity_where = {};  ///< of the initial velocity, likewise
  std::optional<Expression>
      motion;  ///< of time and parameters: the coordinate is prescribed, no part of y and z
  SourceRange motion_where = {};
  /// Where the coordinate may go, rad or m; what the compiler proves about loops it proves there. None: anywhere.
  std::optional<std::array<double, 2>> range;
  /// The range is a limit of a robot file, which says nothing where the coordinate starts beyond it.
  bool range_is_limit = false;
};

/// A joint; the child body's frame is the joint frame, moved by the joint's coordinates.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::optional<BodyIndex> parent;  ///< none: the world (inertial frame)
  BodyIndex child;
  Placement placement;                         ///< joint frame in the parent body's frame, at coordinate zero
  std::array<double, 3> axis{0, 0, 1};         ///< in the joint frame, not normalised; as read
  std::array<double, 3> second_axis{1, 0, 0};  ///< universal; in the frame turned about `axis`
  Expression pitch;                            ///< screw, m/rad
  Vector3 curve;                               ///< curve, m: functions of argument 0
  std::array<std::size_t, 3> sequence{0, 1, 2};  ///< gimbal; 0, 1, 2: x, y, z; neighbours differ
  std::vector<Coordinate> coordinates;           ///< those of its motions (see model/joint_kinds.hpp)
  std::array<Expression, 4> initial_orientation{1.0, 0.0, 0.0, 0.0};  ///< spherical, free: (w, x, y, z)
  Vector3 initial_spin;                                               ///< spherical, free: ω, rad/s
  Expression spin_damping;          ///< spherical: moment −spin_damping ω, N m s/rad
  Vector3 initial_origin;           ///< free: m, inertial frame
  Vector3 initial_origin_velocity;  ///< free: m/s, inertial frame
  SourceRange where = {};
  SourceRange child_where = {};  ///< of the child's name; line 0: use `where`
  SourceRange axis_where = {};   ///< of the axis; line 0: use `where`
  /// Of the initial values of spherical and free joints where the description gives them; otherwise line 0.
  SourceRange orientation_where = {}, spin_where = {}, origin_where = {}, origin_velocity_where = {};

  /// Sets the type and makes the coordinates that belong to it, all values zero, named after the joint.
  void set_type(JointType new_type);
};

/// The two directions in which a planar joint with unit normal `n` slides, orthogonal to it and each other: the next
/// two axes of the joint frame where the normal is one of them, otherwise (e_z × n)/|e_z × n| and n × that.
std::array<std::array<double, 3>, 2> plane_axes(const std::array<double, 3>& unit_normal);

/// Those of a normal of any length, in doubles: what a planar joint slides along by definition.
std::array<std::array<double, 3>, 2> slide_directions(const std::array<double, 3>& normal);

/// A named frame fixed to a body or to the world; force elements and outputs refer to it.
struct Frame {
  std::string name;
  std::optional<BodyIndex> body;  ///< none: the world
  Placement placement;            ///< in the body's frame
  SourceRange where = {};
};

/// An input that only expressions use.
struct Input {
  std::string name;
  std::string unit;
  std::string description;
  SourceRange where = {};
};

enum class LoopType {
  kBall,          ///< Δ = 0 (3 rows, axes of the carrier)
  kRevolute,      ///< Δ = 0, a₁·w = 0, a₂·w = 0
  kUniversal,     ///< Δ = 0, n·w = 0
  kPrismatic,     ///< a₁·Δ = 0, a₂·Δ = 0, a₁·w = 0, a₂·w = 0, a₁·b₂ = 0
  kCylindrical,   ///< a₁·Δ = 0, a₂·Δ = 0, a₁·w = 0, a₂·w = 0
  kPlanarPin,     ///< c₁·Δ = 0, c₂·Δ = 0
  kPointInPlane,  ///< n·Δ = 0
  kPointOnLine,   ///< a₁·Δ = 0, a₂·Δ = 0
  kRod,           ///< (Δ·Δ − l²)/(2 l) = 0
  kResidual,      ///< residual = 0
  // Rows that bind velocities and leave positions free, but for `height`: v is that of the body of `to` relative to
  // the body of `from`, at the origin of `to` or at the point Δ + ρ that touches the plane through `from`.
  kVelocity,      ///< residual = 0, linear in velocities
  kKnifeEdge,     ///< w·v = 0
  kRollingWheel,  ///< height n·Δ − l sqrt(1 − (n·w)²) = 0; a₁·v = 0, a₂·v = 0; ρ = −l (n − (n·w) w)/sqrt(1 − (n·w)²)
  kRollingBall,   ///< height n·Δ − l = 0; a₁·v = 0, a₂·v = 0; ρ = −l n
  /// D = Σ rᵢ² eᵢ eᵢᵀ, eᵢ axes of `to`: height n·Δ − sqrt(n·D n) = 0; a₁·v = 0, a₂·v = 0; ρ = −D n/sqrt(n·D n)
  kRollingEllipsoid
  // On ground of a height h over that plane n is the normal m/|m|, m = n₀ − h₁ a₁ − h₂ a₂, where Δ + ρ touches it, Δ
  // in `height` counts from there, and a₁ and a₂ are along the ground, a₁ over itself, a₂ = n × a₁.
};

/// A joint that closes a kinematic loop: constraint rows g = 0 beside the tree of the joints. Δ leads from the
/// origin of `from` to that of `to`; n is the unit vector along `axis`, (a₁, a₂) = plane_axes(n), both fixed
/// in `from`; w along `to_axis` and (b₁, b₂) = plane_axes(w) are fixed in `to`. The carrier is the last body
/// that both ends hang on (see `carrier`); a pin's (c₁, c₂) = plane_axes(axis) are fixed in the carrier. Rows
/// come in the order that LoopType gives. Parallel axes n and w, and a₁ and b₁ of a prismatic joint, point the
/// same way.
struct Loop {
  std::string name;
  LoopType type = LoopType::kBall;
  FrameIndex from, to;                     ///< on two bodies, or one on the world; no part of expressions
  std::array<double, 3> axis{0, 0, 1};     ///< not normalised; in `from`, of a pin in the carrier's axes
  std::array<double, 3> to_axis{0, 0, 1};  ///< in `to`, not normalised
  Expression length;    ///< rod, m: of time and parameters, positive; radius: of parameters
  Expression residual;  ///< of time, coordinates, positions and axes of frames; kVelocity: and their rates
  Vector3 radii;        ///< r, m: of parameters
  /// Of the ground over the plane, m: of parameters and of x, y, z, the components in `from` of the plane's point under
  /// it, in that order as arguments.
  Expression height;
  int approaches = 4;  ///< Newton's steps from under the centre to where the ground is touched
  /// The loop before: a file gives both as one connection, which may have rows that hold nothing.
  bool continues = false;
  std::optional<ScalarCoordinate> follower;  ///< of a coupler: follows the residual's other coordinate
  SourceRange where = {};
  SourceRange to_where = {};  ///< of the name of the end `to`; line 0: use `where`
};

/// Number of constraint rows.
std::size_t row_count(LoopType type);

/// How the constraints of loops are met.
enum class LoopTreatment {
  kExplicit,     ///< dependent coordinates in closed form
  kPartitioned,  ///< dependent coordinates by a fixed number of Newton iterations
  kMultipliers   ///< all coordinates are kept; constraint forces and a projection at the end of a step
};

struct LoopOptions {
  std::optional<LoopTreatment> treatment;  ///< none: the compiler chooses
  /// Independent coordinates, for all but multipliers; empty: the compiler chooses.
  struct CoordinateName {
    JointIndex joint;
    std::size_t coordinate = 0;
  };
  std::vector<CoordinateName> independent;
  int iterations = 2;        ///< Newton iterations that close the loops at the end of a step
  double stabilisation = 0;  ///< 1/s: multipliers meet g̈ + 2 s ġ + s² g = 0
  SourceRange where = {};
};

enum class OutputKind {
  kPose,          ///< position (m, inertial frame) and rotation matrix (frame to inertial) of a frame
  kVelocity,      ///< v (inertial frame) and ω (frame components) of a frame
  kAcceleration,  ///< a (inertial frame) and ω̇ (frame components) of a frame
  kJacobian,  ///< J_t, J_r (3 × nz) and v̄, ω̄, ā, ζ̄ of a frame: v = J_t z + v̄, a = J_t ż + ā, ω and ω̇ alike
  kReaction,  ///< force and moment that a joint transmits to its child (everything, drives and joint springs
              ///< too), at the child's origin, child components
  kDrive,     ///< force or torque that a prescribed coordinate's motion needs
  kKineticEnergy,    ///< J
  kPotentialEnergy,  ///< J
  kExpression        ///< any expression of time, coordinates, velocities, inputs and frames
};

struct Output {
  std::string name;  ///< a C++ identifier
  OutputKind kind = OutputKind::kExpression;
  FrameIndex frame;            ///< kPose to kJacobian
  JointIndex joint;            ///< kReaction, kDrive
  std::size_t coordinate = 0;  ///< kDrive
  Expression value;            ///< kExpression
  SourceRange where = {};
};

/// What snapping replaced (see model/snap.hpp): places in the order of its lists, and what the description gives there.
struct SnappedDirections {
  double tolerance = 0;  ///< rad
  std::vector<std::pair<std::size_t, Vector3>> rotations;
  std::vector<std::pair<std::size_t, std::array<double, 3>>> axes;

  bool empty() const { return rotations.empty() && axes.empty(); }
};

/// A file that the description imports.
struct ImportedFile {
  int file = 0;        ///< of its SourceRanges
  std::string prefix;  ///< of the names that it declares
};

/// Ground that a frame's body touches, for figures: the surface n·(p − o) = h over the plane through o, inertial frame.
struct DrawnGround {
  FrameIndex frame;
  std::array<double, 3> normal{0, 0, 1};  ///< not normalised
  Vector3 point;                          ///< o, m
  Expression height;  ///< h, m: of x, y, z, the plane's point under it, as arguments, and of t
};

inline constexpr double kStandardGravity = 9.81;  ///< m/s²

struct Mechanism : ForceElements {
  std::string name;  ///< as the user wrote it; see `cpp_name`
  std::string description;
  std::string source;  ///< where its numbers come from
  Vector3 gravity;     ///< m/s², inertial frame
  std::vector<Parameter> parameters;
  std::vector<DerivedParameter> derived;
  std::vector<Body> bodies;
  std::vector<Joint> joints;  ///< as declared
  std::vector<Frame> frames;
  std::vector<Input> inputs;
  std::vector<Output> outputs;
  std::vector<KinematicFunction> kinematics;
  std::vector<Loop> loops;
  LoopOptions loop_options;
  std::vector<DrawnGround> grounds;
  /// Constant angles that are a multiple of π/6 or π/4 but for rounding are that multiple: matrices of quarter turns
  /// are permutations.
  bool snap = true;
  SnappedDirections snapped;
  std::vector<std::string> welded;      ///< joints that were locked because nothing with mass is beyond them
  std::vector<std::string> indefinite;  ///< bodies whose inertia no rigid body has, used as it is
  std::vector<ImportedFile> imports;
  SourceRange where = {};  ///< of what describes it as a whole
};

/// By which a double that stands for a simple fraction of a turn may be off, rad, times the larger of 1 and its number
/// of quarter turns.
inline constexpr double kAngleRounding = 1e-15;

/// Joints parent before child, depth first from the world, siblings in order of declaration. This is the order of
/// the coordinates (joints of type kFixed have none). The mechanism must have passed `check_mechanism`.
std::vector<JointIndex> depth_first(const Mechanism& mechanism);

/// The last body that carries both bodies through joints, possibly one of the two; none: the world.
std::optional<BodyIndex> carrier(const Mechanism& mechanism, std::optional<BodyIndex> a,
                                 std::optional<BodyIndex> b);

/// Those of `depth_first` that are not fixed.
std::vector<JointIndex> moving_joints(const Mechanism& mechanism);

/// The parameters' default values, in order.
std::vector<double> default_values(const Mechanism& mechanism);

}  // namespace jourdain::model
