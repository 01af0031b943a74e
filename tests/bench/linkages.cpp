// What the compiler does by default with a thousand random linkages that swing free for two seconds: how many
// are right, which are not, and what they cost beside multipliers and beside the cheapest choice of
// independent coordinates. Nothing is asserted here.
//
//   linkages [--quick] [CLASS [FIRST [COUNT]]]     classes whose names begin with CLASS, COUNT seeds from FIRST;
//                                                  quick: multipliers
//                                                  are tried only where what is chosen is not right
//
// Columns: treatments (closed form, Newton, multipliers); right, flagged (stopped by a guard, right until
// then), refused (diagnostics), wrong, unknown (no reference); lost: flagged or refused where multipliers
// finish right; right ones that need steps below 0.5 ms; judged for less than 2 s; largest drift of energy of
// right ones; a step's operations over those with multipliers (median) and, of planar linkages with one loop,
// over those of the cheapest single partition (median, largest).
// On the other stream: seeds that are not right, and why.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "loops/compiled_swing.hpp"
#include "loops/free_swing.hpp"

namespace {

using namespace jourdain;
using namespace jourdain::tests;

constexpr const char* kOutcomeNames[kOutcomes] = {"right", "flagged", "refused", "wrong", "unknown"};
constexpr Looks kLooks{0.05, 40};      // 2 s
constexpr double kUsualStep = 0.4e-3;  // s, between those that are tried first and second

const char* outcome_of(const Judgement& judgement) {
  return kOutcomeNames[static_cast<std::size_t>(judgement.outcome)];
}

bool is_stopped(const Judgement& judgement) {
  return judgement.outcome == Outcome::kFlagged || judgement.outcome == Outcome::kRefused;
}

/// One class, or all of them, under one treatment.
struct Tally {
  std::array<std::size_t, kOutcomes> outcomes{};
  std::array<std::size_t, 3> treatments{};  ///< explicit, partitioned, multipliers
  std::size_t lost = 0;                     ///< stopped where multipliers finish right
  std::size_t finer = 0;                    ///< right ones that need steps below 1 ms and its half
  std::size_t shortened = 0;                ///< judged for less than the whole time
  double worst_drift = 0;                   ///< of right ones

  void add(const Judgement& judgement) {
    ++outcomes[static_cast<std::size_t>(judgement.outcome)];
    if (judgement.operations == 0) return;
    const bool right = judgement.outcome == Outcome::kRight;
    ++treatments[static_cast<std::size_t>(judgement.treatment)];
    finer += right && judgement.step < kUsualStep;
    shortened += judgement.until < kLooks.interval * (double(kLooks.count) - 0.5);
    if (right) worst_drift = std::max(worst_drift, judgement.drift);
  }

  void add(const Tally& other) {
    for (std::size_t k = 0; k < kOutcomes; ++k) outcomes[k] += other.outcomes[k];
    for (std::size_t k = 0; k < treatments.size(); ++k) treatments[k] += other.treatments[k];
    lost += other.lost;
    finer += other.finer;
    shortened += other.shortened;
    worst_drift = std::max(worst_drift, other.worst_drift);
  }

