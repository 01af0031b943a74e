// An ensemble stepped by four threads that a callback follows, states and parameters set in between.
#include <jourdain/ensemble.hpp>
#include <vector>

#include "four_bar_kernels.hpp"

int main() {
  using Many = jourdain::Ensemble<four_bar::Model, double, 4>;
  Many ensemble(37);
  std::vector<std::size_t> steps(ensemble.block_count());
  for (int round = 0; round < 3; ++round) {
    ensemble.set_state(36, ensemble.state(static_cast<std::size_t>(round)));
    ensemble.set_parameters(5, ensemble.parameters(6));
    ensemble.run(jourdain::rk4, 1e-3, 20, 4,
                 [&](const Many::Block& block, std::size_t) { ++steps[block.index]; });
  }
  for (const std::size_t count : steps)
    if (count != 60) return 1;
  return ensemble.untrusted_count() == 0 ? 0 : 2;
}
