// Faults planted in the finished files, after templates: read back, each is another model, or it says the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compile/expected_text.hpp"
#include "mutants/scenes.hpp"
#include "mutants/subject.hpp"
#include "mutants/tally.hpp"
#include "mutants/text_mutants.hpp"
#include "properties/effort.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

/// A model that was written, and what its files must say.
struct Written {
  model::Mechanism mechanism;
  CompileOptions options;
  dynamics::Equations equations;
  CompiledModel compiled;
};

/// With every function and a stepper of each kind.
Written written(const model::Mechanism& mechanism) {
  Written result{mechanism, {}, dynamics::derive_equations(mechanism), {}};
  result.options.name = "planted";
  for (const char* function :
       {"linearize", "forward_dynamics_derivatives", "rk5_step", "adams_bashforth3_step", "rodas4_step"})
    result.options.functions.push_back(function);
  result.options.loops = plan_of(mechanism);
  result.compiled = compile(mechanism, result.options);
  EXPECT_TRUE(result.compiled.verdict.accepted());
  return result;
}

bool is_noticed(const Written& w, const std::vector<support::FileText>& files) {
  readback::Expected expected = w.compiled.expected;
  expected.module = &w.compiled.module;
  return !readback::differences(files, expected).empty();
}

Tally attacked(const std::vector<Written>& models, std::size_t each) {
  Tally tally("text");
  for (std::size_t f = 0; f < kTextFaults; ++f) {
    const auto fault = static_cast<TextFault>(f);
    Random random(f + 31);
    std::vector<std::pair<const Written*, TextSite>> places;
    for (const Written& model : models)
      for (const TextSite& site : sites(model.compiled.files, fault)) places.push_back({&model, site});
    for (std::size_t k = 0; k < each && !places.empty(); ++k) {
      std::swap(places[random.below(places.size())], places.back());
      const auto [model, site] = places.back();
      places.pop_back();
      const auto& files = model->compiled.files;
      const auto mutant = planted(files, site, random.bits());
      const Net accepted = same_because(files, site).empty() ? Net::kNone : Net::kSame;
      tally.add(name_of(fault), is_noticed(*model, mutant) ? Net::kReadback : accepted,
                model->mechanism.name + " " + line_of(files, site) + " -> " + line_of(mutant, site));
    }
  }
  fmt::print("{}", tally.text());
  return tally;
}

TEST(PlantedFaults, InText) {
  std::vector<Written> models;
  for (const model::Mechanism& scene :
       {tree_scenes()[0], tree_scenes()[4], loop_scenes()[0], loop_scenes()[5]})
    models.push_back(written(scene));
  for (const Written& model : models) EXPECT_FALSE(is_noticed(model, model.compiled.files));
  const Tally tally = attacked(models, cases(60));
  EXPECT_EQ(tally.count(Net::kNone), 0u);
  EXPECT_GE(tally.count(), cases(11 * 50));
}

}  // namespace
}  // namespace jourdain::tests
