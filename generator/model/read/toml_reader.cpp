// The TOML model file. Wherever a number stands, a string with an expression over parameters may stand
// ("m/3*l^2", "30*deg"; see parse_expression), but for axes and parameter values, which are constant. So may a
// number with its unit ("30 deg", "2.5 N*m/rad", "100mm"), or both apart: { value = 100, unit = "mm" },
// { value = [1, 2, 3], unit = "mm" }. A bare number is in the unit below. Each must have the dimension of its place,
// expressions where a parameter with a unit stands in them (see dimensions.hpp).
//
//   [model]
//   name = "pendulum"              # required, up to 100 printable characters
//   description = "..."            # optional
//   source = "..."                 # optional: where the numbers come from
//   gravity = [0, 0, -9.81]        # m/s², inertial frame; this is the default
//
//   [parameters]                   # tunable at run time; the values are defaults
//   m = 1.0
//   l = { value = 1.0, unit = "m", description = "length", range = [0.5, 2] }
//                                  # range: values it may have; what is proven of loops is proven for them all
//
//   [[body]]
//   name = "bob"
//   mass = "m"                     # kg
//   center_of_mass = [0, 0, "-l"]  # m, body frame; default zero
//   inertia = [xx, yy, zz]         # kg m², or { xx, yy, zz, xy, xz, yz }; default zero: a point mass
//   inertia_at = "center_of_mass"  # or "origin"
//   inertia_rpy = [0, 0, 0]        # rad, orientation of the inertia's axes
//   inertia_kind = "rigid"         # or "lumped": need not be one rigid body's
//   shape = { kind = "box", size = [x, y, z], density = 2700 }   # m, kg/m³; instead of inertia, centred at the
//                                  # centre of mass; density instead of mass. Further kinds:
//                                  # { kind = "cylinder", radius, length, axis = "z" }, { kind = "sphere", radius }
//                                  # and { kind = "rod", length, axis = "z" } (thin, without density)
//
//   [[joint]]
//   name = "hinge"
//   type = "revolute"              # fixed, prismatic, screw, cylindrical, universal, planar, spherical, free, curve
//   parent = "world"               # the inertial frame, or a body
//   child = "bob"
//   position = [0, 0, 0]           # m, joint frame in the parent's frame (not for free joints)
//   rpy = [0, 0, 0]                # rad
//   axis = [0, 0, 1]               # in the joint frame; planar: the normal
//   second_axis = [1, 0, 0]        # universal; in the frame turned about `axis`
//   pitch = 0.01                   # screw, m/rad
//   curve = ["cos(s)", "sin(s)", "0"]       # curve: m, expressions of its coordinate s; the child does not turn
//   stiffness, damping             # N m/rad, N m s/rad (N/m, N s/m); default 0
//   rest                           # rad (m); default 0
//   friction, friction_speed       # N m (N), rad/s (m/s): -friction v/sqrt(v^2 + friction_speed^2); default 0, 1e-3
//   initial_position, initial_velocity      # rad, rad/s (m, m/s); default 0
//   motion = "0.1*sin(20*t)"       # prescribes the coordinate as a function of t
//   range = [-1, 1]                # rad (m): where the coordinate may go; what is proven of loops is proven there
//   # Joints with several coordinates have a table for each: cylindrical angle, slide; universal first, second;
//   # planar x, y, angle:           angle = { stiffness = 5, motion = "2*t" }
//   # Spherical: damping (N m s/rad), initial_orientation = [w, x, y, z], initial_angular_velocity = [x, y, z] (rad/s,
//   # child axes). Free: these two and initial_position, initial_velocity = [x, y, z] (m, m/s, inertial frame).
//
//   [[frame]]                      # fixed to a body; a body's name is the frame at its origin, "world" the inertial one
//   name = "tip"
//   body = "bob"                   # or "world"
//   position = [0, 0, 0]           # m
//   rpy = [0, 0, 0]                # rad
//
//   [[actuator]]
//   joint = "hinge"
//   coordinate = "angle"           # of a joint with several
//   name = "motor"                 # of the input; default: the coordinate's name
//   gear_ratio = 1                 # force = gear_ratio times input
//   rotor_inertia = 0              # kg m² before the gear; adds gear_ratio² times that to M
//
//   [[input]]                      # for expressions only
//   name = "wind"
//   unit, description
//
//   [[force]]                      # on a frame:
//   frame = "tip"
//   force = ["-2*tip.vx", 0, "wind"]        # N; expressions of t, inputs, coordinates (hinge, hinge.rate), frames
//   moment = [0, 0, 0]             # N m     # (tip.x y z position, .vx .vy .vz velocity, .wx .wy .wz angular velocity)
//   axes = "frame"                 # or "world"
//   [[force]]                      # or on a coordinate, which it pushes forward:
//   joint = "hinge"
//   coordinate = "angle"           # of a joint with several
//   value = "-3*sin(hinge)"
//
//   [[spring]]                     # pulls two frames together
//   from = "world"
//   to = "tip"
//   stiffness, damping, free_length         # N/m, N s/m, m; default 0
//   law = "100*(length - 1)^3"     # N, added; of length and rate
//   potential = "25*(length - 1)^4"         # J, of the law
//
//   [[bushing]]                    # holds the origins and axes of two frames together (see model/bushing.hpp)
//   from = "chassis_eye"           # in whose axes the numbers are
//   to = "arm_eye"
//   stiffness = [kx, ky, kz]       # N/m; default zero
//   damping = [cx, cy, cz]         # N s/m
//   torsional_stiffness, torsional_damping  # N m/rad, N m s/rad, about the axes
//
//   [[loop]]                       # closes a kinematic loop between two frames; the joints make the tree
//   name = "closure"
//   type = "ball"                  # revolute, universal, prismatic, cylindrical, planar_pin, point_in_plane,
//                                  # point_on_line, rod, residual
//   from = "tip"                   # frames on two bodies, or one on the world; not of a residual
//   to = "world"
//   axis = [0, 0, 1]               # in `from`; planar_pin: normal of the plane, in the axes of the last body that
//                                  # carries both ends (the world's where there is none)
//   to_axis = [0, 0, 1]            # in `to`; default: the numbers of `axis`
//   length = "0.4 + 0.01*sin(t)"   # rod, m
//   residual = "tip.x - 2*hinge"   # residual: of t, coordinates and positions of frames; it is kept at zero
//
//   [loops]                        # how loops are closed; everything is chosen where left out
//   treatment = "partitioned"      # explicit, multipliers
//   independent = ["crank"]        # coordinates, by name
//   iterations = 2                 # of Newton's method at the end of a step
//   stabilisation = 0              # 1/s, multipliers: damps what opens between projections
//
//   [[output]]
//   name = "tip_pose"
//   kind = "pose"                  # velocity, acceleration, jacobian: of `frame`; reaction: of `joint`; drive: of a
//   frame = "tip"                  # prescribed coordinate of `joint`; kinetic_energy, potential_energy;
//                                  # expression: `value`
#include <fmt/format.h>

