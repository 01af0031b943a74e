// Interpreter, numeric reference and 60-digit arithmetic agree on hundreds of seeded random mechanisms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "properties/effort.hpp"
#include "properties/random_tree.hpp"
#include "properties/to_toml.hpp"

namespace jourdain::tests {
namespace {

const std::uint64_t kTrees = cases(320);
// Backward error of M ż = k̄ − q̄ in double, of the sum of absolute terms: some hundred roundings of 1.1e-16.
constexpr double kBackward = 1e-13;
// Forward error of ż over cond(M).
constexpr double kForward = 1e-14;
// Symbolic equations against the reference in long double; outputs in double against 60 digits, of their term sum.
constexpr double kEntries = 1e-12;

struct Worst {
  int trees = 0;
  double backward = 0, forward = 0, entries = 0, reference = 0, condition = 0;
};

TEST(RandomTrees, AgreeInInterpreterReferenceAndSixtyDigits) {
  std::map<TreeClass, Worst> worst;
  for (std::uint64_t seed = 0; seed < kTrees; ++seed) {
    const Derived derived = derive(random_tree(seed));
    const Sample sample = random_sample(derived.mechanism, seed);
    const Judge judge(derived, sample);
    const std::vector<double> zdot = interpreted<double>(derived.module, "forward_dynamics", sample);
    Worst& w = worst[tree_class(seed)];
    ++w.trees;
    const double backward = judge.backward_error(zdot),
                 forward = judge.forward_error(zdot) / judge.condition();
    double entries = judge.mass_matrix_error(interpreted<double>(derived.module, "mass_matrix", sample));
    entries = larger_error(entries, judge.k_bar_error(interpreted<double>(derived.module, "k_bar", sample)));
    entries = larger_error(entries, judge.q_bar_error(interpreted<double>(derived.module, "q_bar", sample)));
    entries = larger_error(
        entries, judge.torque_error(interpreted<double>(derived.module, "inverse_dynamics", sample)));
    const auto from_reference = reference::forward_dynamics(judge.terms()).cast<double>().eval();
    const double reference =
        judge.forward_error({from_reference.begin(), from_reference.end()}) / judge.condition();
    ASSERT_LE(backward, kBackward) << "seed " << seed << "\n" << to_toml(derived.mechanism);
    ASSERT_LE(forward, kForward) << "seed " << seed << "\n" << to_toml(derived.mechanism);
    ASSERT_LE(entries, kEntries) << "seed " << seed << "\n" << to_toml(derived.mechanism);
    ASSERT_LE(reference, kForward) << "seed " << seed << "\n" << to_toml(derived.mechanism);
    w.backward = std::max(w.backward, backward);
    w.forward = std::max(w.forward, forward);
    w.entries = std::max(w.entries, entries);
    w.reference = std::max(w.reference, reference);
    w.condition = std::max(w.condition, judge.condition());
  }
  constexpr const char* kNames[] = {"aligned",     "parallel",   "massless",
                                    "mass ratios", "parameters", "general"};
  fmt::print("{:<12} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "class", "trees", "backward", "fwd/cond",
             "entries", "reference", "cond(M)");
  for (const auto& [tree, w] : worst)
    fmt::print("{:<12} {:>6} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e}\n", kNames[static_cast<int>(tree)],
               w.trees, w.backward, w.forward, w.entries, w.reference, w.condition);
}

TEST(RandomTrees, GiveTheSameEquationsWithEverySimplificationOff) {
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    const model::Mechanism mechanism = random_tree(seed);
    const Derived with = derive(mechanism);
    const Sample sample = random_sample(mechanism, seed);
    const Judge judge(with, sample);
    for (int off = 0; off < 3; ++off) {
      dynamics::DerivationOptions options;
      options.link_tree.regroup = off != 0;
      options.link_tree.share_parallel = off != 1;
      if (off == 2) options.articulated.assign(with.equations.zdot.size(), true);
      const Derived without = derive(mechanism, options);
      const auto values = [&](const char* name) { return interpreted<double>(without.module, name, sample); };
      EXPECT_LE(judge.backward_error(values("forward_dynamics")), kBackward) << seed << " " << off;
      EXPECT_LE(judge.mass_matrix_error(values("mass_matrix")), kEntries) << seed << " " << off;
      EXPECT_LE(judge.k_bar_error(values("k_bar")), kEntries) << seed << " " << off;
      EXPECT_LE(judge.q_bar_error(values("q_bar")), kEntries) << seed << " " << off;
      EXPECT_LE(judge.torque_error(values("inverse_dynamics")), kEntries) << seed << " " << off;
    }
  }
}

TEST(RandomTrees, AreAcceptedByTheCompiler) {
  for (std::uint64_t seed = 0; seed < cases(40); ++seed) {
    const CompiledModel compiled = compile(random_tree(seed), {});
    EXPECT_TRUE(compiled.verdict.accepted()) << seed << ": " << compiled.verdict.failures.front();
    EXPECT_EQ(compiled.files.size(), 4u);
  }
}

}  // namespace
}  // namespace jourdain::tests
