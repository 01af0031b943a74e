// Joint accelerations of robots against those computed otherwise: public robots by an independent library (its
// articulated-body algorithm), ours in descriptor form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "agreement/compiled_batch.hpp"
#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"

namespace jourdain::tests {
namespace {

// Two ways of computing in double, and condition numbers of M up to some 1e4.
constexpr double kExactTolerance = 1e-11;
// Rotations within 1e-9 of a signed permutation are read as one, which the library does not do.
constexpr double kSnappedTolerance = 1e-9;

/// Largest normwise error of the reference's accelerations over the states of a case.
double worst_error(const AccelerationCase& given, const model::Mechanism& mechanism) {
  const reference::Reference<double> reference(mechanism);
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

/// Largest normwise error over the states of a case, of the accelerations that `compute` gives.
template <class Compute>
double worst_over_states(const AccelerationCase& given, const model::Mechanism& mechanism,
                         Compute&& compute) {
  double worst = 0;
  for (const AccelerationState& state : given.states) {
    const auto order = [&](const std::vector<double>& v) {
      return in_coordinate_order(mechanism, given.joints, v);
    };
    const auto list = [](const reference::VectorX<double>& v) {
      return std::vector<double>(v.begin(), v.end());
    };
    Sample sample;
    sample.y = list(order(state.position));
    sample.z = list(order(state.velocity));
    sample.u = list(in_actuator_order(mechanism, given.joints, state.torque));
    sample.zdot.resize(sample.z.size(), 0.0);
    const std::vector<double> zdot = compute(sample);
    const Eigen::Map<const reference::VectorX<double>> computed(zdot.data(), Eigen::Index(zdot.size()));
    worst = larger_error(worst, normwise_error(computed, order(state.acceleration)));
  }
  return worst;
}

class SharedAccelerations : public testing::Test {
 protected:
  static model::Mechanism undamped(const AccelerationCase& given) {
    model::ReadOptions options;
    options.damping = false;
    options.mimic = false;  // as in the data
    return read_model(urdf_path(given.robot), options);
  }
  std::vector<AccelerationCase> cases_ = fixed_root_accelerations();
};

TEST_F(SharedAccelerations, CoverEveryCoordinate) {
  EXPECT_GE(cases_.size(), 2u);
  for (const AccelerationCase& given : cases_) {
    const model::Mechanism mechanism = undamped(given);
    EXPECT_EQ(model::moving_joints(mechanism).size(), given.joints.size()) << given.robot;
    EXPECT_EQ(mechanism.actuators.size(), given.joints.size()) << given.robot;
    EXPECT_GE(given.states.size(), 8u) << given.robot;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(mechanism.gravity[i].constant(), given.gravity[i]) << given.robot;
  }
}

TEST_F(SharedAccelerations, AgreeWithTheReferenceWithoutSnapping) {
  for (const AccelerationCase& given : cases_) {
    const double error = worst_error(given, model::with_directions_as_read(undamped(given)));
    EXPECT_LE(error, kExactTolerance) << given.robot;
    RecordProperty(given.robot, fmt::format("{:.1e}", error));
  }
}

TEST_F(SharedAccelerations, AgreeWithTheReferenceWithSnapping) {
  for (const AccelerationCase& given : cases_)
    EXPECT_LE(worst_error(given, undamped(given)), kSnappedTolerance) << given.robot;
}

TEST_F(SharedAccelerations, AgreeWithInterpreterAndCompiledCode) {
  fmt::print("{:<18} {:>12} {:>12} {:>12}\n", "robot", "interpreter", "compiled", "no snapping");
  for (const AccelerationCase& given : cases_) {
    model::Mechanism mechanism = undamped(given);
    const Derived derived = derive(mechanism);
    const auto interpret = [](const Derived& d) {
      return [&d](const Sample& sample) { return interpreted<double>(d.module, "forward_dynamics", sample); };
    };
    const double interpreter = worst_over_states(given, mechanism, interpret(derived));
    const CompiledBatch batch({emit_model(derived, "robot")}, "g++", "double", {"-O1"});
    const double compiled = worst_over_states(
        given, mechanism, [&](const Sample& sample) { return batch.evaluate(0, sample).zdot; });
    mechanism = model::with_directions_as_read(mechanism);
    const Derived unsnapped = derive(mechanism);
    const double exact = worst_over_states(given, mechanism, interpret(unsnapped));
    fmt::print("{:<18} {:>12.1e} {:>12.1e} {:>12.1e}\n", given.robot, interpreter, compiled, exact);
    EXPECT_LE(interpreter, kSnappedTolerance) << given.robot;
    EXPECT_LE(compiled, kSnappedTolerance) << given.robot;
    EXPECT_LE(exact, kExactTolerance) << given.robot;
  }
}

TEST_F(SharedAccelerations, TakeAsFewOperationsAsEver) {
  const auto operations = [](const std::string& robot, const std::string& function) {
    model::ReadOptions options;
    options.damping = false;
    if (robot == "panda") options.locked_joints = {"panda_finger_joint1", "panda_finger_joint2"};
    const model::Mechanism mechanism = read_model(urdf_path(robot), options);
    dynamics::DerivationOptions chosen;
    choose_articulation(mechanism, {}).set(chosen);
    for (const ir::Program& program : derive(mechanism, chosen).module.functions)
      if (program.name == function) return ir::count_operations(program).arithmetic();
    return std::size_t(0);
  };
  struct Best {
    const char *robot, *function;
    std::size_t operations;
  };
  const Best best[] = {{"rail_arm", "forward_dynamics", 781},
                       {"rail_arm", "mass_matrix", 281},
                       {"biped", "forward_dynamics", 1465},
                       {"ur5", "forward_dynamics", 360},
                       {"ur5", "mass_matrix", 85},
                       {"panda", "forward_dynamics", 997},
                       {"panda", "mass_matrix", 313},
                       {"hyq", "forward_dynamics", 580},
                       {"talos_reduced", "forward_dynamics", 5696}};
  for (const Best& entry : best)
    if (has_robot(entry.robot)) {
      EXPECT_EQ(operations(entry.robot, entry.function), entry.operations)
          << entry.robot << " " << entry.function;
    }
}

/// A robot with some of its joints locked.
void expect_agreement_with_locked(const std::string& robot, const std::vector<std::string>& locked,
                                  std::size_t freedom) {
  model::ReadOptions options;
  options.damping = false;
  options.locked_joints = locked;
  const Derived derived = derive(read_model(urdf_path(robot), options));
  ASSERT_EQ(derived.equations.zdot.size(), freedom);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Sample sample = random_sample(derived.mechanism, seed);
    const Judge judge(derived, sample);
    const std::vector<double> zdot = interpreted<double>(derived.module, "forward_dynamics", sample);
    EXPECT_LE(judge.backward_error(zdot), 1e-14);
    const reference::VectorX<double> expected = reference::forward_dynamics(judge.terms()).cast<double>();
    const Eigen::Map<const reference::VectorX<double>> computed(zdot.data(), Eigen::Index(zdot.size()));
    EXPECT_LE(normwise_error(computed, expected), kExactTolerance);
  }
}

TEST_F(SharedAccelerations, LockedJointsLeaveAgreementWithTheReference) {
  expect_agreement_with_locked("rail_arm", {"slide", "roll"}, 4);
  if (has_robot("panda"))
    expect_agreement_with_locked("panda", {"panda_finger_joint1", "panda_finger_joint2"}, 7);
}

}  // namespace
}  // namespace jourdain::tests
