// What an actuator of an MJCF file pushes with.
#pragma once

#include <string>
#include <vector>

#include "model/read/mjcf_file.hpp"

namespace jourdain::model {

/// Force of an actuator before the gear, as its element and the default classes around it have it in turn, of whatever
/// kind: all kinds are short for one set of numbers, of which each changes a part and leaves the others (MuJoCo 3's
/// user_api.cc, mjs_setTo...; 2.2 begins anew in <position>).
struct MjcfLaw {
  std::vector<double> gain = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  std::vector<double> bias = std::vector<double>(gain.size());
  std::string gain_type = "fixed", bias_type = "none", dynamics = "none";
  bool is_position = false;  ///< <position>, whose dynamics are a lag
  std::string foreign =
      {};  ///< the kind of class whose numbers <position> takes over, where that is none of a servo
  bool is_unclear = false;  ///< of <dcmotor> or <plugin>

  /// Is the force gain₀ ctrl + bias₀ + bias₁ length + bias₂ speed, but for a lag?
  bool is_affine() const;
  /// Of a servo on positions a damping that is positive is a share of the critical one (MuJoCo 3's engine_setconst.c).
  bool has_damping_ratio() const;
};

MjcfLaw law_of(MjcfFile& file, const XmlElement& actuator);

}  // namespace jourdain::model
