#include "loops/closed_form/position_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "loops/linkages.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;
using loops::ClosedForm;
using loops::ClosedFormRequest;
using loops::PositionBlock;
using loops::Scalar;
using loops::Vector2;
using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kLinkages = 200;
/// Of the sum of the lengths, where the largest angle is 1: angles of two turns are rounded with their size.
constexpr double kResidual = 1e-14;
constexpr int kSteps = 720;

std::string why_not(const std::variant<ClosedForm, std::string>& result) {
  const auto* failure = std::get_if<std::string>(&result);
  return failure ? *failure : "";
}

ir::LeafValues<double> leaves_of(const ClosedFormRequest& request) {
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = request.initial_y;
  leaves[LeafKind::kParameter] = request.parameters;
  leaves[LeafKind::kTime] = {0};
  return leaves;
}

void close(const ir::Program& program, ir::LeafValues<double>& leaves) {
  const std::vector<double> found = ir::interpret(program, leaves);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (program.outputs[k].row >= 0)
      leaves[LeafKind::kPosition][std::size_t(program.outputs[k].row)] = found[k];
}

/// Moves the first coordinate from its initial value to `end` and checks g and continuity; the positions there.
std::vector<double> expect_closed(const Linkage& linkage, const ir::Program& program, double end) {
  ir::LeafValues<double> leaves = leaves_of(linkage.request);
  std::vector<double>& y = leaves[LeafKind::kPosition];
  const double start = y[0];
  double worst = 0, farthest = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const std::vector<double> before = y;
    y[0] = start + (end - start) * i / kSteps;
    close(program, leaves);
    double angle = 1;
    for (std::size_t k = 0; k < y.size(); ++k)
      if (linkage.request.angular[k]) angle = std::max(angle, std::fabs(y[k]));
    for (const double row : ir::interpret(linkage.request.g, leaves))
      worst = std::max(worst, std::fabs(row) / (linkage.scale * angle));
    for (std::size_t k = 0; k < y.size(); ++k)
      if (linkage.request.angular[k]) farthest = std::max(farthest, std::fabs(y[k] - before[k]));
  }
  EXPECT_LE(worst, kResidual);
  EXPECT_LE(farthest, 1.0) << "an angle jumps";
  return y;
}

/// Two turns forth, and whole turns of everything.
void expect_two_turns(const Linkage& linkage, const ir::Program& program) {
  const std::vector<double>& start = linkage.request.initial_y;
  const std::vector<double> end = expect_closed(linkage, program, start[0] + 4 * kPi);
  for (std::size_t k = 1; k < end.size(); ++k) {
    const double turns = (end[k] - start[k]) / (2 * kPi);
    EXPECT_NEAR(linkage.request.angular[k] ? turns - 2 * std::round(turns / 2) : turns, 0, 1e-9) << k;
  }
}

void expect_limits(const std::function<Linkage(std::uint64_t)>& random_linkage) {
  std::size_t turning = 0;
  for (std::uint64_t seed = 0; seed < kLinkages; ++seed) {
    SCOPED_TRACE(seed);
    Linkage linkage = random_linkage(seed);
    const auto whole = closed_form(linkage.request);
    ASSERT_EQ(std::holds_alternative<ClosedForm>(whole), linkage.full_turn) << why_not(whole);
    if (linkage.full_turn) {
      expect_two_turns(linkage, std::get<ClosedForm>(whole).close);
      ++turning;
    } else {
      EXPECT_THAT(why_not(whole), HasSubstr("over y[0] in [-pi, pi]"));
    }
    linkage.request.range[0] = linkage.reachable;
    const auto part = closed_form(linkage.request);
    ASSERT_TRUE(std::holds_alternative<ClosedForm>(part)) << why_not(part);
    EXPECT_GT(std::get<ClosedForm>(part).smallest_margin, 1e-5);
    expect_closed(linkage, std::get<ClosedForm>(part).close, linkage.reachable[0]);
    expect_closed(linkage, std::get<ClosedForm>(part).close, linkage.reachable[1]);
  }
  EXPECT_GT(turning, kLinkages / 5);
  EXPECT_LT(turning, 4 * kLinkages / 5);
}

TEST(ClosedForm, OfFourBarsTurnsRoundWhereGrashofAllowsIt) { expect_limits(random_four_bar); }

TEST(ClosedForm, OfSliderCranksTurnsRoundWhereTheRodIsLongEnough) {
  expect_limits([](std::uint64_t seed) { return random_slider_crank(seed, false); });
}

