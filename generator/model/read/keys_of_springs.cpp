#include "model/read/keys_of_springs.hpp"

namespace jourdain::model {

KeySection spring_section() {
  return {"spring",
          "[[spring]]",
          "A spring and damper that pulls the origins of two frames together.",
          {{"name", "text", "", "its number", "for messages"},
           {"from", "name", "", kRequired, "a frame"},
           {"to", "name", "", kRequired, "a frame on another body"},
           {"stiffness", "number", "N/m", "0", ""},
           {"damping", "number", "N s/m", "0", ""},
           {"free_length", "number", "m", "0", ""},
           {"acts", "\"both ways\", \"pulling\", \"pushing\"", "", "\"both ways\"",
            "stiffness and damping: pulling, a rope, never push, max(k e + c e', 0) at a stretch e; pushing, "
            "a gap, "
            "never pull"},
           {"law", "expression", "N", "0", "added; of length (m) and rate (m/s)"},
           {"potential", "expression", "J", "none",
            "of the law, of length; without it the scene counts as losing energy"}},
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

}  // namespace jourdain::model
