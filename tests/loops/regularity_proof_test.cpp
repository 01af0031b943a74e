#include "loops/regularity/regularity_proof.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "agreement/shared_data.hpp"
#include "ir/compose.hpp"
#include "ir/jacobian.hpp"
#include "loops/closed_form/position_blocks.hpp"
#include "loops/linkages.hpp"
#include "loops/plan/plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;
using loops::RegularityProof;
using loops::RegularityRequest;
using support::Interval;
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
  for (const loops::PositionBlock& block : form.blocks)
    request.blocks.push_back({block.rows, block.dependents});
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
  std::size_t turning = 0;
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
      EXPECT_GT(proof->radius, 1e-7);
    }
  }
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

/// a e(crank) + b e(y1) = (ground, 0) + c e(y2), absolute angles; the lengths are parameters.
RegularityRequest four_bar(double a, double b, double c, double ground, double crank) {
  Rows rows;
  const auto bar = [&](std::size_t k, loops::Scalar angle) {
    return rows.parameter(k) * loops::Vector2{cosine(angle), sine(angle)};
  };
  rows.rows(bar(0, rows.y(0)) + bar(1, rows.y(1)) - bar(2, rows.y(2)) -
            loops::Vector2{rows.parameter(3), rows.number(0)});
  const double x = ground - a * std::cos(crank), y = -a * std::sin(crank), d = std::hypot(x, y),
               coupler = std::atan2(y, x) + std::acos((d * d + b * b - c * c) / (2 * d * b)),
               rocker = std::atan2(b * std::sin(coupler) - y, b * std::cos(coupler) - x);
  loops::ClosedFormRequest form;
  form.g = rows.finish();
  form.blocks = {{{0, 1}, {1, 2}}};
  form.initial_y = {crank, coupler, rocker};
  form.parameters = {a, b, c, ground};
  form.angular = {true, true, true};
  form.range.resize(3);
  return request_of(form);
}

/// Where the coupler and the rocker of that four-bar stretch out: the crank's angle is ± this.
double dead_position(double a, double b, double c, double ground) {
  return std::acos((a * a + ground * ground - (b + c) * (b + c)) / (2 * a * ground));
}

TEST(RegularityProof, ReachesUpToADeadPositionAndNotBeyond) {
  const double dead = dead_position(1, 0.7, 0.6, 0.8);
  RegularityRequest request = four_bar(1, 0.7, 0.6, 0.8, 0.9);
  request.range[0] = {{0.5, dead - 1e-3}};
  const auto clear = prove_regular(request);
  ASSERT_EQ(why_not(clear), "");
  EXPECT_GT(std::get<RegularityProof>(clear).margin, 1e-3);
  EXPECT_LT(std::get<RegularityProof>(clear).margin, 0.1);
  request.range[0] = {{0.5, dead + 1e-3}};
  EXPECT_THAT(why_not(prove_regular(request)),
              HasSubstr(fmt::format("turns singular near crank = {:.3}", dead)));
}

TEST(RegularityProof, RefusesLinkagesWithAChangePoint) {
  for (const auto& [a, b, c, ground] :
       {std::array{1.0, 1.0, 1.0, 1.0}, {0.5, 1.0, 0.5, 1.0}, {0.5, 1.0, 1.0, 0.5}, {0.3, 0.9, 0.5, 0.7}})
    EXPECT_THAT(why_not(prove_regular(four_bar(a, b, c, ground, 0.8))),
                HasSubstr("turns singular near crank = "));
}

