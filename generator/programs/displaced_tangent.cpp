#include "programs/displaced_tangent.hpp"

namespace jourdain::programs {

model::Tangent displaced_tangent(const SceneFacts& scene) {
  model::Tangent tangent = scene.tangent;
  for (std::size_t k = 0; k < scene.carried.size(); ++k)
    tangent.scalars.push_back({scene.carried[k], scene.velocities.size() + k});
  return tangent;
}

}  // namespace jourdain::programs