TEST(ClosedForm, OfSlidingRodsTurnsRoundWhereTheBlockIsFarEnough) {
  expect_limits([](std::uint64_t seed) { return random_slider_crank(seed, true); });
}

ClosedFormRequest four_bar(double a, double b, double c, double ground, double crank) {
  Rows rows;
  rows.rows(rows.bar(a, rows.y(0)) + rows.bar(b, rows.y(1)) - rows.bar(c, rows.y(2)) -
            rows.point({ground, 0}));
  const double x = ground - a * std::cos(crank), y = -a * std::sin(crank), d = std::hypot(x, y),
               coupler = std::atan2(y, x) + std::acos((d * d + b * b - c * c) / (2 * d * b)),
               rocker = std::atan2(b * std::sin(coupler) - y, b * std::cos(coupler) - x);
  return {rows.finish(),      {{{0, 1}, {1, 2}}}, {crank, coupler, rocker},      {},
          {true, true, true}, {{}, {}, {}},       {"crank", "coupler", "rocker"}};
}

TEST(ClosedForm, RefusesLinkagesWithAChangePoint) {
  for (const auto& [a, b, c, ground] :
       {std::array{1.0, 1.0, 1.0, 1.0}, {0.5, 1.0, 0.5, 1.0}, {0.5, 1.0, 1.0, 0.5}, {0.3, 0.9, 0.5, 0.7}})
    EXPECT_THAT(
        why_not(closed_form(four_bar(a, b, c, ground, 0.8))),
        HasSubstr("discriminant of coupler, rocker not proven positive over crank in [-pi, pi]: it "));
  // Off the change point the same linkage is solved.
  ClosedFormRequest part = four_bar(1, 1, 1, 1, 0.8);
  part.range[0] = {{0.2, 2.9}};
  EXPECT_EQ(why_not(closed_form(part)), "");
}

TEST(ClosedForm, BoundsTheMarginSharply) {
  // The rocker's angle to the diagonal d between its pivot and the crank's pin, which is 0.8 to 1.2 long.
  double least = 1;
  for (double d = 0.8; d <= 1.2; d += 1e-4) {
    const double cosine = (0.7 * 0.7 + d * d - 0.9 * 0.9) / (2 * 0.7 * d);
    least = std::min(least, 1 - cosine * cosine);
  }
  const auto result = closed_form(four_bar(0.2, 0.9, 0.7, 1, 0.8));
  ASSERT_EQ(why_not(result), "");
  const double margin = std::get<ClosedForm>(result).smallest_margin;
  EXPECT_LE(margin, least);
  EXPECT_GE(margin, least / 2);
}

TEST(ClosedForm, FollowsTheParameters) {
  Rows rows;
  rows.rows(rows.parameter(0) * rows.bar(1, rows.y(0)) + rows.bar(3, rows.y(1)) -
            Vector2{rows.y(2), rows.number(0)});
  const ClosedFormRequest request = {rows.finish(),       {{{0, 1}, {1, 2}}}, {0, 0, 4}, {1},
                                     {true, true, false}, {{}, {}, {}},       {}};
  const auto result = closed_form(request);
  ASSERT_EQ(why_not(result), "");
  ir::LeafValues<double> leaves = leaves_of(request);
  leaves[LeafKind::kPosition] = {kPi / 2, 0, 0};
  leaves[LeafKind::kParameter] = {2};
  close(std::get<ClosedForm>(result).close, leaves);
  EXPECT_NEAR(leaves[LeafKind::kPosition][1], -std::asin(2.0 / 3), 1e-15);
  EXPECT_NEAR(leaves[LeafKind::kPosition][2], std::sqrt(5.0), 1e-15);
}

