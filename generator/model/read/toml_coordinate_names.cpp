#include "model/read/toml_coordinate_names.hpp"

#include <fmt/format.h>

#include <vector>

#include "support/diagnostics.hpp"

namespace jourdain::model {

namespace {

using support::shown;

std::string hint(const Mechanism& mechanism, const std::string& name, const std::vector<std::string>& known) {
  for (const Joint& joint : mechanism.joints) {
    if (joint.name != name) continue;
    std::vector<std::string> own;
    for (const Coordinate& coordinate : joint.coordinates) own.push_back(coordinate.name);
    return own.empty() ? fmt::format("joint '{}' has no scalar coordinate", shown(name))
                       : fmt::format("coordinates of joint '{}' are {}", shown(name),
                                     shown(fmt::format("{}", fmt::join(own, ", "))));
  }
  const std::string close = support::nearest(name, known);
  return close.empty() ? "a joint with one coordinate gives its name to it"
                       : fmt::format("did you mean '{}'?", shown(close));
}

}  // namespace

std::optional<ScalarCoordinate> find_scalar(TomlFile& file, SourceRange where, std::string_view who,
                                            const std::string& name, const Mechanism& mechanism) {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c) {
      const Coordinate& coordinate = mechanism.joints[j].coordinates[c];
      names.push_back(coordinate.name);
      if (coordinate.name == name) return ScalarCoordinate{JointIndex(j), c};
    }
  if (file.complete().structure)
    file.error(where, fmt::format("{} unknown coordinate '{}'", who, shown(name)),
               hint(mechanism, name, names));
  return {};
}

}  // namespace jourdain::model
