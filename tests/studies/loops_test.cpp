// Studies of mechanisms with closed loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "studies/emitted.hpp"
#include "studies/linearisation.hpp"
#include "studies/loop_residuals.hpp"
#include "studies/reference_solution.hpp"
#include "studies/sensitivity.hpp"
#include "studies/tangent_space.hpp"
#include "support/files.hpp"

namespace jourdain::tests {
namespace {

using namespace studies;

const std::vector<std::string> kFunctions = {
    "initial_state",       "position_rate",    "forward_dynamics", "inverse_dynamics",
    "kinetic_energy",      "potential_energy", "close_loops",      "project",
    "constraint_residual", "euler_step",       "rk4_step",         "forward_dynamics_derivatives"};
const Progress kSilent = [](const std::string&, double) {};

/// The four-bar, its loop closed by `treatment`; `crank` is a line more on its crank.
EmittedModel four_bar(const std::string& treatment, const std::vector<std::string>& functions = kFunctions,
                      const std::string& crank = "") {
  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/four_bar.toml");
  const std::string options = "treatment = \"explicit\"\nindependent = [\"crank\"]\n";
  text.replace(text.find(options), options.size(),
               "treatment = \"" + treatment + "\"\n" +
                   (treatment == "multipliers" ? "" : "independent = [\"crank\"]\n"));
  const std::string velocity = "initial_velocity = \"2*pi\"\n";
  text.insert(text.find(velocity) + velocity.size(), crank);
  return emitted_from(text, functions);
}

/// A flow without inputs.
struct Moving {
  EmittedModel model;
  ConstantInputs none;
  Flow<double> flow;

  explicit Moving(EmittedModel emitted)
      : model(std::move(emitted)),
        none(std::vector<double>(std::size_t(model.table().input_count))),
        flow(model.table(), none) {}

