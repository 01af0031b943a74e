#include "model/angular_entries.hpp"

#include "model/coordinates.hpp"

namespace jourdain::model {

std::vector<bool> angular_positions(const Mechanism& mechanism) {
  const CoordinateLayout layout = lay_out_coordinates(mechanism);
  std::vector<bool> angular(layout.position_count(), false);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].position[c])
        angular[*entry] = mechanism.joints[j].coordinates[c].angular;
  return angular;
}

}  // namespace jourdain::model
