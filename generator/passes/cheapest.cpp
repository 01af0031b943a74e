#include "passes/cheapest.hpp"

#include "passes/pipeline.hpp"

namespace jourdain::passes {

using ir::Program;

Program cheapest(const std::function<Program(const ir::Surroundings&)>& build) {
  constexpr std::size_t kSmall = 400;  // operations
  Program best = build({});
  if (remaining_operations(best) >= kSmall) return best;
  std::size_t fewest = emitted_operations(best);
  for (const double forward : {0.0, 0.15, 0.5, 1.0}) {
    ir::Surroundings simple;
    simple.forward = forward;
    Program other = build(simple);
    const std::size_t operations = emitted_operations(other);
    if (operations >= fewest) continue;
    fewest = operations;
    best = std::move(other);
  }
  return best;
}

}  // namespace jourdain::passes