TEST(ClosedForm, HoldsForAllParametersInTheirRanges) {
  // A crank of length p, a rod of 3: the crank turns round as long as p < 3.
  Rows rows;
  rows.rows(rows.parameter(0) * rows.bar(1, rows.y(0)) + rows.bar(3, rows.y(1)) -
            Vector2{rows.y(2), rows.number(0)});
  ClosedFormRequest request = {rows.finish(),       {{{0, 1}, {1, 2}}}, {0, 0, 4}, {1},
                               {true, true, false}, {{}, {}, {}},       {}};
  request.parameter_range = {{{0.5, 2}}};
  request.parameter_names = {"radius"};
  const auto inside = closed_form(request);
  ASSERT_EQ(why_not(inside), "");
  // 1 − (2/3)² at the longest crank, by half or better.
  EXPECT_LE(std::get<ClosedForm>(inside).smallest_margin, 5.0 / 9);
  EXPECT_GE(std::get<ClosedForm>(inside).smallest_margin, 5.0 / 18);
  EXPECT_TRUE(std::get<ClosedForm>(inside).at_defaults.empty());
  request.parameter_range = {{{0.5, 3.1}}};
  EXPECT_THAT(why_not(closed_form(request)), HasSubstr(", radius in [0.5, 3.1]: it "));
  request.parameter_range = {{}};
  EXPECT_THAT(std::get<ClosedForm>(closed_form(request)).at_defaults, ::testing::ElementsAre("radius"));
}

TEST(ClosedForm, SolvesLinearRowsOfSlidesAndGears) {
  // A yoke x = cos q, two slides askew of it, and a gear of a third of the turns.
  Rows rows;
  rows.row(rows.y(1) - cosine(rows.y(0)));
  rows.rows(rows.y(2) * rows.point({1, 1}) + rows.y(3) * rows.point({-1, 2}) -
            Vector2{rows.y(1), sine(rows.y(0))});
  rows.row(3.0 * rows.y(4) + rows.y(0));
  const ClosedFormRequest request = {rows.finish(),
                                     {{{0}, {1}}, {{1, 2}, {2, 3}}, {{3}, {4}}},
                                     {0, 1, 2.0 / 3, -1.0 / 3, 0},
                                     {},
                                     {true, false, false, false, true},
                                     std::vector<std::optional<std::array<double, 2>>>(5),
                                     {}};
  const auto result = closed_form(request);
  ASSERT_EQ(why_not(result), "");
  ir::LeafValues<double> leaves = leaves_of(request);
  leaves[LeafKind::kPosition][0] = 7.5;
  close(std::get<ClosedForm>(result).close, leaves);
  for (const double row : ir::interpret(request.g, leaves)) EXPECT_NEAR(row, 0, 1e-15);
  EXPECT_EQ(leaves[LeafKind::kPosition][4], -2.5);
  EXPECT_NEAR(std::get<ClosedForm>(result).smallest_margin, 0.9, 1e-12);
}

TEST(ClosedForm, SaysWhyThereIsNone) {
  ClosedFormRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  request.initial_y[2] += 0.1;
  EXPECT_THAT(why_not(closed_form(request)), HasSubstr("does not close the loop: "));
  request = four_bar(1, 0.6, 0.6, 1, std::acos(0.28));
  EXPECT_EQ(why_not(closed_form(request)), "coupler, rocker: the initial state is a dead position");
  request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  request.blocks = {{{0, 1, 2, 3}, {1, 2, 3, 4}}};
  EXPECT_EQ(why_not(closed_form(request)), "block of 4 unknowns");
  request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  request.blocks = {{{0}, {1}}, {{1}, {2}}};
  EXPECT_EQ(why_not(closed_form(request)), "coupler depends on rocker, which is found after it");
  Rows rows;
  rows.row(rows.y(1) - sine(rows.y(1)) - rows.y(0));
  request = {rows.finish(), {{{0}, {1}}}, {0, 0}, {}, {true, true}, {{}, {}}, {}};
  EXPECT_THAT(why_not(closed_form(request)), HasSubstr("none of those that are solved in closed form"));
  Rows half;
  half.row(sine(0.5 * half.y(1)) - half.y(0));
  request = {half.finish(), {{{0}, {1}}}, {0, 0}, {}, {false, true}, {{}, {}}, {}};
  EXPECT_EQ(why_not(closed_form(request)), "a constraint has the sine of a multiple of y[1]");
}

TEST(ClosedForm, DoesNotProveWhatDependsOnWholeTurnsOfADependentAngle) {
  ClosedFormRequest request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  Rows rows;
  rows.rows(rows.bar(0.2, rows.y(0)) + rows.bar(0.9, rows.y(1)) - rows.bar(0.7, rows.y(2)) -
            rows.point({1, 0}));
  rows.row(rows.y(2) * sine(rows.y(3)));  // a cord that the rocker winds up
  request.g = rows.finish();
  request.blocks.push_back({{2}, {3}});
  request.initial_y.push_back(0);
  request.angular.push_back(true);
  request.range.emplace_back();
  request.names.push_back("cord");
  EXPECT_EQ(why_not(closed_form(request)), "its discriminant depends on the whole turns of rocker");
}