TEST(RegularityProof, HoldsForAllParametersInTheirRanges) {
  // Grashof: 0.2 + 1 < 0.9 + p2.
  RegularityRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  EXPECT_EQ(why_not(prove_regular(request)), "");
  request.parameter_range[2] = {{0.4, 0.9}};
  const auto inside = prove_regular(request);
  ASSERT_EQ(why_not(inside), "");
  EXPECT_EQ(std::get<RegularityProof>(inside).region, "any crank, p2 in [0.4, 0.9]");
  const loops::ProvenBox& box = std::get<RegularityProof>(inside).box;
  EXPECT_TRUE(box.positions.empty());
  ASSERT_EQ(box.parameters.size(), 4u);
  EXPECT_EQ((std::array{box.parameters[2].low, box.parameters[2].high}), (std::array{0.4, 0.9}));
  EXPECT_EQ((std::array{box.parameters[0].low, box.parameters[0].high}), (std::array{0.2, 0.2}));
  EXPECT_THAT(std::get<RegularityProof>(inside).at_defaults, ::testing::ElementsAre("p0", "p1", "p3"));
  request.parameter_range[2] = {{0.28, 0.9}};
  EXPECT_THAT(why_not(prove_regular(request)), HasSubstr("turns singular near crank = "));
}

TEST(RegularityProof, FollowsTwoIndependentCoordinates) {
  // Five bars: two cranks, far enough from each other that the coupled ones neither stretch out nor fold.
  const auto five_bar = [](double b) {
    Rows rows;
    rows.rows(rows.bar(0.2, rows.y(0)) + rows.bar(b, rows.y(2)) - rows.bar(0.2, rows.y(1)) -
              rows.bar(0.9, rows.y(3)) - rows.point({1, 0}));
    const double far = 1, coupler = std::acos((far * far + b * b - 0.81) / (2 * far * b)),
                 other = std::atan2(b * std::sin(coupler), b * std::cos(coupler) - far);
    loops::ClosedFormRequest form;
    form.g = rows.finish();
    form.blocks = {{{0, 1}, {2, 3}}};
    form.initial_y = {0, 0, coupler, other};
    form.angular = {true, true, true, true};
    form.range.resize(4);
    return request_of(form);
  };
  EXPECT_EQ(why_not(prove_regular(five_bar(0.9))), "");
  EXPECT_THAT(why_not(prove_regular(five_bar(0.45))), HasSubstr("near crank = "));  // 0.45 + 0.9 < 1.4
}

TEST(RegularityProof, StopsWhereDependentsLeaveTheirRanges) {
  RegularityRequest request = four_bar(1, 0.7, 0.6, 0.8, 0.9);  // the crank cannot turn round
  EXPECT_NE(why_not(prove_regular(request)), "");
  const double rocker = request.initial_y[2];
  request.range[2] = {{rocker - 0.1, rocker + 0.1}};
  const auto held = prove_regular(request);
  ASSERT_EQ(why_not(held), "");
  EXPECT_THAT(std::get<RegularityProof>(held).region, HasSubstr("any crank, y2 in ["));
  ASSERT_EQ(std::get<RegularityProof>(held).box.positions.size(), 1u);
  EXPECT_EQ(std::get<RegularityProof>(held).box.positions[0].index, 2u);
}

TEST(RegularityProof, HoldsAtAllTimes) {
  const auto driven = [](double amplitude) {
    Rows rows;
    rows.row(sine(rows.y(1) + 3.0 * rows.time()) - amplitude * sine(2.0 * rows.time()) -
             0.4 * sine(rows.y(0)));
    loops::ClosedFormRequest form;
    form.g = rows.finish();
    form.blocks = {{{0}, {1}}};
    form.initial_y = {0, 0};
    form.angular = {true, true};
    form.range.resize(2);
    RegularityRequest request = request_of(form);
    request.effort = 20000;
    return request;
  };
  const auto proven = prove_regular(driven(0.5));
  ASSERT_EQ(why_not(proven), "");
  EXPECT_EQ(std::get<RegularityProof>(proven).region, "any crank, any driven angle, any driven angle");
  EXPECT_THAT(why_not(prove_regular(driven(0.7))), HasSubstr("turns singular near crank = "));
  Rows rows;
  rows.row(rows.y(1) - rows.time() * sine(rows.y(0)));
  RegularityRequest growing = driven(0.5);
  growing.g = rows.finish();
  EXPECT_EQ(why_not(prove_regular(growing)), "a constraint depends on time other than by an angle's sine");
}

