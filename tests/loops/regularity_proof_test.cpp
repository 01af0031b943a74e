#include "loops/regularity_proof.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "agreement/shared_data.hpp"
#include "loops/closed_system.hpp"
#include "loops/linkages.hpp"
#include "model/checks.hpp"

namespace jourdain::tests {
namespace {

using ir::Interval;
using ir::LeafKind;
using loops::RegularityProof;
using loops::RegularityRequest;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kLinkages = 100;

std::string why_not(const std::variant<RegularityProof, std::string>& result) {
  const auto* failure = std::get_if<std::string>(&result);
  return failure ? *failure : "";
}

/// The same linkage for Newton's method.
RegularityRequest request_of(const loops::ClosedFormRequest& form) {
  RegularityRequest request;
  request.g = form.g;
  for (const loops::PositionBlock& block : form.blocks) request.blocks.push_back({block.rows, block.dependents});
  request.initial_y = form.initial_y;
  request.angular = form.angular;
  request.range = form.range;
  for (std::size_t k = 0; k < form.initial_y.size(); ++k) {
    request.tangent.scalars.push_back({k, k});
    request.names.push_back(k == 0 ? "crank" : "y" + std::to_string(k));
  }
  request.parameters = form.parameters;
  for (std::size_t k = 0; k < form.parameters.size(); ++k) {
    request.parameter_names.push_back("p" + std::to_string(k));
    request.parameter_range.emplace_back();
  }
  return request;
}

void expect_limits(const std::function<Linkage(std::uint64_t)>& random_linkage) {
  std::size_t turning = 0, boxes = 0;
  for (std::uint64_t seed = 0; seed < kLinkages; ++seed) {
    SCOPED_TRACE(seed);
    const Linkage linkage = random_linkage(seed);
    RegularityRequest request = request_of(linkage.request);
    const auto whole = prove_regular(request);
    EXPECT_EQ(std::holds_alternative<RegularityProof>(whole), linkage.full_turn) << why_not(whole);
    turning += linkage.full_turn ? 1 : 0;
    if (!linkage.full_turn) {
      EXPECT_THAT(why_not(whole), HasSubstr("turns singular near crank = "));
    }
    request.range[0] = linkage.reachable;
    const auto part = prove_regular(request);
    EXPECT_EQ(why_not(part), "");
    if (const auto* proof = std::get_if<RegularityProof>(&part)) {
      boxes = std::max(boxes, proof->boxes);
      EXPECT_GT(proof->radius, 1e-7);
    }
  }
  std::printf("boxes %zu\n", boxes);
  EXPECT_GT(turning, kLinkages / 5);
  EXPECT_LT(turning, 4 * kLinkages / 5);
}

TEST(RegularityProof, OfFourBarsAgreesWithGrashof) { expect_limits(random_four_bar); }

TEST(RegularityProof, OfSliderCranksAsksForALongRod) {
  expect_limits([](std::uint64_t seed) { return random_slider_crank(seed, false); });
}

TEST(RegularityProof, OfSlidingRodsAsksForABlockThatIsFarEnough) {
  expect_limits([](std::uint64_t seed) { return random_slider_crank(seed, true); });
}

TEST(RegularityProof, Trial) {
  for (const std::string name : {"four_bar", "slider_crank", "spatial_slider_crank", "squeezer", "spring_four_bar",
                                 "double_wishbone", "parallel_robot"}) {
    const model::Mechanism mechanism = read_model(model_path(name + ".toml"));
    support::Diagnostics diagnostics("model", "");
    dynamics::DerivationOptions options;
    options.closures_only = true;
    const auto equations = dynamics::derive_equations(mechanism, options);
    const auto constraints = loops::constraint_programs(mechanism, equations);
    const auto plan = loops::plan_loops(mechanism, constraints, diagnostics);
    const auto begin = std::chrono::steady_clock::now();
    auto request = loops::regularity_request(mechanism, constraints, *plan, model::default_values(mechanism));
    if (getenv("EFFORT")) request.effort = strtoul(getenv("EFFORT"), nullptr, 10);
    if (getenv("PRINT") && name == "parallel_robot") puts(ir::print(request.g).c_str());
    const auto result = prove_regular(request);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%s %.2f s: %s\n", name.c_str(), seconds, why_not(result).c_str());
    if (const auto* p = std::get_if<RegularityProof>(&result))
      std::printf("   margin %.3g boxes %zu radius %.3g residual %.3g ends %.3g ulp length %.3g %s\n", p->margin, p->boxes,
                  p->radius, p->residual, p->ends_within / 0x1p-52, p->length, p->region.c_str());
  }
}

}  // namespace
}  // namespace jourdain::tests
