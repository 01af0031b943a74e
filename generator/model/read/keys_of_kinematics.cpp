#include "model/read/keys_of_kinematics.hpp"

namespace jourdain::model {

KeySection kinematics_section() {
  return {
      "kinematics",
      "[[kinematics]]",
      "Functions of a frame's motion, or of the centre of mass, momentum and weight of all bodies: each "
      "entry of "
      "quantities is emitted as one function NAME_QUANTITY, with the state (and zdot where it takes "
      "accelerations) as its argument.",
      {{"name", "text", "", "none", "how the functions' names begin; required with a frame"},
       {"frame", "name", "", "none", "a [[frame]], a body or \"world\""},
       {"quantities", "texts", "", kRequired,
        "of a frame: \"pose\", \"velocity\", \"acceleration\", \"imu\", \"jacobian\", \"jacobian_bias\", "
        "\"inverse_operational_inertia\"; otherwise \"center_of_mass\", \"center_of_mass_jacobian\", "
        "\"center_of_mass_bias\", \"momentum\", \"centroidal_momentum_matrix\", "
        "\"centroidal_momentum_bias\", \"gravity_compensation\"; \"pose+jacobian\" is one function of both, "
        "which share their work"},
       {"axes", "\"world_aligned\", \"frame\", \"world\"", "", "\"world_aligned\"",
        "of velocities, accelerations and Jacobians: of the frame's origin in world axes, of its origin in "
        "its own "
        "axes, or spatial, at the world's origin"}},
      R"([[kinematics]]
name = "tip"
frame = "piston_body"
quantities = ["pose", "pose+jacobian"]

[[kinematics]]
quantities = ["gravity_compensation"]
)"};
}

}  // namespace jourdain::model