TEST(RegularityProof, NamesWhatHasNoRange) {
  Rows rows;
  rows.row(rows.y(1) - rows.y(0) * rows.y(0));
  loops::ClosedFormRequest form;
  form.g = rows.finish();
  form.blocks = {{{0}, {1}}};
  form.initial_y = {0.5, 0.25};
  form.angular = {false, false};
  form.range.resize(2);
  EXPECT_EQ(why_not(prove_regular(request_of(form))), "the constraints depend on crank, which has no range");
  form.range[0] = {{-1, 2}};
  EXPECT_EQ(why_not(prove_regular(request_of(form))), "");
}

TEST(RegularityProof, CountsItsEffortInBoxes) {
  RegularityRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  request.effort = 3;
  EXPECT_THAT(why_not(prove_regular(request)),
              HasSubstr("not decided within 3 boxes; nearest to singular near crank = "));
}

/// Newton's iterations as emitted for one block, in extended precision.
std::vector<long double> newton(const RegularityRequest& request, std::vector<long double> y) {
  ir::Builder builder;
  std::vector<ir::Seed> seeds;
  const std::vector<std::size_t>& dependents = request.blocks[0].dependents;
  for (std::size_t k = 0; k < dependents.size(); ++k)
    seeds.push_back({builder.leaf(LeafKind::kPosition, dependents[k]), k, builder.literal(1)});
  for (const auto& [where, value] : ir::differentiate(builder, ir::insert(builder, request.g), seeds, {}))
    builder.output("G", static_cast<int>(where.first), static_cast<int>(where.second), value);
  const ir::Program slopes = builder.finish("slopes");
  for (int i = 0; i < request.iterations; ++i) {
    ir::LeafValues<long double> leaves;
    leaves[LeafKind::kPosition] = y;
    leaves[LeafKind::kParameter].assign(request.parameters.begin(), request.parameters.end());
    const std::vector<long double> g = ir::interpret(request.g, leaves),
                                   values = ir::interpret(slopes, leaves);
    loops::Matrix G = loops::Matrix::Zero(Eigen::Index(g.size()), Eigen::Index(g.size()));
    for (std::size_t j = 0; j < values.size(); ++j)
      G(slopes.outputs[j].row, slopes.outputs[j].column) = values[j];
    const loops::Vector step =
        G.partialPivLu().solve(Eigen::Map<const loops::Vector>(g.data(), Eigen::Index(g.size())));
    for (std::size_t k = 0; k < dependents.size(); ++k) y[dependents[k]] -= step[Eigen::Index(k)];
  }
  return y;
}

TEST(RegularityProof, TellsFromHowFarNewtonComesBack) {
  for (const int iterations : {1, 2, 3}) {
    SCOPED_TRACE(iterations);
    RegularityRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8), exact = request;
    request.iterations = iterations;
    exact.iterations = 8;
    const auto result = prove_regular(request);
    ASSERT_EQ(why_not(result), "");
    const RegularityProof& proof = std::get<RegularityProof>(result);
    Random random(1);
    std::vector<long double> on(request.initial_y.begin(), request.initial_y.end());
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      on[0] += 0.01;
      on = newton(exact, on);
      std::vector<long double> off = on;
      for (const std::size_t k : {1, 2}) off[k] += random.sign() * proof.radius;
      off = newton(request, off);
      for (const std::size_t k : {1, 2})
        worst = std::max(worst, static_cast<double>(std::fabs(off[k] - on[k])));
    }
    constexpr double kRounding = 1e-18;  // of extended precision
    EXPECT_LE(worst, proof.ends_within + kRounding);
    EXPECT_LE(proof.ends_within, 8e-10);
    // Twenty times as far it is not so: the radius is no smaller than it must be by more than that.
    std::vector<long double> off = on;
    double beyond = 0;
    for (const long double sign : {-1.0L, 1.0L}) {
      off = on;
      off[1] += 20 * proof.radius;
      off[2] += sign * 20 * proof.radius;
      off = newton(request, off);
      beyond = std::max(beyond, static_cast<double>(std::fabs(off[1] - on[1])));
    }
    EXPECT_GT(beyond, proof.ends_within);
  }
}

