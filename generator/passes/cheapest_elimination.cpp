#include "passes/cheapest_elimination.hpp"

#include <vector>

#include "passes/pipeline.hpp"

namespace jourdain::passes {

using ir::Program;

Program cheapest(const std::function<Program(const ir::Surroundings&)>& build) {
  constexpr std::size_t kSmall = 400, kLarge = 10000;  // operations
  Program best = build({});
  const std::size_t remaining = remaining_operations(best);
  const bool by_signs = ir::takes_by_signs(best), is_small = remaining < kSmall;
  if (!by_signs && !is_small) return best;
  const auto count = is_small ? emitted_operations : remaining_operations;
  std::size_t fewest = is_small ? emitted_operations(best) : remaining;
  const std::vector<double> few = {0, 0.15, 0.5, 1}, many = {0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1};
  const bool try_many = by_signs && remaining < kLarge;
  for (const double forward : try_many ? many : few) {
    ir::Surroundings simple;
    simple.forward = forward;
    Program other = build(simple);
    const std::size_t operations = count(other);
    if (operations >= fewest) continue;
    fewest = operations;
    best = std::move(other);
  }
  return best;
}

}  // namespace jourdain::passes
