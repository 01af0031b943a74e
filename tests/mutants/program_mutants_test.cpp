// Faults planted in the optimised programs of every function: the compiler refuses to write each of them, or
// it is none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "agreement/shared_data.hpp"
#include "mutants/exact_values.hpp"
#include "mutants/program_mutants.hpp"
#include "mutants/scenes.hpp"
#include "mutants/subject.hpp"
#include "mutants/tally.hpp"
#include "properties/effort.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

constexpr std::size_t kStates = 12;  ///< at which a program that is accepted must be the original one
constexpr double kSame = 1e-40;      ///< of 60 digits
constexpr double kHalfUlp = 0x1p-53;

struct Place {
  const Subject* subject = nullptr;
  const ir::Program* program = nullptr;
  ProgramSite site;
};

/// States are closed and of unit length to the rounding of doubles.
constexpr double kLawful = 1e-14;

/// The module with one function, another one in its place. What the constants feed is the whole module.
ir::Module with(const Subject& subject, const ir::Program* original, ir::Program mutant) {
  if (original == &subject.module.constants) return {std::move(mutant), subject.module.functions};
  return {subject.module.constants, {std::move(mutant)}};
}

/// How far a mutant is from its original at random states, relative to the largest value of the same list.
struct Difference {
  double here = 0, result = 0;  ///< of what was changed, of the outputs
};

/// What was changed: the value of a node that is another operation, or that stands for another one; an output.
std::pair<Exact, Exact> changed_value(const Place& place, const std::vector<Exact>& original,
                                      const ir::Program& mutant, const std::vector<Exact>& nodes) {
  const std::size_t at = place.site.at;
  if (place.site.fault >= ProgramFault::kOtherOutput)
    return {original[place.program->outputs[at].value.value], nodes[mutant.outputs[at].value.value]};
  const bool bypass = place.site.fault == ProgramFault::kBypass;
  return {original[at], nodes[bypass ? place.program->nodes[at].a.value : at]};
}

Difference difference(const Place& place, const ir::Program& mutant,
                      const std::vector<ir::LeafValues<double>>& states) {
  Difference worst;
  const Subject& subject = *place.subject;
  for (const ir::LeafValues<double>& state : states) {
    ir::LeafValues<Exact> leaves = to_exact(state);
    const auto constants = exact_values(subject.module.constants, leaves);
    if (!constants) continue;
    leaves[ir::LeafKind::kConstant] = *constants;
    const auto expected = exact_nodes(*place.program, leaves), actual = exact_nodes(mutant, leaves);
    if (!expected && !actual) continue;
    if (!expected || !actual) return {INFINITY, INFINITY};
    const auto [before, after] = changed_value(place, *expected, mutant, *actual);
    worst.here = std::max(worst.here, apart({before}, {after}));
    worst.result =
        std::max(worst.result, apart(outputs_of(*place.program, *expected), outputs_of(mutant, *actual)));
  }
  return worst;
}

Net net_of(const Place& place, const ir::Program& mutant) {
  const Subject& s = *place.subject;
  try {
    if (refuses(s.mechanism, s.equations, s.plan, with(s, place.program, mutant))) return Net::kValidation;
  } catch (const std::exception&) {
    return Net::kAssertion;
  }
  // Derivatives of closed states and of turning bodies are no others elsewhere: they are promised there.
  const bool is_derivative =
      place.program->name == "linearize" || place.program->name.ends_with("_derivatives");
  if (is_derivative && difference(place, mutant, lawful_states(s, kStates)).result <= kLawful)
    return Net::kEquivalent;
  const Difference apart = difference(place, mutant, random_states(s, kStates));
  if (apart.here <= kSame && apart.result <= kSame) return Net::kSame;
  return apart.result <= kSame      ? Net::kEquivalent
         : apart.result <= kHalfUlp ? Net::kBelowRounding
                                    : Net::kNone;
}

/// Up to `count` places, seeded, the same number of each function as far as it has them.
std::vector<Place> chosen(const std::vector<Subject>& subjects, ProgramFault fault, std::size_t count) {
  std::map<std::string, std::vector<Place>> by_function;
  for (const Subject& subject : subjects) {
    const auto collect = [&](const ir::Program& program, const std::string& name) {
      for (const ProgramSite& site : sites(program, fault))
        by_function[name].push_back({&subject, &program, site});
    };
    for (const ir::Program& program : subject.module.functions) collect(program, program.name);
    collect(subject.module.constants, "constants");
  }
  Random random(static_cast<std::uint64_t>(fault) + 1);
  std::vector<Place> places;
  for (bool left = true; left && places.size() < count;) {
    left = false;
    for (auto& [name, list] : by_function) {
      if (list.empty() || places.size() == count) continue;
      std::swap(list[random.below(list.size())], list.back());
      places.push_back(list.back());
      list.pop_back();
      left = true;
    }
  }
  return places;
}

Tally attacked(const std::string& stage, const std::vector<Subject>& subjects, std::size_t count) {
  Tally tally(stage);
  for (std::size_t f = 0; f < kProgramFaults; ++f) {
    const auto fault = static_cast<ProgramFault>(f);
    std::uint64_t seed = 0;
    for (const Place& place : chosen(subjects, fault, count)) {
      const ir::Program mutant = planted(*place.program, place.site, ++seed);
      const bool constants = place.program == &place.subject->module.constants;
      tally.add(name_of(fault), net_of(place, mutant),
                fmt::format("{} {} {} {} operand {}", place.subject->name,
                            constants ? "constants" : place.program->name,
                            fault >= ProgramFault::kOtherOutput ? "output" : "value", place.site.at,
                            place.site.operand));
    }
  }
  fmt::print("{}", tally.text());
  return tally;
}

TEST(PlantedFaults, InProgramsOfTrees) {
  const Tally tally = attacked("programs of trees", tree_subjects(), cases(80));
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), cases(12 * 50));
}

TEST(PlantedFaults, InProgramsOfLoops) {
  const Tally tally = attacked("programs of loops", loop_subjects(), cases(60));
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), cases(12 * 50));
}

}  // namespace
}  // namespace jourdain::tests
