#include "model/read/keys_of_states.hpp"

namespace jourdain::model {

KeySection state_section() {
  return {"state",
          "[[state]]",
          "A number with a differential equation of its own: a current, a pressure, what a filter or a "
          "controller holds. "
          "Expressions of forces, outputs and rates of states use its name. In the emitted code states are "
          "the last entries of z.",
          {{"name", "name", "", kRequired, "an identifier that is no coordinate or input"},
           {"rate", "expression", "unit/s", kRequired, "as of a force, of states too"},
           {"initial", "number", "unit", "0", "where it starts"},
           {"nominal", "number", "unit", "initial or 1",
            "a size that it has: the larger of these where it is left out; what is validated is drawn by it, "
            "and FMUs "
            "tell it"},
           {"unit", "text", "", "none", "an SI unit"},
           {"description", "text", "", "empty", ""}},
          R"([[state]]
name = "cylinder_pressure"
rate = "(gas_pressure - cylinder_pressure)/2e-3"
unit = "Pa"
description = "what the pressure's line leaves of it"
)"};
}

KeySection memory_section() {
  return {"memory",
          "[[memory]]",
          "A number that is sampled where a step begins and held until the next sample: what a digital "
          "controller or a "
          "transport delay keeps. Expressions use its name. All memories are sampled at once, by what was "
          "before. In "
          "the emitted code memories are among the last entries of z, with NAME_timer (s, to the next "
          "sample) and, of a "
          "delay, NAME_1, NAME_2, ...",
          {{"name", "name", "", kRequired, "an identifier that is no coordinate, input or state"},
           {"update", "expression", "unit", kRequired, "its next value; as of a force, of memories too"},
           {"period", "number", "s", kRequired,
            "between samples, the first of which is at the start: the steps are samples that begin nearest "
            "to those "
            "times; 0: every step"},
           {"delay", "integer", "", "0", "by how many samples it lags, up to 64"},
           {"initial", "number", "unit", "0", "before its first sample"},
           {"nominal", "number", "unit", "initial or 1", "as of a state"},
           {"unit", "text", "", "none", "an SI unit"},
           {"description", "text", "", "empty", ""}},
          R"([[memory]]
name = "measured_pressure"
update = "gas_pressure"
period = 0.01
unit = "Pa"
description = "what a controller knows of it"
)"};
}

KeySection signal_section() {
  return {"signal",
          "[[signal]]",
          "A name for an expression, which forces, rates of states, outputs and later signals of this file "
          "may use.",
          {{"name", "name", "", kRequired, "an identifier that is no coordinate, input or state"},
           {"value", "expression", "unit", kRequired, "as of a force"},
           {"unit", "text", "", "none", "an SI unit"}},
          R"([[signal]]
name = "piston_force"
value = "-6.4e-3*gas_pressure"
)"};
}

KeySection friction_section() {
  return {"friction",
          "[[friction]]",
          "Friction on a coordinate that holds: LuGre's bristles, a state in rad or m with the table's name. "
          "Its force "
          "is -(bristle_stiffness z + bristle_damping z' + viscous v) with z' = v - bristle_stiffness |v| "
          "z/g, g = coulomb + "
          "(breakaway - coulomb) exp(-(v/stribeck_speed)^2).",
          {{"name", "name", "", kRequired, "of the state: an identifier that is no coordinate or input"},
           {"joint", "name", "", kRequired, "whose coordinate is held"},
           {"coordinate", "word", "", "its only one", "of a joint with several"},
           {"coulomb", "number", "N m, N", kRequired, "positive"},
           {"breakaway", "number", "N m, N", "coulomb", "not less"},
           {"stribeck_speed", "number", "rad/s, m/s", kRequired, "with breakaway"},
           {"bristle_stiffness", "number", "N m/rad, N/m", kRequired, "positive"},
           {"bristle_damping", "number", "N m s/rad, N s/m", "0", "not negative"},
           {"viscous", "number", "N m s/rad, N s/m", "0", "not negative"}},
          R"([[friction]]
name = "ring"
joint = "piston"
coulomb = 8
bristle_stiffness = 1e5
bristle_damping = 300
)"};
}

}  // namespace jourdain::model