/// Largest difference of the dependents of a four-bar.
double distance(const std::vector<long double>& a, const std::vector<long double>& b) {
  const auto turn = [&](std::size_t k) {
    return std::fabs(std::remainder(a[k] - b[k], 2 * std::acos(-1.0L)));
  };
  return static_cast<double>(std::max(turn(1), turn(2)));
}

TEST(RegularityProof, TellsByTheFirstCorrectionHowFarDependentsAreOff) {
  for (const int iterations : {1, 2, 3}) {
    SCOPED_TRACE(iterations);
    RegularityRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8), first = request, exact = request;
    request.iterations = iterations;
    first.iterations = 1;
    exact.iterations = 8;
    const auto result = prove_regular(request);
    ASSERT_EQ(why_not(result), "");
    const RegularityProof& proof = std::get<RegularityProof>(result);
    EXPECT_GT(proof.first_correction, proof.radius / 8);
    EXPECT_GT(proof.isolation, 0.05);
    Random random(iterations);
    std::vector<long double> on(request.initial_y.begin(), request.initial_y.end());
    int accepted = 0;
    for (int i = 0; i < 4000; ++i) {
      on[0] += 0.005;
      on = newton(exact, on);
      std::vector<long double> off = on;
      const double scale = random.chance(0.5) ? proof.radius : proof.isolation;
      for (const std::size_t k : {1, 2}) off[k] += random.uniform(-1, 1) * scale;
      const std::vector<long double> next = newton(first, off);
      if (std::hypot(next[1] - off[1], next[2] - off[2]) > proof.first_correction) continue;
      ++accepted;
      EXPECT_LE(distance(off, on), proof.radius);
      EXPECT_LE(distance(newton(request, off), on), proof.ends_within + 1e-18);
    }
    EXPECT_GT(accepted, 100);
  }
}

TEST(RegularityProof, TellsHowFarOtherSolutionsAreAway) {
  // Near the dead position of its coupler and rocker the two branches come close.
  for (const double clearance : {0.3, 0.03}) {
    const double dead = dead_position(1, 0.7, 0.6, 0.8);
    RegularityRequest request = four_bar(1, 0.7, 0.6, 0.8, 0.9), exact = request;
    request.range[0] = {{0.5, dead - clearance}};
    exact.iterations = 60;
    const auto result = prove_regular(request);
    ASSERT_EQ(why_not(result), "");
    std::vector<long double> here(request.initial_y.begin(), request.initial_y.end());
    for (here[0] = 0.9; here[0] < dead - clearance; here[0] += 1e-3L) here = newton(exact, here);
    here = newton(exact, here);
    std::vector<long double> other = here;  // mirrored at the line from the crank's pin to the rocker's pivot
    const long double line = std::atan2(-std::sin(here[0]), 0.8L - std::cos(here[0]));
    for (const std::size_t k : {1, 2}) other[k] = 2 * line - here[k];
    other = newton(exact, other);
    const double away = distance(here, other);
    fmt::print("other branch {:.3f} rad away, proven {:.3g}\n", away,
               std::get<RegularityProof>(result).isolation);
    EXPECT_GT(away, 1e-3);
    EXPECT_LT(std::get<RegularityProof>(result).isolation, away);
  }
}

// Attacks: each weakens the proof in one place, and it accepts what it must not.

ir::IntervalResults over_inner_boxes(const ir::Program& program, const ir::LeafValues<Interval>& leaves) {
  ir::LeafValues<Interval> inner = leaves;
  for (auto& kind : inner.of)
    for (Interval& leaf : kind) leaf = {leaf.middle() - leaf.width() / 40, leaf.middle() + leaf.width() / 40};
  return ir::interpret_interval(program, inner);
}