TEST(ClosedForm, NeedsARangeOfWhatIsNoAngle) {
  Rows rows;  // a slider that drives the crank
  rows.rows(rows.bar(1, rows.y(1)) + rows.bar(2, rows.y(2)) - Vector2{rows.y(0), rows.number(0)});
  ClosedFormRequest request = {rows.finish(),
                               {{{0, 1}, {1, 2}}},
                               {2, std::acos(0.25), -std::acos(0.875)},
                               {},
                               {false, true, true},
                               {{}, {}, {}},
                               {"slide", "crank", "rod"}};
  EXPECT_EQ(why_not(closed_form(request)), "its discriminant depends on slide, which has no range");
  request.range[0] = {{1.1, 2.9}};
  EXPECT_EQ(why_not(closed_form(request)), "");
  request.range[0] = {{1.1, 3.1}};
  EXPECT_THAT(why_not(closed_form(request)),
              HasSubstr("over slide in [1.1, 3.1]: it vanishes or is negative"));
}

/// A slider-crank whose crank turns by 3 rad/s and whose rail sinks by `sinking` a second.
ClosedFormRequest driven(double crank, double sinking) {
  Rows rows;
  rows.rows(rows.bar(crank, 3.0 * rows.time()) + rows.bar(1, rows.y(0)) -
            Vector2{rows.y(1), sinking * rows.time()});
  return {rows.finish(), {{{0, 1}, {0, 1}}}, {0, crank + 1}, {}, {true, false}, {{}, {}}, {}};
}

TEST(ClosedForm, HoldsAtAllTimesWhereAnAngleIsDriven) {
  const auto result = closed_form(driven(0.2, 0));
  ASSERT_EQ(why_not(result), "");
  EXPECT_LE(std::get<ClosedForm>(result).smallest_margin, 0.96);
  EXPECT_GE(std::get<ClosedForm>(result).smallest_margin, 0.48);
  EXPECT_THAT(why_not(closed_form(driven(1.1, 0))), HasSubstr("over the driven angle in [-pi, pi]: it "));
  EXPECT_EQ(why_not(closed_form(driven(0.2, 0.1))), "its discriminant depends on time");
}

/// Two cranks of length a that turn independently, rods of length b: the pivots 1 apart, if they do not slide.
ClosedFormRequest five_bar(double a, double b, bool slides) {
  Rows rows;
  const Scalar distance = slides ? rows.y(4) : rows.number(1);
  rows.rows(rows.bar(a, rows.y(0)) + rows.bar(b, rows.y(1)) - rows.bar(a, rows.y(2)) -
            rows.bar(b, rows.y(3)) - Vector2{distance, rows.number(0)});
  const double rod = std::acos(0.5 / b);
  return {rows.finish(),
          {{{0, 1}, {1, 3}}},
          {0.5 * kPi, rod, 0.5 * kPi, kPi - rod, 1},
          {},
          {true, true, true, true, false},
          {{}, {}, {}, {}, {{0.8, 1.2}}},
          {}};
}

TEST(ClosedForm, HoldsOverSeveralIndependentCoordinates) {
  for (const bool slides : {false, true}) {
    const ClosedFormRequest request = five_bar(0.2, 0.9, slides);
    const auto result = closed_form(request);
    ASSERT_EQ(why_not(result), "");
    ir::LeafValues<double> leaves = leaves_of(request);
    std::vector<double>& y = leaves[LeafKind::kPosition];
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
      y[0] += random.uniform(-0.3, 0.3);
      y[2] += random.uniform(-0.3, 0.3);
      y[4] = random.uniform(0.8, 1.2);
      close(std::get<ClosedForm>(result).close, leaves);
      for (const double row : ir::interpret(request.g, leaves)) EXPECT_NEAR(row, 0, 1e-14);
    }
    // Rods that do not span the farthest pins.
    EXPECT_THAT(why_not(closed_form(five_bar(0.2, slides ? 0.79 : 0.69, slides))),
                HasSubstr("not proven positive over y[0] in [-pi, pi], y[2] in [-pi, pi]"));
  }
}

