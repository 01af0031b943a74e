// Ten thousand valid random mechanisms: which of them does the compiler refuse? With a kind, and a first seed, these alone.
#include <fmt/format.h>

#include <cstdlib>

#include "properties/refusals.hpp"

using namespace jourdain::tests;

int main(int argc, char** argv) {
  int refused = 0;
  for (const ValidKind& kind : valid_kinds()) {
    if (argc > 1 && kind.name != argv[1]) continue;
    const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
    int here = 0;
    for (std::uint64_t seed = first; seed < first + kind.bench; ++seed)
      if (const std::string why = refusal(valid_mechanism(kind, seed)); !why.empty()) {
        ++here;
        fmt::print("{} {}: {}\n", kind.name, seed, why);
      }
    fmt::print("{:<32} {:>6} of {}\n", kind.name, here, kind.bench);
    std::fflush(stdout);
    refused += here;
  }
  return refused > 0;
}