#include "model/read/finish.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_sections.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;

constexpr double kStandardGravity = 9.81;

class TomlReader {
 public:
  TomlReader(Diagnostics& diagnostics, const toml::table& root) : file_(diagnostics), root_(root) {}

  Mechanism read() {
    const std::vector<std::string> known{"model",    "parameters", "body",  "joint",  "frame",
                                         "actuator", "input",      "force", "spring", "bushing",
                                         "loop",     "loops",      "output"};
    const TomlTable top(file_, root_, "the file", {}, known);
    Mechanism mechanism;
    if (const toml::table* section = top.table("parameters"))
      mechanism.parameters = read_parameters(file_, *section);
    file_.declare(mechanism.parameters);
    read_model(top, mechanism);
    if (const auto* section = tables(top, "body")) mechanism.bodies = read_bodies(file_, *section);
    if (const auto* section = tables(top, "joint"))
      mechanism.joints = read_joints(file_, *section, mechanism.bodies);
    if (const auto* section = tables(top, "actuator"))
      mechanism.actuators = read_actuators(file_, *section, mechanism.joints);
    if (const auto* section = tables(top, "frame"))
      mechanism.frames = read_frames(file_, *section, mechanism.bodies);
    if (const auto* section = tables(top, "input"))
      mechanism.inputs = read_inputs(file_, *section, mechanism);
    if (const auto* section = tables(top, "force")) read_forces(file_, *section, mechanism);
    if (const auto* section = tables(top, "spring")) read_springs(file_, *section, mechanism);
    if (const auto* section = tables(top, "bushing")) read_bushings(file_, *section, mechanism);
    if (const auto* section = tables(top, "output")) read_outputs(file_, *section, mechanism);
    if (const auto* section = tables(top, "loop")) read_loops(file_, *section, mechanism);
    if (const auto* section = top.table("loops"))
      mechanism.loop_options = read_loop_options(file_, *section, top.where("loops"), mechanism);
    if (top.has("loops") && !top.has("loop"))
      top.error("loops", "the file has [loops] and no [[loop]]", "each loop joint is a [[loop]]");
    return mechanism;
  }

