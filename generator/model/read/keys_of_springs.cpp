#include "model/read/keys_of_springs.hpp"

namespace jourdain::model {

KeySection spring_section() {
  return {
      "spring",
      "[[spring]]",
      "A spring and damper that pulls the origins of two frames together.",
      {{"name", "text", "", "its number", "for messages"},
       {"from", "name", "", kRequired, "a frame"},
       {"to", "name", "", kRequired, "a frame on another body"},
       {"stiffness", "number", "N/m", "0", ""},
       {"damping", "number", "N s/m", "0", ""},
       {"free_length", "number", "m", "0", ""},
       {"acts", "\"both ways\", \"pulling\", \"pushing\"", "", "\"both ways\"",
        "stiffness and damping: pulling, a rope, never push, max(k e + c e', 0) at a stretch e > 0, else 0; "
        "pushing, "
        "a gap, "
        "never pull"},
       {"law", "expression", "N", "0", "added; of length (m) and rate (m/s)"},
       {"potential", "expression", "J", "none",
        "of the law, of length: its slope is the law at rest; without it, or where the law names rate, the "
        "scene counts as losing energy"}},
      R"([[spring]]
from = "cover"
to = "piston_body"
stiffness = 200
free_length = 0.12
)"};
}

KeySection bushing_section() {
  return {"bushing",
          "[[bushing]]",
          "Six springs and dampers that hold the origins and axes of two frames together; the law is in "
          "generator/model/bushing.hpp.",
          {{"name", "text", "", "its number", "for messages"},
           {"from", "name", "", kRequired, "a frame, in whose axes the numbers are"},
           {"to", "name", "", kRequired, "a frame on another body"},
           {"stiffness", "3 numbers", "N/m", "[0, 0, 0]", "along the axes"},
           {"damping", "3 numbers", "N s/m", "[0, 0, 0]", "not negative"},
           {"torsional_stiffness", "3 numbers", "N m/rad", "[0, 0, 0]", "about the axes"},
           {"torsional_damping", "3 numbers", "N m s/rad", "[0, 0, 0]", "not negative"}},
          R"([[bushing]]
from = "cover"
to = "small_end"
stiffness = [0, 100, 100]
torsional_damping = [0, 0, 0.01]
)"};
}

KeySection cable_section() {
  return {"cable",
          "[[cable]]",
          "A cable that runs through points from one end to the other, as over sheaves without friction: the "
          "tension max(stiffness e + damping e', 0) at a stretch e > 0 of its whole length, else 0, is the "
          "same all along. "
          "It never pushes.",
          {{"name", "text", "", "its number", "for messages"},
           {"through", "list of names", "", kRequired, "2 to 20 frames or bodies, from end to end"},
           {"stiffness", "number", "N/m", kRequired, "positive"},
           {"damping", "number", "N s/m", "0", "not negative"},
           {"free_length", "number", "m", kRequired, "positive"}},
          R"([[cable]]
through = ["cover", "small_end", "crankshaft"]
stiffness = 500
free_length = 2
)"};
}

KeySection gear_mesh_section() {
  return {"gear_mesh",
          "[[gear_mesh]]",
          "Elastic teeth of two wheels: a force along the line of action by e = first_radius q1 + "
          "second_radius q2, q the coordinates; with a backlash none while |e| is less than half of it, and "
          "none that pulls.",
          {{"name", "text", "", "its number", "for messages"},
           {"first", "name", "", kRequired, "a coordinate, an angle"},
           {"second", "name", "", kRequired, "another one"},
           {"first_radius", "number", "m", kRequired, "of the base circle; negative: teeth inside a ring"},
           {"second_radius", "number", "m", kRequired, ""},
           {"stiffness", "number", "N/m", kRequired, "positive"},
           {"damping", "number", "N s/m", "0", "not negative"},
           {"backlash", "number", "m", "0", "not negative"}},
          R"([[gear_mesh]]
first = "crank"
second = "camshaft"
first_radius = 0.03
second_radius = -0.06
stiffness = 1e6
damping = 50
)"};
}

}  // namespace jourdain::model
