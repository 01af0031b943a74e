#include "model/read/keys_of_contacts.hpp"

namespace jourdain::model {

KeySection stop_section() {
  return {"stop",
          "[[stop]]",
          "Elastic ends of a coordinate's way: beyond one it is pushed back by max(stiffness d + damping d', "
          "0) at a "
          "depth d, never pulled.",
          {{"name", "text", "", "its number", "for messages"},
           {"joint", "name", "", kRequired, "whose coordinate is stopped"},
           {"coordinate", "word", "", "its only one", "of a joint with several"},
           {"lower", "number", "rad, m", "none", "lower, upper or both"},
           {"upper", "number", "rad, m", "none", ""},
           {"stiffness", "number", "N m/rad, N/m", kRequired, "positive"},
           {"damping", "number", "N m s/rad, N s/m", "0", "not negative"}},
          R"([[stop]]
joint = "piston"
upper = 1.0
stiffness = 1e5
damping = 10
)"};
}

KeySection contact_section() {
  return {
      "contact",
      "[[contact]]",
      "A plane, or ground of a height, against a frame's origin, or a ball around it. At a depth d it pushes "
      "by N = "
      "max(stiffness d^exponent (1 "
      "+ damping "
      "d'), 0) along its normal (Hunt and Crossley), and by friction N v/sqrt(v^2 + slip_speed^2) "
      "against the "
      "velocity v along it; on a slope of angle a less than atan(friction) it creeps, with slip_speed "
      "tan(a)/sqrt(friction^2 - tan(a)^2).",
      {{"name", "text", "", "its number", "for messages; with lugre it is required"},
       {"frame", "name", "", kRequired, "a [[frame]] or a body"},
       {"point", "3 numbers", "m", "[0, 0, 0]", "of the plane, in the inertial frame"},
       {"normal", "3 constants", "", "[0, 0, 1]", "out of the ground, in the inertial frame"},
       {"height", "expression", "m", "0",
        "of the ground over the plane: of x, y, z, the inertial coordinates of the plane's point under "
        "it, and of t"},
       {"approaches", "constant", "", "4",
        "0 to 20: how often the point that is touched is looked for; each time its error is multiplied by "
        "radius times curvature"},
       {"radius", "number", "m", "0", "of a ball around the frame's origin"},
       {"stiffness", "number", "N/m", kRequired, "positive; N/m^exponent"},
       {"exponent", "constant", "", "1", "between 1 and 10; of spheres 1.5"},
       {"damping", "number", "s/m", "0", "not negative"},
       {"friction", "number", "", "0", "coefficient"},
       {"friction_model", "\"smoothed\", \"lugre\"", "", "\"smoothed\"",
        "lugre: bristles, which hold; two states in m, the table's name with _1 and _2"},
       {"slip_speed", "number", "m/s", kRequired,
        "with friction: below it friction is smoothed; 1e-8 of lugre"},
       {"bristle_stiffness", "number", "1/m", kRequired, "of lugre, per normal force"},
       {"bristle_damping", "number", "s/m", "0", "of lugre, per normal force"}},
      R"([[contact]]
frame = "small_end"
point = [-1, 0, 0]
normal = [1, 0, 0]
stiffness = 1e4
damping = 0.5
friction = 0.3
slip_speed = 0.01
)"};
}

KeySection tyre_section() {
  return {
      "tyre",
      "[[tyre]]",
      "A wheel on a plane, or on ground of a height, whose forces build up with the way that it rolls "
      "(relaxation length); "
      "two states, "
      "deflections in m, the table's name with _longitudinal and _lateral. What it computes is at the "
      "head of "
      "generator/model/read/toml_tyre.cpp.",
      {{"name", "name", "", kRequired, "of its states and of the frame NAME_axle"},
       {"frame", "name", "", kRequired, "a [[frame]] or a body: the wheel's centre, turning with it"},
       {"axis", "3 constants", "", "[0, 1, 0]",
        "in frame, to the left: a wheel that turns about it in the positive sense goes forward"},
       {"point", "3 numbers", "m", "[0, 0, 0]", "of the plane, in the inertial frame"},
       {"normal", "3 constants", "", "[0, 0, 1]", "out of the ground, in the inertial frame"},
       {"height", "expression", "m", "0",
        "of the ground over the plane: of x, y, z, the inertial coordinates of the plane's point under "
        "it, and of t"},
       {"approaches", "constant", "", "4",
        "0 to 20: how often the point that is touched is looked for; each time its error is multiplied by "
        "radius times curvature"},
       {"radius", "number", "m", kRequired, "unloaded; slip is counted with it"},
       {"stiffness", "number", "N/m", kRequired, "of the radius; positive"},
       {"damping", "number", "N s/m", "0", "not negative"},
       {"friction", "number", "", kRequired, "largest force along the plane over the load"},
       {"relaxation_length", "number", "m", kRequired, "positive"},
       {"law", "\"magic_formula\", \"brush\"", "", "\"magic_formula\"", ""},
       {"stiffness_factor", "2 numbers", "", kRequired, "B of the Magic Formula, forward and sideways"},
       {"shape_factor", "2 numbers", "", kRequired, "C of it"},
       {"curvature_factor", "2 numbers", "", "[0, 0]", "E of it, up to 1"},
       {"slip_stiffness", "number", "", kRequired, "brush: slope at no slip over the load"}},
      R"([[tyre]]
name = "roller"
frame = "cams"
radius = 0.31
stiffness = 2e5
friction = 1
relaxation_length = 0.3
stiffness_factor = [12, 10]
shape_factor = [1.6, 1.3]
)"};
}

}  // namespace jourdain::model
