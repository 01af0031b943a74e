// Derivatives of equations with multipliers: by the equations that these solve, and points that are looked for held.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/plan/plan.hpp"
#include "model/read/read.hpp"
#include "passes/pipeline.hpp"
#include "programs/closed_system.hpp"
#include "properties/effort.hpp"
#include "properties/random_rolling.hpp"
#include "validate/loops/validation.hpp"

namespace jourdain::tests {
namespace {

/// A mechanism with loops, its residual's derivatives and what validates them.
struct Differentiated {
  explicit Differentiated(model::Mechanism of) : mechanism(std::move(of)) {
    support::Diagnostics diagnostics("model", "");
    plan = loops::plan_loops(mechanism, diagnostics).value();
    const programs::ClosedSystem closed(mechanism, {}, plan);
    const auto functions = programs::derivative_programs(
        closed.derivative_sources(),
        programs::with_needed({"residual_derivatives"}, programs::scene_facts(mechanism, &plan)),
        programs::DerivativeTerms::kAll);
    module.functions = functions;
    module = passes::optimise(std::move(module)).module;
  }

  bool is_refused() const {
    return !validate::validate_closed(mechanism, dynamics::derive_equations(mechanism, {}), module, plan)
                .failures.empty();
  }

  model::Mechanism mechanism;
  loops::LoopPlan plan;
  ir::Module module;
};

TEST(LoopDerivatives, TakeTheWayWithFewerOperations) {
  const auto operations = [](const char* model) {
    return ClosedPrograms(read_model(model_path(model)), true).operations("linearize");
  };
  EXPECT_EQ(operations("n_four_bar.toml"), 1814u);  // 2601 by the operations that multipliers are computed in
  EXPECT_EQ(operations("rolling_disc.toml"), 1299u);
  EXPECT_EQ(operations("rolling_hills.toml"), 4841u);  // 12161 through those and the search, too
  EXPECT_EQ(operations("sleigh.toml"), 88u);           // by the operations
}

TEST(LoopDerivatives, ByTheEquationsWithPlantedFaultsAreRefused) {
  Differentiated correct(read_model(model_path("n_four_bar.toml")));
  EXPECT_FALSE(correct.is_refused());
  constexpr std::size_t kFaults = 16;
  const std::size_t count = correct.module.functions[0].nodes.size();
  std::size_t planted = 0;
  for (std::size_t k = 0; k < kFaults; ++k)
    for (std::size_t i = (2 * k + 1) * count / (2 * kFaults); i < count; ++i) {
      ir::Node& node = correct.module.functions[0].nodes[i];
      const ir::Node before = node;
      if (node.op == ir::Op::kAdd)
        node.op = ir::Op::kSubtract;
      else if (node.op == ir::Op::kSubtract)
        std::swap(node.a, node.b);
      else if (node.op == ir::Op::kMultiply && node.a != node.b)
        node.b = node.a;
      else
        continue;
      EXPECT_TRUE(correct.is_refused()) << "value " << i;
      node = before;
      ++planted;
      break;
    }
  EXPECT_EQ(planted, kFaults);
}

TEST(LoopDerivatives, OfRandomMechanismsThatRollAreDifferences) {
  for (std::uint64_t seed = 0; seed < cases(16); ++seed)
    EXPECT_FALSE(Differentiated(random_rolling(seed)).is_refused()) << "seed " << seed;
}

/// Ground that is flat: the search ends where it begins, at a value that much else follows from.
TEST(LoopDerivatives, OfWhatRollsOnAFlatHeightAreThoseOnThePlane) {
  const auto rolling = [](const std::string& round, const std::string& ground) {
    const std::string text =
        "[model]\nname = \"rolls\"\n[[body]]\nname = \"body\"\nmass = 2\ninertia = [0.13, 0.14, 0.15]\n"
        "[[joint]]\nname = \"root\"\ntype = \"free\"\nparent = \"world\"\nchild = \"body\"\n"
        "initial_position = [0, 0, 0.4]\n[[constraint]]\nname = \"ground\"\nframe = \"body\"\n" +
        round + ground;
    support::Diagnostics diagnostics("rolls.toml", text);
    auto mechanism = model::read_mechanism(diagnostics, {});
    EXPECT_TRUE(mechanism) << diagnostics.format();
    return mechanism.value();
  };
  const std::string round = "type = \"rolling_ball\"\nradius = 0.4\n";
  for (const auto& [height, normal] :
       {std::pair("height = \"0*x\"\n", ""), std::pair("height = \"0.3*x\"\n", "normal = [-0.3, 0, 1]\n")}) {
    const ClosedPrograms on_height(rolling(round, height), true), on_plane(rolling(round, normal), true);
    const std::vector<double>& y = on_plane.plan().y;
    const std::vector<double> z = {0.3, -0.2, 0.1, 0.7, 0.4, -0.5};
    const auto A = on_height.values("linearize", 0, on_height.plan().y, z, {});
    double worst = 0;
    for (const auto& [name, value] : on_plane.values("linearize", 0, y, z, {})) {
      const auto it = A.find(name);
      worst = std::max(worst, std::fabs((it == A.end() ? 0 : it->second) - value));
    }
    EXPECT_LT(worst, 1e-11) << round << height;
  }
}

}  // namespace
}  // namespace jourdain::tests
