// What one iteration of closing leaves open, from states that are open by several sizes: the square, up to a
// factor of the linkage.
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/shared_data.hpp"
#include "loops/loop_functions.hpp"

namespace jourdain::tests {
namespace {

/// The four-bar of models/four_bar.toml closed in this way, one Newton iteration at a time.
model::Mechanism four_bar(model::LoopTreatment treatment) {
  model::Mechanism mechanism = read_model(model_path("four_bar.toml"));
  mechanism.loop_options.treatment = treatment;
  if (treatment == model::LoopTreatment::kMultipliers) mechanism.loop_options.independent.clear();
  mechanism.loop_options.iterations = 1;
  return mechanism;
}

/// How far coupler's and rocker's ends are apart, m.
double open(const std::vector<double>& y) {
  const double a = y[0], b = y[0] + y[1], c = y[2];
  return std::hypot(0.12 * std::cos(a) + 0.36 * std::cos(b) - 0.4 - 0.24 * std::cos(c),
                    0.12 * std::sin(a) + 0.36 * std::sin(b) - 0.24 * std::sin(c));
}

constexpr double kRounding = 1e-15;
/// Second derivatives of the rows are at most 0.36 + 0.36 + 0.24 m, the inverse of G at these states 10/m:
/// |g'| ≤ ½ 0.96 (10 |g|)².
constexpr double kFactor = 50;

TEST(Contraction, NewtonsIterationsSquareTheOpening) {
  const LoopFunctions functions(four_bar(model::LoopTreatment::kPartitioned));
  for (const double off : {0.05, -0.03, 1e-2, 1e-3, 1e-4, 1e-6}) {
    std::vector<double> y = functions.plan().y;
    y[1] += off;
    y[2] -= off / 2;
    for (int i = 0; i < 3; ++i) {
      const double before = open(y);
      y = functions.closed("close_loops", y);
      EXPECT_LE(open(y), kFactor * before * before + kRounding) << off << ", iteration " << i;
    }
    EXPECT_LE(open(y), 1e-10) << off;
  }
}

TEST(Contraction, ProjectionsSquareTheOpening) {
  const LoopFunctions functions(four_bar(model::LoopTreatment::kMultipliers));
  for (const double off : {0.05, -0.03, 1e-2, 1e-3, 1e-4}) {
    std::vector<double> y = functions.plan().y;
    y[0] += off;
    y[1] += off;
    y[2] -= off / 2;
    const double before = open(y);
    y = functions.closed("project", y);
    // Regularisation leaves a share of it.
    EXPECT_LE(open(y), kFactor * before * before + 1e-8 * before + kRounding) << off;
  }
}

TEST(Contraction, ClosedFormsCloseFromAnywhere) {
  const LoopFunctions functions(four_bar(model::LoopTreatment::kExplicit));
  for (const double off : {0.5, 0.05, -0.03, 1e-3}) {
    std::vector<double> y = functions.plan().y;
    y[1] += off;
    y[2] -= off / 2;
    EXPECT_LE(open(functions.closed("close_loops", y)), kRounding) << off;
  }
}

}  // namespace
}  // namespace jourdain::tests
