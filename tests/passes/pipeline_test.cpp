// The pipeline on all models with every function: passes are idempotent, so is the whole, and the programs stay sound.
#include "passes/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "compile/module_check.hpp"
#include "ir/builder.hpp"
#include "passes/random_program.hpp"
#include "properties/effort.hpp"

namespace jourdain::passes {
namespace {

using tests::random_program;

constexpr std::uint64_t kPrograms = 300;

std::string text(const ir::Module& module) {
  std::string all = print(module.constants);
  for (const ir::Program& program : module.functions) all += print(program);
  return all;
}

/// Each pass on its own result, in the pipeline's order, and the pipeline on its own.
void expect_idempotent(const ir::Module& lowered, const std::string& what) {
  ir::Module module = lowered;
  for (const Pass& pass : pipeline()) {
    module = pass.run(module);
    EXPECT_TRUE(text(pass.run(module)) == text(module)) << pass.name << " of " << what;
  }
  std::vector<std::string> last;
  for (const Pass& pass : pipeline())
    if (pass.is_last) last.emplace_back(pass.name);
  const ir::Module optimised = optimise(lowered, last).module;
  EXPECT_TRUE(text(optimise(optimised, last).module) == text(optimised)) << what;
}

TEST(Passes, AreIdempotentOnRandomPrograms) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed)
    expect_idempotent({{}, {random_program(seed)}}, std::to_string(seed));
}

std::vector<double> values(const ir::Module& module, ir::LeafValues<double> leaves) {
  leaves[ir::LeafKind::kConstant] = ir::interpret(module.constants, leaves);
  return ir::interpret(module.functions[0], leaves);
}

TEST(Passes, KeepValuesAsFarAsTheySay) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    ir::Module module{{}, {random_program(seed)}};
    const ir::LeafValues<double> leaves = tests::random_leaves(seed);
    for (const Pass& pass : pipeline()) {
      const std::vector<double> before = values(module, leaves);
      module = pass.run(module);
      const std::vector<double> after = values(module, leaves);
      for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_NEAR(after[k], before[k],
                    pass.effect == Effect::kExact ? 0 : 1e-9 * (1 + std::fabs(before[k])))
            << pass.name << " of " << seed;
    }
  }
}

/// The programs of a model with every function, as lowered and after each pass.
struct History {
  CompiledModel compiled;
  std::vector<std::pair<std::string, ir::Module>> modules;
};

History history(const model::Mechanism& mechanism) {
  History result;
  CompileOptions options;
  options.functions = programs::function_names();
  options.watch = [&](const PassRecord& record, const ir::Module& module) {
    result.modules.emplace_back(record.name, module);
  };
  result.compiled = compile(mechanism, options);
  return result;
}

TEST(Passes, AreIdempotentAndKeepProgramsSoundOnEveryModel) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(tests::model_path("")))
    if (entry.path().extension() == ".toml") paths.insert(entry.path());
  std::size_t number = 0;
  for (const std::filesystem::path& path : paths) {
    if (!tests::draws(number++, 6)) continue;
    const model::Mechanism mechanism = tests::read_model(path);
    const History passed = history(mechanism);
    ASSERT_GT(passed.modules.size(), pipeline().size()) << path;
    expect_idempotent(passed.modules[0].second, path.stem());
    for (std::size_t k = 1; k < passed.modules.size(); ++k)
      EXPECT_EQ(module_defects(passed.modules[k].second, passed.compiled.facts), std::vector<std::string>())
          << passed.modules[k].first << " of " << path;
  }
}

TEST(Passes, KeepRandomProgramsSound) {
  programs::SceneFacts scene;
  scene.positions = {"a", "b", "c"};
  scene.parameters.resize(3);
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    ir::Program program = random_program(seed);
    program.name = "k_bar";  // whose arguments it takes
    optimise({{}, {program}}, {}, [&](const PassRecord& record, const ir::Module& module) {
      EXPECT_EQ(module_defects(module, scene), std::vector<std::string>()) << record.name << " of " << seed;
    });
  }
}

TEST(Pipeline, RecordsWhatEachPassDid) {
  const Optimised result = optimise({{}, {random_program(7)}});
  ASSERT_GE(result.records.size(), pipeline().size());
  EXPECT_EQ(result.records.back().name, "order_terms");
  EXPECT_EQ(result.records.back().operations_after, arithmetic(result.module));
  for (std::size_t k = 1; k < result.records.size(); ++k)
    EXPECT_EQ(result.records[k].operations_before, result.records[k - 1].operations_after);
  for (const PassRecord& record : optimise({{}, {random_program(7)}}, {"factor"}).records)
    EXPECT_NE(record.name, "factor");
}

TEST(Pipeline, ComesToRest) {
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed)
    EXPECT_LE(optimise({{}, {random_program(seed)}}).records.back().round, 5) << seed;
}

}  // namespace
}  // namespace jourdain::passes
