// Compiled emitted code against interpreter and 60 digits: random mechanisms, two compilers, double and float.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "agreement/compiled_batch.hpp"
#include "agreement/shared_data.hpp"
#include "properties/effort.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::tests {
namespace {

constexpr std::uint64_t kTreesPerUnit = 6;
const std::uint64_t kTrees = std::max(cases(60), 2 * kTreesPerUnit);  // a unit for each compiler
constexpr double kBackward = 1e-13;
constexpr double kForward = 1e-14;
// Roundings of float are 2^29 times those of double.
constexpr double kFloat = 0x1p29;

/// Every tree of one compiler: `first`, first + 2 · kTreesPerUnit, … are the first of a translation unit.
void check(const std::string& compiler, std::uint64_t first) {
  double backward[2] = {0, 0}, forward[2] = {0, 0};
  for (std::uint64_t begin = first; begin < kTrees; begin += 2 * kTreesPerUnit) {
    std::vector<Derived> derived;
    std::vector<EmittedModel> models;
    for (std::uint64_t seed = begin; seed < begin + kTreesPerUnit; ++seed) {
      derived.push_back(derive(random_tree(seed)));
      models.push_back(emit_model(derived.back(), fmt::format("tree{}", seed)));
    }
    for (const bool single : {false, true}) {
      const CompiledBatch batch(models, compiler, single ? "float" : "double", kAsInterpreted);
      for (std::size_t k = 0; k < kTreesPerUnit; ++k) {
        const std::uint64_t seed = begin + k;
        const Sample sample = random_sample(derived[k].mechanism, seed, single);
        const Judge judge(derived[k], sample);
        const Evaluation e = batch.evaluate(k, sample);
        const double b = judge.backward_error(e.zdot), f = judge.forward_error(e.zdot) / judge.condition();
        EXPECT_LE(b, kBackward * (single ? kFloat : 1)) << seed;
        EXPECT_LE(f, kForward * (single ? kFloat : 1)) << seed;
        backward[single] = std::max(backward[single], b);
        forward[single] = std::max(forward[single], f);
        if (single) continue;
        EXPECT_EQ(e.M, interpreted<double>(derived[k].module, "mass_matrix", sample)) << seed;
        EXPECT_EQ(e.k, interpreted<double>(derived[k].module, "k_bar", sample)) << seed;
        EXPECT_EQ(e.q, interpreted<double>(derived[k].module, "q_bar", sample)) << seed;
        EXPECT_EQ(e.zdot, interpreted<double>(derived[k].module, "forward_dynamics", sample)) << seed;
        EXPECT_EQ(e.tau, interpreted<double>(derived[k].module, "inverse_dynamics", sample)) << seed;
        EXPECT_EQ(e.kinetic, interpreted<double>(derived[k].module, "kinetic_energy", sample)[0]) << seed;
        EXPECT_EQ(e.potential, interpreted<double>(derived[k].module, "potential_energy", sample)[0]) << seed;
      }
    }
  }
  fmt::print("{}: backward error double {:.1e} float {:.1e}, forward over cond(M) {:.1e} and {:.1e}\n",
             compiler, backward[0], backward[1], forward[0], forward[1]);
}

TEST(CompiledCode, AgreesBitByBitWithTheInterpreterUnderGcc) { check("g++", 0); }

TEST(CompiledCode, AgreesBitByBitWithTheInterpreterUnderClang) {
  ASSERT_TRUE(have_compiler("clang++")) << "no clang++";
  check("clang++", kTreesPerUnit);
}

}  // namespace
}  // namespace jourdain::tests
