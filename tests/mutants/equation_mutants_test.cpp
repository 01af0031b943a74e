// Faults planted in the derivation's statements. Programs follow them, so that no comparison of programs with
// statements sees a fault: the numeric reference has to, but for what only some functions are made of.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/high_precision.hpp"
#include "mutants/equation_mutants.hpp"
#include "mutants/exact_values.hpp"
#include "mutants/scenes.hpp"
#include "mutants/tally.hpp"
#include "properties/effort.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

using kinematics::Ex;
using kinematics::LeafKind;

constexpr std::size_t kStates = 6;  ///< at which equations that are accepted must be the original ones
constexpr double kSame = 1e-40;     ///< of 60 digits
constexpr double kHalfUlp = 0x1p-53;

/// Values of everything at one state, list by list.
std::vector<std::vector<Exact>> values(const dynamics::Equations& e, const ir::LeafValues<double>& leaves) {
  const dynamics::HighPrecision exact(e.statements,
                                      [&](LeafKind kind, std::size_t i) { return leaves[kind].at(i); });
  std::vector<std::vector<Exact>> all;
  for (const std::vector<Ex>& list : asked_for(e)) {
    all.emplace_back();
    for (const Ex& value : list) all.back().push_back(exact.value(value).value());
  }
  return all;
}

double difference(const Subject& subject, const dynamics::Equations& mutant) {
  double worst = 0;
  for (const ir::LeafValues<double>& state : random_states(subject, kStates)) {
    const auto expected = values(subject.equations, state), actual = values(mutant, state);
    for (std::size_t i = 0; i < expected.size(); ++i) worst = std::max(worst, apart(expected[i], actual[i]));
  }
  return worst;
}

Net net_of(const Subject& subject, const dynamics::Equations& mutant) {
  try {
    if (refuses(subject.mechanism, mutant, {}, {})) return Net::kReference;
    if (refuses(subject.mechanism, mutant, {}, programs_of(subject.mechanism, mutant, {})))
      return Net::kValidation;
  } catch (const std::exception&) {
    return Net::kAssertion;
  }
  const double apart = difference(subject, mutant);
  return apart <= kSame ? Net::kEquivalent : apart <= kHalfUlp ? Net::kBelowRounding : Net::kNone;
}

TEST(PlantedFaults, InStatements) {
  const std::vector<Subject> subjects = tree_subjects();
  std::vector<std::vector<std::size_t>> live;
  for (const Subject& subject : subjects) live.push_back(live_statements(subject.equations));
  Tally tally("statements");
  for (std::size_t f = 0; f < kStatementFaults; ++f) {
    const auto fault = static_cast<StatementFault>(f);
    Random random(f + 11);
    for (std::size_t found = 0, tries = 0; found < cases(60) && tries < 2000; ++tries) {
      const Subject& subject = subjects[tries % subjects.size()];
      const std::vector<std::size_t>& places = live[tries % subjects.size()];
      const std::size_t at = places[random.below(places.size())];
      const auto mutant = planted(subject.equations, fault, at, random.bits());
      if (!mutant) continue;
      ++found;
      tally.add(name_of(fault), net_of(subject, *mutant),
                subject.name + " " + subject.equations.statements.all()[at].name.get_name());
    }
  }
  fmt::print("{}", tally.text());
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), cases(6 * 50));
}

}  // namespace
}  // namespace jourdain::tests