  /// After `count` steps of rk4.
  Point<double> later(Point<double> point, double h, long count) const {
    const jourdain_method& method = model.table().methods[method_called(model.table(), "rk4")];
    Memory memory = flow.fresh_memory(method);
    flow.step(method, point, h, count, memory);
    return point;
  }
};

TEST(LoopStudies, ARunIsTrustedUntilACoordinateLeavesTheRangeOfTheProof) {
  for (const char* treatment : {"explicit", "partitioned"}) {
    const Moving moving(four_bar(treatment, kFunctions, "range = [1, 1.2]\n"));
    const auto untrusted = first_untrusted(moving.flow, 1e-3, 1, INFINITY);
    ASSERT_TRUE(untrusted) << treatment;
    EXPECT_GT(moving.later(moving.flow.start(), 1e-3, std::lround(untrusted->from / 1e-3)).x[0], 1.2);
    EXPECT_FALSE(moving.flow.is_trusted());
    EXPECT_LT(moving.later(moving.flow.start(), 1e-3, std::lround(untrusted->from / 1e-3) - 1).x[0], 1.2);
    EXPECT_TRUE(moving.flow.is_trusted());
  }
}

TEST(LoopStudies, PerturbedStatesCloseAgain) {
  for (const char* treatment : {"explicit", "partitioned", "multipliers"}) {
    const Moving moving(four_bar(treatment));
    Point<double> point = moving.flow.start();
    EXPECT_LT(moving.flow.residuals(point).position, 1e-15) << treatment;
    for (double& entry : point.x) entry += 1e-3;
    EXPECT_GT(moving.flow.residuals(point).position, 1e-5) << treatment;
    const Residuals open = moving.flow.residuals(moving.flow.closed(point));
    EXPECT_LT(open.position, 1e-15) << treatment;
    EXPECT_LT(open.velocity, 1e-13) << treatment;
  }
}

/// The coordinate that stands for the loop's one degree of freedom with multipliers, and the linear system in it.
Eigen::MatrixXd restricted(const Moving& moving, const Point<double>& point, std::size_t& coordinate) {
  const LocalCoordinates local = local_coordinates(moving.flow, point, moving.model.tangent);
  EXPECT_EQ(local.velocities.size(), 1u);
  coordinate = local.velocities.front();
  const Eigen::MatrixXd rates = linearisation(moving.flow, point, moving.model.tangent) * local.embedding;
  const auto row = Eigen::Index(coordinate), nz = Eigen::Index(moving.model.table().velocity_count);
  Eigen::MatrixXd A(2, 2);
  A << rates.row(row), rates.row(nz + row);
  return A;
}

TEST(LoopStudies, ModesWithMultipliersAreThoseOfOneDegreeOfFreedom) {
  const Moving all(four_bar("multipliers"));
  Point<double> point = all.flow.start();
  std::fill(point.x.begin() + 3, point.x.end(),
            0.0);  // at rest the damping does not depend on the coordinate
  std::size_t coordinate = 0;
  const Eigen::MatrixXd A = restricted(all, point, coordinate);
  const Moving reduced(four_bar("partitioned"));
  const Eigen::MatrixXd A1 =
      linearisation(reduced.flow, {0, {point.x[0], point.x[1], point.x[2], 0}}, reduced.model.tangent);
  ASSERT_EQ(A1.rows(), 2);
  EXPECT_NEAR(A(1, 1) / A1(1, 1), 1, 1e-6);
  EXPECT_NEAR(A(0, 1), 1, 1e-6);
}

/// The disc that rolls, its constraints met by `treatment`.
EmittedModel rolling_disc(const std::string& treatment) {
  std::vector<std::string> functions = kFunctions;
  functions.pop_back();
  const std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/rolling_disc.toml");
  return emitted_from(text + "\n[loops]\ntreatment = \"" + treatment + "\"\n", functions);
}

/// Displacements of what is carried along count: eight rows, where multipliers have as many local coordinates.
TEST(LoopStudies, ModesOfIndependentVelocitiesAreThoseWithMultipliers) {
  const Moving all(rolling_disc("multipliers")), reduced(rolling_disc("explicit"));
  const Point<double> point = all.later(all.flow.start(), 1e-3, 200), start = reduced.flow.start();
  Point<double> same{point.t, {point.x.begin(), point.x.begin() + 7}};
  same.x.insert(same.x.end(), point.x.begin() + 10, point.x.end());
  ASSERT_EQ(same.x.size(), start.x.size());
  const LocalCoordinates local = local_coordinates(all.flow, point, all.model.tangent);
  EXPECT_EQ(local.displacements.size(), 5u);
  EXPECT_EQ(local.velocities.size(), 3u);
  const Eigen::MatrixXd rates = linearisation(all.flow, point, all.model.tangent) * local.embedding,
                        A = linearisation(reduced.flow, same, reduced.model.tangent);
  ASSERT_EQ(A.rows(), 8);
  ASSERT_EQ(A.cols(), 8);
  Eigen::MatrixXd kept(8, 8);
  for (Eigen::Index i = 0; i < 8; ++i)
    kept.row(i) =
        rates.row(Eigen::Index(local.rows()[std::size_t(i)]) + (i < 5 ? 0 : local.all_displacements));
  const Eigen::VectorXcd expected = modes_of(kept).values;
  std::size_t count = 0;
  for (const std::complex<double> mu : modes_of(A).values) {
    if (std::abs(mu) < 0.1) continue;  // where it is, and how it heads
    ++count;
    EXPECT_LT((expected.array() - mu).abs().minCoeff(), 1e-8 * std::abs(mu)) << mu;
  }
  EXPECT_EQ(count, 5u);
}

TEST(LoopStudies, DifferencesGiveTheEmittedDerivatives) {
  std::vector<std::string> without = kFunctions;
  without.pop_back();
  const Moving emitted(four_bar("partitioned")), differences(four_bar("partitioned", without));
  ASSERT_FALSE(differences.model.table().derivatives);
  const Point<double> point = emitted.flow.start();
  const Eigen::MatrixXd A = linearisation(emitted.flow, point, emitted.model.tangent),
                        B = linearisation(differences.flow, point, differences.model.tangent);
  EXPECT_LT((A - B).norm(), 1e-7 * A.norm());
}

TEST(LoopStudies, TransitionMatricesCarryDifferencesThatKeepTheLoopsClosed) {
  constexpr double kInterval = 0.02, kSeparation = 1e-5;
  for (const char* treatment : {"partitioned", "multipliers"}) {
    const Moving moving(four_bar(treatment));
    const Point<double> start = moving.flow.start();
    std::vector<Point<double>> points = {start};
    for (int k = 0; k < 10; ++k) points.push_back(moving.later(points.back(), kInterval / 20, 20));
    Eigen::VectorXd carried(Eigen::Index(moving.flow.size())), seen = carried;
    const auto side = [&](double change) {
      return moving.flow.closed(moved_along(start, moving.model.tangent, 0, change));
    };
    const Point<double> above = side(kSeparation), below = side(-kSeparation);
    const Point<double> high = moving.later(above, kInterval / 20, 200),
                        low = moving.later(below, kInterval / 20, 200);
    for (Eigen::Index i = 0; i < carried.size(); ++i) {
      carried[i] = above.x[std::size_t(i)] - below.x[std::size_t(i)];
      seen[i] = high.x[std::size_t(i)] - low.x[std::size_t(i)];
    }
    for (const Eigen::MatrixXd& transition : transition_matrices(moving.flow, points))
      carried = transition * carried;
    EXPECT_LT((carried - seen).norm(), 1e-3 * seen.norm()) << treatment;
  }
}

TEST(LoopStudies, LoopsOpenByWhatNewtonIterationsLeave) {
  const Moving moving(four_bar("partitioned"));
  WorkPrecision work;
  WorkPoint point;
  point.method = method_called(moving.model.table(), "rk4");
  point.h = 0.002;
  work.points = {point};
  const std::vector<LoopRun> runs = study_loops(moving.flow, work, nullptr, 1);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].steps, 500);
  EXPECT_EQ(runs[1].steps, 50);
  EXPECT_EQ(runs[1].h, 0.02);
  EXPECT_LT(runs[0].open.position, 1e-14);
  EXPECT_LT(runs[1].open.position, 1e-4);
  EXPECT_TRUE(runs[0].finite && runs[1].finite);
}

TEST(LoopStudies, TheReferenceStaysOnTheLoops) {
  const Moving moving(four_bar("multipliers"));
  const ReferenceSolution reference =
      solve_reference(moving.flow, nullptr, ReferenceKind::kCvode, 0.0625, 8, 1, 1, kSilent);
  for (const Point<double>& point : reference.points) EXPECT_LT(moving.flow.residuals(point).position, 1e-11);
}

}  // namespace
}  // namespace jourdain::tests
