// No valid mechanism is refused: a sample of what `build/release/refusals` tries.
#include "properties/refusals.hpp"

#include <gtest/gtest.h>

#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

TEST(Refusals, NoValidMechanismIsRefused) {
  for (const ValidKind& kind : valid_kinds())
    for (std::uint64_t seed = 0; seed < cases(kind.test); ++seed)
      EXPECT_EQ(refusal(valid_mechanism(kind, seed), seed), "") << kind.name << ", seed " << seed;
}

}  // namespace
}  // namespace jourdain::tests
