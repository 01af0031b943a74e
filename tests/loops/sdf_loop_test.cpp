// A linkage read from SDF, whose fourth joint closes the loop, moves as the one that is described in TOML.
#include <gtest/gtest.h>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"

namespace jourdain::tests {
namespace {

using VectorL = reference::VectorX<long double>;

// Five rows in space against two in the plane, where the redundant ones are regularised.
constexpr double kTolerance = 1e-9;

model::Mechanism with_multipliers(model::Mechanism mechanism) {
  mechanism.loop_options = {};
  mechanism.loop_options.treatment = model::LoopTreatment::kMultipliers;
  return mechanism;
}

TEST(SdfLoop, MovesAsTheSameLinkageInToml) {
  const ClosedPrograms expected(with_multipliers(read_model(model_path("four_bar.toml"))));
  const model::Mechanism mechanism = read_model(data_path("sdf/four_bar.sdf"));
  ASSERT_EQ(mechanism.loops.size(), 1u);
  EXPECT_EQ(mechanism.loops[0].name, "four_bar::pin");
  const ClosedPrograms found(with_multipliers(mechanism));
  EXPECT_EQ(found.plan().freedom, 1u);
  LoopState at_start;  // angles count from the start in SDF
  at_start.y = VectorL::Zero(3);
  at_start.z = VectorL::Zero(3);
  LoopState as_described = at_start;
  for (std::size_t k = 0; k < 3; ++k) {
    as_described.y[Eigen::Index(k)] = static_cast<long double>(expected.plan().y[k]);
    as_described.z[Eigen::Index(k)] = at_start.z[Eigen::Index(k)] =
        static_cast<long double>(expected.plan().z[k]);
  }
  VectorL motor(1), motors(3);  // SDF has an input for each joint
  motor << 0.7L;
  motors << 0.7L, 0, 0;
  const VectorL zdot = expected.accelerations(as_described, motor);
  EXPECT_GT(static_cast<double>(zdot.norm()), 10);
  EXPECT_LE(static_cast<double>((found.accelerations(at_start, motors) - zdot).norm() / zdot.norm()),
            kTolerance);
}

}  // namespace
}  // namespace jourdain::tests