  void print(std::string_view name, const std::string& cost = "        |                |") const {
    const std::size_t count = std::accumulate(outcomes.begin(), outcomes.end(), std::size_t(0));
    fmt::print("| {:<23} | {:>5} | {:>4} | {:>4} | {:>4} |", name, count, treatments[0], treatments[1],
               treatments[2]);
    for (std::size_t k = 0; k < kOutcomes; ++k) fmt::print(" {:>7} |", outcomes[k]);
    fmt::print(" {:>4} | {:>5} | {:>7} | {:>7.1e} |{}\n", lost, finer, shortened, worst_drift, cost);
  }
};

void print_heading() {
  fmt::print("| {:<23} | {:>5} | {:>4} | {:>4} | {:>4} |", "", "count", "expl", "part", "mult");
  for (const char* name : kOutcomeNames) fmt::print(" {:>7} |", name);
  fmt::print(" {:>4} | {:>5} | {:>7} | {:>7} | {:>6} | {:>14} |\n|---|", "lost", "finer", "shorter", "drift",
             "/ mult", "/ partitioned");
  for (int column = 0; column < 15; ++column) fmt::print("--:|");
  fmt::print("\n");
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Operations of a step with coordinates of these joints independent, with Newton iterations; 0 where that is refused.
std::size_t partitioned_operations(model::Mechanism mechanism, const std::vector<std::size_t>& joints) {
  mechanism.loop_options.treatment = model::LoopTreatment::kPartitioned;
  for (const std::size_t j : joints) mechanism.loop_options.independent.push_back({model::JointIndex(j), 0});
  const auto compiled = compiled_or_refused(mechanism);
  const auto* made = std::get_if<CompiledLinkage>(&compiled);
  return made ? CompiledSwing(mechanism, made->model).step_operations() : 0;
}

/// Operations of a step with the cheapest choice of independent coordinates, of joints with one coordinate
/// each; 0: there is none.
std::size_t cheapest_partition(const model::Mechanism& mechanism, std::size_t freedom) {
  std::size_t cheapest = 0;
  std::vector<bool> chosen(mechanism.joints.size(), false);
  std::fill_n(chosen.begin(), freedom, true);
  do {
    std::vector<std::size_t> joints;
    for (std::size_t j = 0; j < chosen.size(); ++j)
      if (chosen[j]) joints.push_back(j);
    const std::size_t operations = partitioned_operations(mechanism, joints);
    if (operations > 0 && (cheapest == 0 || operations < cheapest)) cheapest = operations;
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return cheapest;
}

struct ClassResult {
  Tally chosen, multipliers;
  std::vector<double> over_multipliers, over_partition;  ///< operations of a step as chosen over those
  std::vector<std::string> remarks;

  void judge_seed(const LinkageKind& kind, std::uint64_t seed, bool quick) {
    const RandomLinkage linkage = random_linkage(kind, seed);
    const KnownMotion known = known_motion(linkage.ideal, linkage.size, kLooks);
    const Judgement as_chosen = judge(linkage, known, kLooks);
    chosen.add(as_chosen);
    if (quick && as_chosen.outcome == Outcome::kRight) return;
    const Judgement with_multipliers = judge(linkage, known, kLooks, model::LoopTreatment::kMultipliers);
    multipliers.add(with_multipliers);
    chosen.lost += is_stopped(as_chosen) && with_multipliers.outcome == Outcome::kRight;
    remark(seed, linkage, as_chosen, with_multipliers);
    if (as_chosen.operations == 0) return;
    if (with_multipliers.operations > 0)
      over_multipliers.push_back(double(as_chosen.operations) / double(with_multipliers.operations));
    if (kind.kind > LinkageClass::kFiveBar) return;
    if (const std::size_t operations = cheapest_partition(linkage.mechanism, as_chosen.freedom))
      over_partition.push_back(double(as_chosen.operations) / double(operations));
  }

  void remark(std::uint64_t seed, const RandomLinkage& linkage, const Judgement& as_chosen,
              const Judgement& with_multipliers) {
    const bool noted = is_stopped(as_chosen) || as_chosen.outcome == Outcome::kWrong ||
                       with_multipliers.outcome == Outcome::kWrong;
    if (!noted) return;
    const auto words = [](const Judgement& judgement) {
      return fmt::format("{} {}", outcome_of(judgement), judgement.why.substr(0, judgement.why.find('\n')));
    };
    remarks.push_back(fmt::format("{}, perturbed by {:.0e}: {}; multipliers: {}", seed, linkage.perturbation,
                                  words(as_chosen), words(with_multipliers)));
  }

  std::string cost() const {
    const std::string beside =
        over_multipliers.empty() ? "" : fmt::format("{:.2f}", median(over_multipliers));
    std::string partition;
    if (!over_partition.empty())
      partition = fmt::format("{:.2f}, {:.2f}", median(over_partition),
                              *std::max_element(over_partition.begin(), over_partition.end()));
    return fmt::format(" {:>6} | {:>14} |", beside, partition);
  }

  void print(std::string_view name) const {
    chosen.print(name, cost());
    multipliers.print("with multipliers");
    std::fflush(stdout);
    for (const std::string& line : remarks) fmt::print(stderr, "{}: {}\n", name, line);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && argv[1] == std::string_view("--quick");
  if (quick) --argc, ++argv;
  const std::string wanted = argc > 1 ? argv[1] : "";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0,
                      most = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : ~0ull;
  print_heading();
  Tally chosen, multipliers;
  for (const LinkageKind& kind : linkage_kinds()) {
    if (!kind.name.starts_with(wanted)) continue;
    ClassResult result;
    for (std::uint64_t seed = first; seed < kind.count && seed - first < most; ++seed)
      result.judge_seed(kind, seed, quick);
    result.print(kind.name);
    chosen.add(result.chosen);
    multipliers.add(result.multipliers);
  }
  chosen.print("all");
  multipliers.print("with multipliers");
}