/// In double precision, as if there were no rounding.
ir::IntervalResults unrounded(const ir::Program& program, const ir::LeafValues<Interval>& leaves) {
  ir::IntervalResults results = ir::interpret_interval(program, leaves);
  ir::LeafValues<double> points;
  for (std::size_t kind = 0; kind < ir::kLeafKinds; ++kind)
    for (const Interval leaf : leaves.of[kind]) points.of[kind].push_back(leaf.middle());
  const std::vector<double> values = ir::interpret(program, points);
  bool is_point = true;
  for (const Interval leaf : leaves[LeafKind::kPosition]) is_point = is_point && leaf.width() < 1e-14;
  for (std::size_t i = 0; i < values.size() && is_point; ++i) results.values[i] = Interval::point(values[i]);
  return results;
}

TEST(RegularityProof, NeedsWholeBoxes) {
  // A parallelogram: its dependents go straight on through crank = pi, where what is solved for them is singular.
  RegularityRequest request = four_bar(0.5, 1, 0.5, 1, 0.8);
  request.initial_y = {0.8, 0, 0.8};
  request.range[0] = {{0.5, 5.5}};
  request.effort = 200;
  EXPECT_THAT(why_not(prove_regular(request)), HasSubstr("turns singular near crank = 3.14"));
  request.evaluate = over_inner_boxes;
  const auto accepted = prove_regular(request);
  ASSERT_EQ(why_not(accepted), "");
  // Newton's iterations do not come back from as far as it says.
  const RegularityProof& proof = std::get<RegularityProof>(accepted);
  const long double crank = 3.14159;
  const auto end = newton(request, {crank, proof.radius, crank - proof.radius});
  EXPECT_GT(std::fabs(end[1]), 1e6 * proof.ends_within);
}

TEST(RegularityProof, NeedsOutwardRounding) {
  // sin(y1) = 1.5 + 0.1 sin(crank) has no solution, but beside 1e16 everything of size 1 is lost.
  Rows rows;
  const loops::Scalar large = rows.number(1e16);
  rows.row(((sine(rows.y(1)) - 0.1 * sine(rows.y(0)) - rows.number(1.5)) * rows.number(0.5) + large) - large);
  loops::ClosedFormRequest form;
  form.g = rows.finish();
  form.blocks = {{{0}, {1}}};
  form.initial_y = {0, 0.5};
  form.angular = {true, true};
  form.range = {{{-0.1, 0.1}}, {}};
  RegularityRequest request = request_of(form);
  EXPECT_NE(why_not(prove_regular(request)), "");
  request.evaluate = unrounded;
  EXPECT_EQ(why_not(prove_regular(request)), "");
}

TEST(RegularityProof, HoldsOfModels) {
  for (const std::string name : {"four_bar", "slider_crank", "spatial_slider_crank", "squeezer",
                                 "spring_four_bar", "double_wishbone"}) {
    SCOPED_TRACE(name);
    model::Mechanism mechanism = read_model(model_path(name + ".toml"));
    if (name ==
        "double_wishbone")  // over the range of its steering closed forms are proven, Newton's steps are not
      for (model::Parameter& parameter : mechanism.parameters) parameter.range.reset();
    support::Diagnostics diagnostics("model", "");
    dynamics::DerivationOptions options;
    options.closures_only = options.for_derivatives = true;
    const auto constraints =
        loops::constraint_programs(mechanism, dynamics::derive_equations(mechanism, options)).front();
    const auto plan = loops::plan_loops(mechanism, constraints, diagnostics);
    ASSERT_TRUE(plan && plan->is_reduced());
    const auto result = prove_regular(loops::regularity_request(mechanism, constraints, *plan));
    ASSERT_EQ(why_not(result), "");
    EXPECT_GT(std::get<RegularityProof>(result).margin, 0.02);
    EXPECT_GT(std::get<RegularityProof>(result).radius, 1e-5);
    EXPECT_GT(std::get<RegularityProof>(result).isolation, 1e-4);
  }
}

}  // namespace
}  // namespace jourdain::tests
