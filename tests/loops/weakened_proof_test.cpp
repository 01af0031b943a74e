// Proofs of closed forms that are weakened on purpose, each found by linkages that then go wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "ir/compose.hpp"
#include "loops/closed_form/position_blocks.hpp"
#include "loops/intervals/positivity.hpp"
#include "loops/linkages.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;
using loops::ClosedForm;
using support::Interval;

constexpr std::uint64_t kLinkages = 100;
/// Of the sum of the lengths: a loop that is open.
constexpr double kOpen = 1e-3;

/// A four-bar that does not turn round, closed where it can be.
struct Limited {
  Linkage linkage;
  ir::Program close;
};

std::optional<Limited> limited(std::uint64_t seed) {
  Limited result{random_four_bar(seed), {}};
  if (result.linkage.full_turn) return std::nullopt;
  loops::ClosedFormRequest request = result.linkage.request;
  request.range[0] = result.linkage.reachable;
  const auto form = closed_form(request);
  if (!std::holds_alternative<ClosedForm>(form)) return std::nullopt;
  result.close = std::get<ClosedForm>(form).close;
  return result;
}

ir::LeafValues<double> leaves_at(const Linkage& linkage, double crank) {
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = linkage.request.initial_y;
  leaves[LeafKind::kPosition][0] = crank;
  leaves[LeafKind::kParameter] = linkage.request.parameters;
  leaves[LeafKind::kTime] = {0};
  return leaves;
}

/// How far the rows are open after closing, in parts of the lengths; NaN where there is no solution.
double gap(const Limited& it, double crank) {
  ir::LeafValues<double> leaves = leaves_at(it.linkage, crank);
  const std::vector<double> found = ir::interpret(it.close, leaves);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (it.close.outputs[k].row >= 0)
      leaves[LeafKind::kPosition][std::size_t(it.close.outputs[k].row)] = found[k];
  double sum = 0;
  for (const double row : ir::interpret(it.linkage.request.g, leaves)) sum += std::fabs(row);
  return sum / it.linkage.scale;
}

bool goes_wrong(const Limited& it, double crank) { return !(gap(it, crank) <= kOpen); }

/// The margin of the one discriminant, times `factor`, positive over an interval of the crank?
bool is_proven(const Limited& it, double factor, std::array<double, 2> range) {
  ir::Builder builder;
  const std::vector<ir::Signed> values = ir::insert(builder, it.close);
  std::vector<loops::Bound> bounds;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (it.close.outputs[k].name == "regularity")
      bounds.push_back({builder.multiply(builder.literal(factor), values[k]), 0});
  loops::Region region;
  region.entries = {{LeafKind::kPosition, 0}};
  for (const double entry : it.linkage.request.initial_y)
    region.leaves[LeafKind::kPosition].push_back(Interval::point(entry));
  region.leaves[LeafKind::kPosition][0] = {range[0], range[1]};
  for (const double value : it.linkage.request.parameters)
    region.leaves[LeafKind::kParameter].push_back(Interval::point(value));
  return std::holds_alternative<std::vector<double>>(prove_bounds(builder, bounds, region));
}

/// Some crank angle at which there is no solution, searched from the reachable interval outward.
std::optional<double> unreachable(const Limited& it) {
  for (double crank = it.linkage.reachable[1]; crank < it.linkage.reachable[1] + 6; crank += 0.01)
    if (goes_wrong(it, crank)) return crank + 0.05;
  return std::nullopt;
}

TEST(WeakenedProof, OnTheWrongSideOfTheDiscriminantTakesWhatGoesWrong) {
  std::size_t caught = 0;
  for (std::uint64_t seed = 0; seed < kLinkages; ++seed) {
    SCOPED_TRACE(seed);
    const auto it = limited(seed);
    if (!it) continue;
    EXPECT_TRUE(is_proven(*it, 1, it->linkage.reachable));
    EXPECT_FALSE(is_proven(*it, -1, it->linkage.reachable));
    const auto beyond = unreachable(*it);
    if (!beyond) continue;
    const std::array<double, 2> there = {*beyond, *beyond + 0.01};
    EXPECT_FALSE(is_proven(*it, 1, there));
    caught += is_proven(*it, -1, there) && goes_wrong(*it, there[0]) && goes_wrong(*it, there[1]);
  }
  EXPECT_GE(caught, kLinkages / 5);
}

TEST(WeakenedProof, OverHalfTheRangeTakesWhatGoesWrongInTheOtherHalf) {
  std::size_t caught = 0;
  for (std::uint64_t seed = 0; seed < kLinkages; ++seed) {
    SCOPED_TRACE(seed);
    const auto it = limited(seed);
    if (!it) continue;
    const auto beyond = unreachable(*it);
    if (!beyond) continue;
    loops::ClosedFormRequest request = it->linkage.request;
    const double start = request.initial_y[0];
    request.range[0] = {{start, *beyond}};
    EXPECT_TRUE(std::holds_alternative<std::string>(closed_form(request)));
    request.range[0] = {{start, start + (it->linkage.reachable[1] - start) / 2}};
    caught += std::holds_alternative<ClosedForm>(closed_form(request)) && goes_wrong(*it, *beyond);
  }
  EXPECT_GE(caught, kLinkages / 5);
}

}  // namespace
}  // namespace jourdain::tests
