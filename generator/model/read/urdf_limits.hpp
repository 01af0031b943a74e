// Limits of a robot's joints. No equation uses them; what is proven of loops is proven within them, where joints start
// there.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jourdain::model {

/// What a joint may be asked for, as its maker states it: rad or m, rad/s or m/s, N m or N.
struct Limits {
  std::optional<double> lower, upper, velocity, effort;

  bool any() const { return lower || upper || velocity || effort; }
};

/// What a <limit> states; numbers that are none or not finite are left out. Where only one end of the range is written
/// the other is zero; continuous joints have no range.
Limits limits_of(const tinyxml2::XMLElement& limit, bool continuous);

/// The attributes that limits_of() would read and whose texts are no numbers.
std::vector<const char*> limits_without_number(const tinyxml2::XMLElement& limit);

/// The <limit> elements of a URDF text that `read_urdf` accepts, by joint; joints that state none are left
/// out.
std::map<std::string, Limits> read_urdf_limits(const std::string& text);

}  // namespace jourdain::model
