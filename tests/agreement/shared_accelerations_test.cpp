// Joint accelerations of real robots against those of an independent library (its articulated-body
// algorithm).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shared_data.hpp"

namespace jourdain::tests {
namespace {

// Two ways of computing in double, and condition numbers of M up to some 1e4.
constexpr double kExactTolerance = 1e-11;
// Rotations within 1e-9 of a signed permutation are read as one, which the library does not do.
constexpr double kSnappedTolerance = 1e-9;

/// Largest normwise error of the reference's accelerations over the states of a case.
double worst_error(const AccelerationCase& given, const model::Mechanism& mechanism, reference::Snap snap) {
  const reference::Reference<double> reference(mechanism, snap);
  double worst = 0;
  for (const AccelerationState& state : given.states) {
    const auto order = [&](const std::vector<double>& v) {
      return in_coordinate_order(mechanism, given.joints, v);
    };
    const reference::VectorX<double> u = in_actuator_order(mechanism, given.joints, state.torque);
    const auto terms =
        reference.evaluate({.t = 0, .y = order(state.position), .z = order(state.velocity)}, u);
    worst =
        larger_error(worst, normwise_error(reference::forward_dynamics(terms), order(state.acceleration)));
  }
  return worst;
}

class SharedAccelerations : public testing::Test {
 protected:
  void SetUp() override {
    if (cases_.empty()) GTEST_SKIP() << "no data in " << shared_path("data/accelerations");
  }
  static model::Mechanism undamped(const AccelerationCase& given) {
    model::ReadOptions options;
    options.damping = false;
    return read_model(urdf_path(given.robot), options);
  }
  std::vector<AccelerationCase> cases_ = fixed_root_accelerations();
};

TEST_F(SharedAccelerations, CoverFiveRobotsInEveryCoordinate) {
  EXPECT_EQ(cases_.size(), 5u);
  for (const AccelerationCase& given : cases_) {
    const model::Mechanism mechanism = undamped(given);
    EXPECT_EQ(model::moving_joints(mechanism).size(), given.joints.size()) << given.robot;
    EXPECT_EQ(mechanism.actuators.size(), given.joints.size()) << given.robot;
    EXPECT_EQ(given.states.size(), 20u) << given.robot;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(mechanism.gravity[i].constant(), given.gravity[i]) << given.robot;
  }
}

TEST_F(SharedAccelerations, AgreeWithTheReferenceWithoutSnapping) {
  for (const AccelerationCase& given : cases_) {
    const double error = worst_error(given, undamped(given), reference::Snap::kOff);
    EXPECT_LE(error, kExactTolerance) << given.robot;
    RecordProperty(given.robot, fmt::format("{:.1e}", error));
  }
}

TEST_F(SharedAccelerations, AgreeWithTheReferenceWithSnapping) {
  for (const AccelerationCase& given : cases_)
    EXPECT_LE(worst_error(given, undamped(given), reference::Snap::kAsModel), kSnappedTolerance)
        << given.robot;
}

}  // namespace
}  // namespace jourdain::tests
