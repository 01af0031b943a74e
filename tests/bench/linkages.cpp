// What the compiler does by default with a thousand random linkages that swing free: how many are right, and which are not.
// linkages [CLASS [FIRST [COUNT]]]: classes whose names begin with CLASS, COUNT seeds from FIRST.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "loops/free_swing.hpp"

namespace {

using namespace jourdain;
using namespace jourdain::tests;

constexpr const char* kOutcomeNames[kOutcomes] = {"right", "flagged", "refused", "wrong", "left out"};

/// One class under one treatment.
struct Tally {
  std::array<std::size_t, kOutcomes> outcomes{};
  std::array<std::size_t, 3> treatments{};  ///< explicit, partitioned, multipliers
  std::size_t shortened = 0;
  double worst_drift = 0;  ///< of right ones
  std::vector<std::string> wrong;

  void add(std::uint64_t seed, const Judgement& judgement, double duration) {
    ++outcomes[static_cast<std::size_t>(judgement.outcome)];
    if (judgement.operations == 0) return;
    ++treatments[static_cast<std::size_t>(judgement.treatment)];
    shortened += judgement.until < 0.999 * duration;
    if (judgement.outcome == Outcome::kRight) worst_drift = std::max(worst_drift, judgement.drift);
    if (judgement.outcome == Outcome::kWrong) wrong.push_back(fmt::format("{}: {}", seed, judgement.why));
  }

  void print(std::string_view name, const char* rest) const {
    fmt::print("{:<24}{:>5}{:>5}{:>5}{:>7}{:>8}{:>8}{:>7}{:>7}{:>7}{:>10.1e}{}\n", name, treatments[0],
               treatments[1], treatments[2], outcomes[0], outcomes[1], outcomes[2], outcomes[3], outcomes[4],
               shortened, worst_drift, rest);
  }
};

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

constexpr Looks kLooks{0.05, 40};  // 2 s

struct ClassResult {
  Tally chosen, multipliers;
  std::vector<double> ratios;  ///< operations of a step as chosen over those with multipliers

  void judge_seed(const LinkageKind& kind, std::uint64_t seed) {
    const RandomLinkage linkage = random_linkage(kind, seed);
    const KnownMotion known = known_motion(linkage.ideal, linkage.size, kLooks);
    const Judgement as_chosen = judge(linkage, known, kLooks),
                    with_multipliers = judge(linkage, known, kLooks, model::LoopTreatment::kMultipliers);
    const double duration = kLooks.interval * double(kLooks.count);
    chosen.add(seed, as_chosen, duration);
    multipliers.add(seed, with_multipliers, duration);
    if (as_chosen.operations > 0 && with_multipliers.operations > 0)
      ratios.push_back(double(as_chosen.operations) / double(with_multipliers.operations));
  }

  void print(std::string_view name) const {
    chosen.print(name, fmt::format("{:>8.2f}", median(ratios)).c_str());
    multipliers.print("  with multipliers", "");
    for (const std::string& line : chosen.wrong) fmt::print("    wrong: seed {}\n", line);
    for (const std::string& line : multipliers.wrong)
      fmt::print("    wrong with multipliers: seed {}\n", line);
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0,
                      most = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : ~0ull;
  fmt::print("{:<24}{:>5}{:>5}{:>5}{:>7}{:>8}{:>8}{:>7}{:>7}{:>7}{:>10}{:>8}\n", "", "expl", "part", "mult",
             kOutcomeNames[0], kOutcomeNames[1], kOutcomeNames[2], kOutcomeNames[3], "unknown", "shorter",
             "drift", "cost");
  for (const LinkageKind& kind : linkage_kinds()) {
    if (!kind.name.starts_with(wanted)) continue;
    ClassResult result;
    for (std::uint64_t seed = first; seed < kind.count && seed - first < most; ++seed)
      result.judge_seed(kind, seed);
    result.print(kind.name);
  }
}
