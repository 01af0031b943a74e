#include "passes/cheapest_elimination.hpp"

#include <vector>

#include "passes/pipeline.hpp"

namespace jourdain::passes {

using ir::OrderChoice;
using ir::Program;

namespace {

constexpr std::size_t kSmall = 400, kLarge = 10000;  // operations

/// What is tried besides the first.
std::vector<OrderChoice> others(std::size_t operations, bool by_signs) {
  const bool try_many = by_signs && operations < kLarge;
  std::vector<OrderChoice> list;
  if (!by_signs) list.push_back({std::nullopt, 1});
  for (const double forward : try_many ? std::vector<double>{0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1}
                                       : std::vector<double>{0, 0.15, 0.5, 1})
    list.push_back({forward});
  return list;
}

}  // namespace

Program cheapest(const std::function<Program(const OrderChoice&)>& build) {
  Program best = build({});
  const std::size_t remaining = remaining_operations(best);
  const bool by_signs = ir::takes_by_signs(best), is_small = remaining < kSmall;
  if (!by_signs && !is_small) return best;
  const auto count = is_small ? emitted_operations : remaining_operations;
  std::size_t fewest = is_small ? emitted_operations(best) : remaining;
  for (const OrderChoice& choice : others(remaining, by_signs)) {
    Program other = build(choice);
    const std::size_t operations = count(other);
    if (operations >= fewest) continue;
    fewest = operations;
    best = std::move(other);
  }
  return best;
}

}  // namespace jourdain::passes