TEST(ClosedForm, ChainsDyads) {
  // A six-bar of Stephenson's kind: a second dyad between a point of the rocker and the ground.
  Rows rows;
  const Scalar crank = rows.y(0), coupler = rows.y(1), rocker = rows.y(2);
  rows.rows(rows.bar(0.2, crank) + rows.bar(0.9, crank + coupler) - rows.bar(0.7, rocker) -
            rows.point({1, 0}));
  const Vector2 pin = rows.point({1, 0}) + rows.turned(rocker, rows.point({0.9, 0.3}));
  rows.rows(pin + rows.bar(2, rocker + rows.y(3)) + rows.bar(1.5, rocker + rows.y(3) + rows.y(4)) -
            rows.point({3, 0.2}));
  Linkage linkage;
  linkage.request = four_bar(0.2, 0.9, 0.7, 1, 0.8);
  linkage.request.g = rows.finish();
  std::vector<double>& y = linkage.request.initial_y;
  y[1] -= y[0];
  const double px = 1 + 0.9 * std::cos(y[2]) - 0.3 * std::sin(y[2]),
               py = 0.9 * std::sin(y[2]) + 0.3 * std::cos(y[2]), dx = 3 - px, dy = 0.2 - py,
               d = std::hypot(dx, dy),
               first = std::atan2(dy, dx) + std::acos((d * d + 2 * 2 - 1.5 * 1.5) / (2 * d * 2)),
               second = std::atan2(dy - 2 * std::sin(first), dx - 2 * std::cos(first));
  y.push_back(first - y[2]);
  y.push_back(second - first);
  linkage.request.blocks = {{{0, 1}, {1, 2}}, {{2, 3}, {3, 4}}};
  linkage.request.angular.assign(5, true);
  linkage.request.range.assign(5, std::nullopt);
  linkage.request.names.clear();
  linkage.scale = 5;
  const auto result = closed_form(linkage.request);
  ASSERT_EQ(why_not(result), "");
  expect_two_turns(linkage, std::get<ClosedForm>(result).close);
}

/// Andrews' squeezing mechanism: coordinates β Θ γ Φ δ Ω ε, three loops from the crank.
Linkage andrews() {
  Rows rows;
  const Scalar beta = rows.y(0), theta = rows.y(1), gamma = rows.y(2), phi = rows.y(3), delta = rows.y(4),
               omega = rows.y(5), epsilon = rows.y(6);
  const Vector2 pin = rows.bar(0.007, beta) - rows.bar(0.028, beta + theta);
  rows.rows(pin + quarter(rows.bar(0.035, gamma)) - rows.point({-0.03635, 0.03273}));
  const Vector2 a = rows.point({-0.06934, -0.00227});
  rows.rows(pin + quarter(rows.bar(0.02, phi + delta)) - rows.bar(0.04, delta) - a);
  rows.rows(pin - rows.bar(0.02, omega + epsilon) + quarter(rows.bar(0.04, epsilon)) - a);
  Linkage linkage;
  linkage.request = {rows.finish(),
                     {{{0, 1}, {1, 2}}, {{2, 3}, {3, 4}}, {{4, 5}, {5, 6}}},
                     {-0.0617138900142764496, 0, 0.455279819163070380, 0.222668390165885885,
                      0.487364979543842550, -0.222668390165885885, 1.23054744454982119},
                     {},
                     std::vector<bool>(7, true),
                     std::vector<std::optional<std::array<double, 2>>>(7),
                     {"beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"}};
  linkage.scale = 0.2;
  return linkage;
}

TEST(ClosedForm, OfAndrewsSqueezerHoldsForAWholeTurnOfTheCrank) {
  const Linkage linkage = andrews();
  const auto result = closed_form(linkage.request);
  ASSERT_EQ(why_not(result), "");
  expect_two_turns(linkage, std::get<ClosedForm>(result).close);
  // At t = 0.03 of the reference solution.
  ir::LeafValues<double> leaves = leaves_of(linkage.request);
  std::vector<double>& y = leaves[LeafKind::kPosition];
  for (int i = 1; i <= 100; ++i) {
    y[0] = linkage.request.initial_y[0] + (15.81077119515370842 - linkage.request.initial_y[0]) * i / 100;
    close(std::get<ClosedForm>(result).close, leaves);
  }
  const double expected[] = {15.81077119515370842,   -15.75637105841184112, 0.04082224011964581766,
                             -0.5347301163420795714, 0.5244099658799540699, 0.5347301163420795712,
                             1.048080741041937873};
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(y[k], expected[k], 1e-14) << linkage.request.names[k];
}

}  // namespace
}  // namespace jourdain::tests
