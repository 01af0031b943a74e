// What the compiler does by default with a thousand random linkages that swing free for two seconds: how many are right, which are
// not, and what they cost beside multipliers. Nothing is asserted here.
//
//   linkages [CLASS [FIRST [COUNT]]]     classes whose names begin with CLASS, COUNT seeds from FIRST
//
// Columns: treatments (closed form, Newton, multipliers); right, flagged (stopped by a guard, right until then), refused
// (diagnostics), wrong, unknown (no reference); right ones that need steps below 0.5 ms; judged for less than 2 s; largest drift of
// energy of right ones; median of a step's operations over those with multipliers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "loops/free_swing.hpp"

namespace {

using namespace jourdain;
using namespace jourdain::tests;

constexpr const char* kTreatments[] = {"explicit", "partitioned", "multipliers"};
constexpr Looks kLooks{0.05, 40};      // 2 s
constexpr double kUsualStep = 0.4e-3;  // s, between those that are tried first and second

/// One class, or all of them, under one treatment.
struct Tally {
  std::array<std::size_t, kOutcomes> outcomes{};
  std::array<std::size_t, 3> treatments{};  ///< explicit, partitioned, multipliers
  std::size_t finer = 0;                    ///< right ones that need steps below 1 ms and its half
  std::size_t shortened = 0;                ///< judged for less than the whole time
  double worst_drift = 0;                   ///< of right ones
  std::vector<std::string> remarks;

  void add(std::uint64_t seed, const RandomLinkage& linkage, const Judgement& judgement) {
    ++outcomes[static_cast<std::size_t>(judgement.outcome)];
    const bool right = judgement.outcome == Outcome::kRight;
    if (judgement.outcome == Outcome::kWrong)
      remarks.push_back(fmt::format("wrong ({}): {}: {}",
                                    kTreatments[static_cast<std::size_t>(judgement.treatment)], seed,
                                    judgement.why));
    if (judgement.outcome == Outcome::kRefused && linkage.perturbation == 0)
      remarks.push_back(
          fmt::format("refused: {}: {}", seed, judgement.why.substr(0, judgement.why.find('\n'))));
    if (judgement.operations == 0) return;
    ++treatments[static_cast<std::size_t>(judgement.treatment)];
    finer += right && judgement.step < kUsualStep;
    shortened += judgement.until < kLooks.interval * (double(kLooks.count) - 0.5);
    if (right) worst_drift = std::max(worst_drift, judgement.drift);
  }

  void add(const Tally& other) {
    for (std::size_t k = 0; k < kOutcomes; ++k) outcomes[k] += other.outcomes[k];
    for (std::size_t k = 0; k < treatments.size(); ++k) treatments[k] += other.treatments[k];
    finer += other.finer;
    shortened += other.shortened;
    worst_drift = std::max(worst_drift, other.worst_drift);
  }

  void print(std::string_view name, const std::string& cost = "") const {
    const std::size_t count = std::accumulate(outcomes.begin(), outcomes.end(), std::size_t(0));
    fmt::print("{:<24}{:>6}{:>6}{:>6}{:>6}{:>7}{:>8}{:>8}{:>7}{:>8}{:>7}{:>9}{:>10.1e}{:>7}\n", name, count,
               treatments[0], treatments[1], treatments[2], outcomes[0], outcomes[1], outcomes[2],
               outcomes[3], outcomes[4], finer, shortened, worst_drift, cost);
  }
};

void print_heading() {
  fmt::print("{:<24}{:>6}{:>6}{:>6}{:>6}{:>7}{:>8}{:>8}{:>7}{:>8}{:>7}{:>9}{:>10}{:>7}\n", "", "count",
             "expl", "part", "mult", "right", "flagged", "refused", "wrong", "unknown", "finer", "shorter",
             "drift", "cost");
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct ClassResult {
  Tally chosen, multipliers;
  std::vector<double> ratios;  ///< operations of a step as chosen over those with multipliers

  void judge_seed(const LinkageKind& kind, std::uint64_t seed) {
    const RandomLinkage linkage = random_linkage(kind, seed);
    const KnownMotion known = known_motion(linkage.ideal, linkage.size, kLooks);
    const Judgement as_chosen = judge(linkage, known, kLooks),
                    with_multipliers = judge(linkage, known, kLooks, model::LoopTreatment::kMultipliers);
    chosen.add(seed, linkage, as_chosen);
    multipliers.add(seed, linkage, with_multipliers);
    if (as_chosen.operations > 0 && with_multipliers.operations > 0)
      ratios.push_back(double(as_chosen.operations) / double(with_multipliers.operations));
  }

  void print(std::string_view name) const {
    chosen.print(name, fmt::format("{:.2f}", median(ratios)));
    multipliers.print("  with multipliers");
    for (const std::string& line : chosen.remarks) fmt::print("    {}\n", line);
    for (const std::string& line : multipliers.remarks) fmt::print("    with multipliers {}\n", line);
    std::fflush(stdout);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0,
                      most = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : ~0ull;
  print_heading();
  Tally chosen, multipliers;
  for (const LinkageKind& kind : linkage_kinds()) {
    if (!kind.name.starts_with(wanted)) continue;
    ClassResult result;
    for (std::uint64_t seed = first; seed < kind.count && seed - first < most; ++seed)
      result.judge_seed(kind, seed);
    result.print(kind.name);
    chosen.add(result.chosen);
    multipliers.add(result.multipliers);
  }
  chosen.print("all");
  multipliers.print("  with multipliers");
}
