// The equations and programs of a changed mechanism, offered as those of the original: the numeric reference,
// which takes the mechanism as read, has to see it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "agreement/judge.hpp"
#include "mutants/mechanism_mutants.hpp"
#include "mutants/scenes.hpp"
#include "mutants/subject.hpp"
#include "mutants/tally.hpp"
#include "properties/effort.hpp"
#include "properties/random.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;
using Vector = reference::VectorX<Long>;

constexpr std::size_t kStates = 6;  ///< at which a mechanism that is accepted must be the original one
constexpr double kSame = 1e-17;     ///< of long double, and of what a term sum has at most
constexpr double kHalfUlp = 0x1p-53;

Vector vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size())).cast<Long>();
}

/// All that the numeric references compute of a mechanism at one state.
std::vector<Vector> everything(const model::Mechanism& mechanism, const Sample& sample) {
  const std::vector<Long> parameters(sample.parameters.begin(), sample.parameters.end());
  const reference::Reference<Long> reference(mechanism, parameters);
  const reference::State<Long> state{sample.t, vector(sample.y), vector(sample.z)};
  const auto terms = reference.evaluate(state, vector(sample.u));
  std::vector<Vector> list = {terms.M.reshaped(), terms.k_bar, terms.q_bar,
                              Vector::Constant(1, terms.kinetic_energy),
                              Vector::Constant(1, terms.potential_energy)};
  const reference::State<Long> start = reference.initial_state();
  list.push_back(start.y);
  list.push_back(start.z);
  const Vector zdot = vector(sample.zdot);
  for (const auto& output : reference.outputs(state, vector(sample.u), zdot, zdot.cwiseAbs()))
    list.push_back(Eigen::Map<const Vector>(output.values.data(), Eigen::Index(output.values.size())));
  if (!mechanism.loops.empty()) {
    const auto constraints = reference::DescriptorReference<Long>(mechanism)
                                 .solve(state.t, state.y, state.z, vector(sample.u))
                                 .loops;
    list.push_back(constraints.G.reshaped());
    list.push_back(constraints.g);
  }
  return list;
}

/// The largest difference of a quantity, relative to its size.
double difference(const model::Mechanism& a, const model::Mechanism& b) {
  double worst = 0;
  for (std::uint64_t seed = 0; seed < kStates; ++seed) {
    const Sample sample = random_sample(a, seed);
    const auto of_a = everything(a, sample), of_b = everything(b, sample);
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      if (of_a[i].size() != of_b[i].size()) return INFINITY;
      const Long size = of_a[i].lpNorm<Eigen::Infinity>(),
                 apart = (of_a[i] - of_b[i]).lpNorm<Eigen::Infinity>();
      if (apart > 0) worst = std::max(worst, size > 0 ? double(apart / size) : INFINITY);
    }
  }
  return worst;
}

Net net_of(const model::Mechanism& original, const std::optional<loops::LoopPlan>& plan,
           const model::Mechanism& mutant) {
  try {
    const dynamics::Equations equations = dynamics::derive_equations(mutant);
    if (!plan && refuses(original, equations, plan, {})) return Net::kReference;
    if (refuses(original, equations, plan, programs_of(mutant, equations, plan))) return Net::kValidation;
  } catch (const std::exception&) {
    return Net::kAssertion;
  }
  const double apart = difference(original, mutant);
  return apart <= kSame ? Net::kEquivalent : apart <= kHalfUlp ? Net::kBelowRounding : Net::kNone;
}

Tally attacked(const std::string& stage, const std::vector<model::Mechanism>& scenes, std::size_t each) {
  Tally tally(stage);
  std::map<std::string, std::vector<std::pair<std::size_t, MechanismMutant>>> by_fault;
  std::vector<std::optional<loops::LoopPlan>> plans;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    plans.push_back(plan_of(scenes[i]));
    for (MechanismMutant& mutant : mechanism_mutants(scenes[i]))
      by_fault[mutant.fault].push_back({i, std::move(mutant)});
  }
  Random random(5);
  for (auto& [fault, list] : by_fault)
    for (std::size_t k = 0; k < each && !list.empty(); ++k) {
      std::swap(list[random.below(list.size())], list.back());
      const auto& [scene, mutant] = list.back();
      tally.add(fault, net_of(scenes[scene], plans[scene], mutant.mechanism),
                scenes[scene].name + ", " + mutant.where);
      list.pop_back();
    }
  fmt::print("{}", tally.text());
  return tally;
}

TEST(PlantedFaults, InMechanisms) {
  const Tally tally = attacked("mechanisms", tree_scenes(), cases(60));
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), cases(4 * 50));
}

TEST(PlantedFaults, InMechanismsWithLoops) {
  const std::size_t each = draws_all_cases() ? 50 : 5;  // a mutant takes seconds
  const Tally tally = attacked("mechanisms with loops", loop_scenes(), each);
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), 4 * each);
}

}  // namespace
}  // namespace jourdain::tests
