#include "model/read/keys_of_constraints.hpp"

namespace jourdain::model {

KeySection constraint_section() {
  return {
      "constraint",
      "[[constraint]]",
      "Binds velocities and leaves positions free: what rolls, or glides along a blade, without slip. "
      "All coordinates are kept. A wheel is a thin disc; what rolls stays in touch with the plane, or with "
      "ground of a height over it, which pulls as well as it pushes.",
      {{"name", "name", "", "its number", ""},
       {"type", "word", "", "velocity",
        "velocity, knife_edge, rolling_wheel, rolling_ball, rolling_ellipsoid"},
       {"velocity", "expression", "any", kRequired,
        "velocity: of t, coordinates, frames and their rates, linear in the rates; kept at zero"},
       {"frame", "name", "", kRequired, "a [[frame]] or a body: the blade's point, the centre"},
       {"axis", "3 constants", "", "[0, 1, 0]",
        "in frame; knife_edge: where the point cannot go; rolling_wheel: what it spins about"},
       {"radius", "number", "m", kRequired, "rolling_wheel, rolling_ball: positive"},
       {"radii", "3 numbers", "m", kRequired, "rolling_ellipsoid: along the axes of frame, positive"},
       {"plane", "name", "", "the world", "a frame or a body: a point of what it moves on"},
       {"normal", "3 constants", "", "[0, 0, 1]", "of the plane, in the axes of plane, out of the ground"},
       {"height", "expression", "m", "0",
        "of the ground over the plane, without kinks: of x, y, z, the components in plane of the plane's "
        "point under it"},
       {"approaches", "constant", "", "4",
        "1 to 20: Newton's steps from under the centre to where the ground is touched; it must be less "
        "curved "
        "than what rolls"}},
      R"([[constraint]]
name = "camshaft_gears"
velocity = "camshaft.rate - 0.5*crank.rate"
)"};
}

}  // namespace jourdain::model
