// Limits of a robot's joints: for people. They are no part of the mechanism; no equation and no proof uses them.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace jourdain::model {

/// What a joint may be asked for, as its maker states it: rad or m, rad/s or m/s, N m or N.
struct Limits {
  std::optional<double> lower, upper, velocity, effort;

  bool any() const { return lower || upper || velocity || effort; }
};

/// The <limit> elements of a URDF text that `read_urdf` accepts, by joint; joints that state none are left
/// out, and so are numbers that are none or not finite. Where only one end of the range is written the other
/// is zero; continuous joints have no range.
std::map<std::string, Limits> read_urdf_limits(const std::string& text);

}  // namespace jourdain::model
