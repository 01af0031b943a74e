#include "model/read/keys.hpp"

#include <algorithm>

#include "model/read/keys_of_constraints.hpp"
#include "model/read/keys_of_contacts.hpp"
#include "model/read/keys_of_imports.hpp"
#include "model/read/keys_of_kinematics.hpp"
#include "model/read/keys_of_springs.hpp"
#include "model/read/keys_of_states.hpp"
#include "model/read/keys_of_tables.hpp"
#include "support/check.hpp"

namespace jourdain::model {

namespace {

KeySection model_section() {
  return {"model",
          "[model]",
          "What the model is called.",
          {{"name", "text", "", kRequired, "up to 100 printable characters; made an identifier for C++"},
           {"description", "text", "", "empty", "printed in the emitted files"},
           {"source", "text", "", "empty", "where the numbers come from"},
           {"gravity", "3 numbers", "m/s²", "[0, 0, -9.81]", "in the inertial frame"}},
          R"([model]
name = "engine"
description = "Crank drive on an elastic mount"
source = "chosen"
gravity = [-9.81, 0, 0]
)"};
}

KeySection parameter_section() {
  return {
      "parameter",
      "[parameters]",
      "Values that stay tunable at run time: a number, or a table with the keys below.",
      {{"value", "number", "its unit", kRequired,
        "the default; an expression of other parameters makes a name for it, which is not tunable by itself"},
       {"unit", "text", "", "none", "strict once given: expressions must fit it"},
       {"description", "text", "", "empty", "printed in the header"},
       {"range", "2 numbers", "its unit", "the default only",
        "values it may have: what is proven of loops is proven for them all"}},
      R"([parameters]
flywheel = { value = 0.12, unit = "kg m^2", description = "crankshaft and flywheel", range = [0.1, 0.2] }
drag = 0.5
rim = "0.9*flywheel"
)"};
}

KeySection body_section() {
  return {
      "body",
      "[[body]]",
      "A rigid body; its frame is that of the joint that carries it.",
      {{"name", "name", "", kRequired, "an identifier; not \"world\""},
       {"mass", "number", "kg", kRequired, "but with a shape's density"},
       {"center_of_mass", "3 numbers", "m", "[0, 0, 0]", "in the body's frame"},
       {"inertia", "3 numbers, table", "kg m²", "0",
        "moments [xx, yy, zz], or { xx, yy, zz, xy, xz, yz } with products of the inertia tensor"},
       {"inertia_at", "\"center_of_mass\", \"origin\"", "", "\"center_of_mass\"", "the point it is about"},
       {"inertia_rpy", "3 numbers", "rad", "[0, 0, 0]", "orientation of the inertia's axes"},
       {"inertia_kind", "\"rigid\", \"lumped\"", "", "\"rigid\"",
        "lumped: need not be that of one rigid body"},
       {"shape", "table", "", "none",
        "instead of inertia: { kind = \"box\", size }, { kind = \"cylinder\", radius, length, axis }, { kind "
        "= "
        "\"sphere\", radius }, { kind = \"rod\", length, axis }, m, centred at the centre of mass; density, "
        "kg/m³, "
        "instead of mass, but for rods; axis \"x\", \"y\" or \"z\""}},
      R"([[body]]
name = "crankshaft"
mass = 9.0
inertia = ["flywheel/2", "flywheel/2", "flywheel"]

[[body]]
name = "connecting_rod"
center_of_mass = [0.045, 0, 0]
shape = { kind = "box", size = [0.15, 0.02, 0.02], density = 7800 }

[[body]]
name = "piston_body"
mass = 0.48

[[body]]
name = "cams"
mass = 1.5
inertia = [4e-3, 4e-3, 1e-3]
)"};
}

KeySection joint_section() {
  return {
      "joint",
      "[[joint]]",
      "Joints make a tree: each body is the child of one. A joint with one coordinate gives its name to it; "
      "one with "
      "several has JOINT_COORDINATE, as slab_angle of a planar joint slab.",
      {{"name", "name", "", kRequired, "an identifier"},
       {"type", "word", "", kRequired,
        "fixed, revolute, prismatic, screw, cylindrical, universal, planar, spherical, free, curve, gimbal, "
        "point"},
       {"parent", "name", "", kRequired,
        "a body, or \"world\", the inertial frame; of a free joint the world"},
       {"child", "name", "", kRequired, "a body"},
       {"position", "3 numbers", "m", "[0, 0, 0]",
        "of the joint's frame in the parent's; not of a free joint"},
       {"rpy", "3 numbers", "rad", "[0, 0, 0]", "its orientation: roll, pitch, yaw, R = Rz Ry Rx"},
       {"axis", "3 constants", "", "[0, 0, 1]",
        "in the joint's frame; planar: the normal n, x and y along the two axes after n where it is x, y or "
        "z, along x and -y where it is -z, else along e_z × n and n × (e_z × n)"},
       {"second_axis", "3 constants", "", "[1, 0, 0]", "universal: in the frame turned about axis"},
       {"pitch", "number", "m/rad", kRequired, "screw"},
       {"curve", "3 expressions", "m", kRequired, "curve: of its coordinate s; the child does not turn"},
       {"sequence", "3 letters", "", "\"xyz\"",
        "gimbal: the axes of its turns, x, y or z of the frame turned so far; neighbours differ"},
       {"initial_orientation", "4 numbers", "", "[1, 0, 0, 0]", "spherical, free: unit quaternion w x y z"},
       {"initial_angular_velocity", "3 numbers", "rad/s", "[0, 0, 0]", "spherical, free: child axes"}},
      R"([[joint]]
name = "crank"
type = "revolute"
parent = "world"
child = "crankshaft"
initial_position = "30 deg"
initial_velocity = 100

[[joint]]
name = "rod"
type = "revolute"
parent = "crankshaft"
child = "connecting_rod"
position = [0.045, 0, 0]
initial_position = "-36 deg"

[[joint]]
name = "piston"
type = "prismatic"
parent = "world"
child = "piston_body"
axis = [1, 0, 0]
damping = "drag"
initial_position = 0.18

[[joint]]
name = "camshaft"
type = "revolute"
parent = "world"
child = "cams"
position = [0.35, 0, 0]
initial_position = "15 deg"
initial_velocity = 50
)"};
}

KeySection coordinate_section() {
  return {"coordinate",
          "keys of a coordinate",
          "In the joint's table where it has one coordinate, otherwise in a table for each: cylindrical "
          "angle, slide; "
          "universal first, second; planar x, y, angle (angle = { damping = 5 }); gimbal first, second, "
          "third; point x, y, z. Units are those of an "
          "angle; of a "
          "slide m, N, N/m and so on. Spherical joints have damping, free ones initial_position and "
          "initial_velocity, three numbers each.",
          {{"stiffness", "number", "N m/rad", "0", "of a spring"},
           {"rest", "number", "rad", "0", "where the spring is slack"},
           {"damping", "number", "N m s/rad", "0", "of a damper"},
           {"friction", "number", "N m", "0", "-friction v/sqrt(v² + friction_speed²)"},
           {"friction_speed", "number", "rad/s", "1e-3", "where friction is 0.7 of its largest"},
           {"motion", "expression of t", "rad", "none", "prescribes the coordinate; may name states, too"},
           {"initial_position", "number", "rad", "0", "where it starts; with loops moved as far as they ask"},
           {"initial_velocity", "number", "rad/s", "0", ""},
           {"range", "2 constants", "rad", "anywhere",
            "where it may go: what is proven of loops is proven there"}},
          ""};
}

KeySection frame_section() {
  return {"frame",
          "[[frame]]",
          "A frame fixed to a body. A body's name is the frame at its origin, \"world\" the inertial one.",
          {{"name", "name", "", kRequired, ""},
           {"body", "name", "", kRequired, "a body, or \"world\""},
           {"position", "3 numbers", "m", "[0, 0, 0]", "in the body's frame"},
           {"rpy", "3 numbers", "rad", "[0, 0, 0]", ""}},
          R"([[frame]]
name = "small_end"
body = "connecting_rod"
position = [0.145, 0, 0]

[[frame]]
name = "cover"
body = "world"
position = [0.3, 0, 0]
)"};
}

KeySection actuator_section() {
  return {"actuator",
          "[[actuator]]",
          "An input that acts on a coordinate.",
          {{"name", "name", "", "the coordinate's name", "of the input"},
           {"joint", "name", "", kRequired, ""},
           {"coordinate", "word", "", "its only one", "of a joint with several"},
           {"gear_ratio", "number", "", "1", "the force is gear_ratio times the input"},
           {"rotor_inertia", "number", "kg m²", "0", "before the gear; adds gear_ratio² times that to M"}},
          R"([[actuator]]
name = "load_torque"
joint = "crank"
gear_ratio = 2
)"};
}

KeySection input_section() {
  return {"input",
          "[[input]]",
          "An input that only expressions use.",
          {{"name", "name", "", kRequired, ""},
           {"unit", "text", "", "none", "an SI unit"},
           {"description", "text", "", "empty", ""}},
          R"([[input]]
name = "gas_pressure"
unit = "Pa"
description = "above that of the crankcase"
)"};
}

KeySection force_section() {
  return {"force",
          "[[force]]",
          "A force and a moment on a frame, or a force on a coordinate. Expressions of t, inputs, states, "
          "coordinates (crank, "
          "crank.rate) and frames: position (tip.x), velocity (tip.vx), angular velocity (tip.world_wx) and "
          "axes (tip.R_zx, the z component of its x axis) in the inertial frame, angular velocity in the "
          "frame's own axes (tip.wx).",
          {{"name", "text", "", "its number", "for messages"},
           {"frame", "name", "", "none", "this, or joint"},
           {"joint", "name", "", "none", "whose coordinate is pushed forward"},
           {"coordinate", "word", "", "its only one", "of a joint with several"},
           {"force", "3 expressions", "N", "[0, 0, 0]", "at the frame's origin"},
           {"moment", "3 expressions", "N m", "[0, 0, 0]", "on its body"},
           {"axes", "\"frame\", \"world\"", "", "\"frame\"", "that force and moment are given in"},
           {"value", "expression", "N m, N", kRequired, "on the coordinate"}},
          R"toml([[force]]
joint = "piston"
value = "piston_force"

[[force]]
joint = "camshaft"
value = "valve_train(camshaft.rate)"

[[force]]
frame = "small_end"
axes = "world"
force = ["-0.1*small_end.vx", 0, 0]
)toml"};
}

KeySection loop_section() {
  return {"loop",
          "[[loop]]",
          "Closes a chain between two frames; the joints make the tree.",
          {{"name", "name", "", "its number", ""},
           {"type", "word", "", kRequired,
            "ball, revolute, universal, prismatic, cylindrical, planar_pin, point_in_plane, point_on_line, "
            "rod, residual"},
           {"from", "name", "", kRequired, "a frame; not of a residual"},
           {"to", "name", "", kRequired, "a frame on another body; one of the two may be on the world"},
           {"axis", "3 constants", "", "[0, 0, 1]",
            "in from; planar_pin: normal of the plane, in the axes of the last body that carries both ends"},
           {"to_axis", "3 constants", "", "the numbers of axis", "in to"},
           {"length", "expression of t", "m", kRequired, "rod"},
           {"residual", "expression", "any", kRequired,
            "residual: of t, coordinates, positions and axes of frames; kept at zero"}},
          R"([[loop]]
name = "piston_pin"
type = "planar_pin"
from = "piston_body"
to = "small_end"
axis = [0, 0, 1]
)"};
}

KeySection coupler_section() {
  return {"coupler",
          "[[coupler]]",
          "Keeps a linear relation between coordinates: gears, belts, racks, differentials. It acts on the "
          "coordinates and on no body beside.",
          {{"name", "name", "", "its number", ""},
           {"coordinate", "name", "", "terms", "the one that follows: ratio times the other, plus offset"},
           {"follows", "name", "", "terms", "another coordinate"},
           {"ratio", "number", "1, m/rad, rad/m", "1", "negative: they run against each other"},
           {"terms", "table of numbers", "1, m/rad, rad/m", "coordinate and follows",
            "factors by coordinate: their products add up to offset"},
           {"offset", "number", "rad", "0", "of a slide m"}},
          R"([[coupler]]
name = "camshaft_belt"
coordinate = "camshaft"
follows = "crank"
ratio = 0.5
)"};
}

KeySection loops_section() {
  return {"loops",
          "[loops]",
          "How loops are closed; what is left out is chosen.",
          {{"treatment", "\"explicit\", \"partitioned\", \"multipliers\"", "",
            "the first that is proven; multipliers where constraints bind velocities", ""},
           {"independent", "list of names", "", "chosen", "coordinates that the others follow from"},
           {"iterations", "constant", "", "2", "of Newton's method at the end of a step"},
           {"stabilisation", "constant", "1/s", "0", "multipliers: damps what opens between projections"}},
          R"([loops]
treatment = "explicit"
independent = ["crank", "governor_slider", "governor_arm1", "governor_arm2"]
)"};
}

KeySection output_section() {
  return {
      "output",
      "[[output]]",
      "What the emitted function `outputs` fills in.",
      {{"name", "name", "", kRequired, ""},
       {"kind", "word", "", kRequired,
        "pose, velocity, acceleration, jacobian: of a frame; reaction: of a joint; drive: of a prescribed "
        "coordinate; kinetic_energy, potential_energy; expression"},
       {"frame", "name", "", kRequired, "of pose, velocity, acceleration, jacobian"},
       {"joint", "name", "", kRequired, "of reaction, drive"},
       {"coordinate", "word", "", "its only one", "of a joint with several"},
       {"value", "expression", "any", kRequired, "of expression"}},
      R"([[output]]
name = "piston_speed"
kind = "expression"
value = "piston.rate"

[[output]]
name = "pin"
kind = "pose"
frame = "small_end"
)"};
}

}  // namespace

std::span<const KeySection> key_sections() {
  static const std::vector<KeySection> sections = {
      model_section(),      parameter_section(), table_section(),      function_section(),
      body_section(),       joint_section(),     coordinate_section(), frame_section(),
      actuator_section(),   input_section(),     state_section(),      memory_section(),
      signal_section(),     friction_section(),  force_section(),      spring_section(),
      bushing_section(),    cable_section(),     gear_mesh_section(),  stop_section(),
      contact_section(),    tyre_section(),      loop_section(),       coupler_section(),
      constraint_section(), loops_section(),     output_section(),     kinematics_section(),
      import_section(),     override_section(),  repeat_section()};
  return sections;
}

std::vector<std::string> keys_of(std::string_view section) {
  const auto sections = key_sections();
  const auto found =
      std::find_if(sections.begin(), sections.end(), [&](const KeySection& s) { return section == s.name; });
  JD_CHECK(found != sections.end(), "no section '{}'", section);
  std::vector<std::string> names;
  for (const Key& key : found->keys) names.emplace_back(key.name);
  return names;
}

}  // namespace jourdain::model