  const Completeness& complete() { return file_.complete(); }

 private:
  void read_model(const TomlTable& top, Mechanism& mechanism) {
    mechanism.gravity = {0.0, 0.0, -kStandardGravity};
    if (!top.has("model"))
      return file_.error({1, 1, 1}, "the file has no [model]", "it needs at least [model] and a name");
    const toml::table* section = top.table("model");
    if (!section) return;
    mechanism.where = top.where("model");
    const TomlTable table(file_, *section, "[model]", top.where("model"),
                          {"name", "description", "source", "gravity"});
    mechanism.name = table.required_text("name").value_or("");
    check_model_name(table, mechanism.name);
    mechanism.description = table.text("description").value_or("");
    mechanism.source = table.text("source").value_or("");
    mechanism.gravity = table.vector("gravity", needed::kAcceleration, mechanism.gravity);
  }

  static void check_model_name(const TomlTable& table, const std::string& name) {
    constexpr int kLongest = 100;
    int length = 0;
    for (std::size_t i = 0; i < name.size(); ++length) {
      i += support::utf8_at(name, i).bytes;
    }
    if (length > kLongest)
      table.error("name", fmt::format("the model's name is longer than {} characters", kLongest));
  }

  /// The array of tables [[key]], or nothing (after a diagnostic if it is something else).
  const toml::array* tables(const TomlTable& top, const std::string& key) {
    if (!top.has(key)) return nullptr;
    const toml::array* array = top.find(key)->as_array();
    const bool list_of_tables = array && (array->empty() || array->is_homogeneous(toml::node_type::table));
    if (list_of_tables && array->size() <= kMaximumBodies) return array;
    file_.complete().structure = false;
    if (list_of_tables)
      top.error(key, fmt::format("the file has {} [[{}]] tables, more than {}", array->size(), key,
                                 kMaximumBodies));
    else
      top.error(key, fmt::format("'{}' must be a list of tables", key),
                fmt::format("write [[{}]] for each one", key));
    return nullptr;
  }

  TomlFile file_;
  const toml::table& root_;
};

}  // namespace

std::optional<Mechanism> read_toml(Diagnostics& diagnostics, const ReadOptions& options) {
  if (options.root == RootJoint::kFree) {
    diagnostics.error({}, "a free root can be asked for with URDF files only",
                      "declare the root's joint in the file");
    return {};
  }
  const std::optional<toml::table> root = parse_toml(diagnostics);
  if (!root) return {};
  TomlReader reader(diagnostics, *root);
  Mechanism mechanism = reader.read();
  return finish_reading(std::move(mechanism), reader.complete(), options, support::Severity::kError,
                        diagnostics);
}

}  // namespace jourdain::model
