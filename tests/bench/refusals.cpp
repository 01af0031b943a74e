// Ten thousand valid random mechanisms: which of them does the compiler refuse? With a kind, a first seed and
// a number, these alone.
#include <fmt/format.h>

#include <cstdlib>

#include "properties/refusals.hpp"

using namespace jourdain::tests;

int main(int argc, char** argv) {
  int refused = 0;
  for (const ValidKind& kind : valid_kinds()) {
    if (argc > 1 && kind.name != argv[1]) continue;
    const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
    const std::uint64_t count = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : kind.bench;
    int here = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed)
      if (const std::string why = refusal(valid_mechanism(kind, seed), seed); !why.empty()) {
        ++here;
        fmt::print("{} {}: {}\n", kind.name, seed, why);
      }
    fmt::print("{:<32} {:>6} of {}\n", kind.name, here, count);
    std::fflush(stdout);
    refused += here;
  }
  return refused > 0;
}
