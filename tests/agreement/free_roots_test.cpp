// Robots on a free root against accelerations that were computed otherwise: public ones by an independent
// library, ours in descriptor form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "agreement/compiled_batch.hpp"
#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "compile/compile.hpp"
#include "model/coordinates.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;

// Snapped rotations change accelerations by some 1e-11.
constexpr double kTolerance = 1e-9;

model::Mechanism free_robot(const std::string& robot) {
  model::ReadOptions options;
  options.damping = false;
  options.root = model::RootJoint::kFree;
  return read_model(urdf_path(robot), options);
}

/// Values named as in the files, in the order of `names`.
std::vector<double> in_order(const std::vector<std::string>& names,
                             const std::map<std::string, double>& values) {
  std::vector<double> list;
  for (const std::string& name : names) list.push_back(values.at(name));
  return list;
}

class Values {
 public:
  Values(const json& data, const json& state) : data_(data), state_(state) {}

  void add(const char* key, std::initializer_list<const char*> names) {
    std::size_t i = 0;
    for (const char* name : names) values[std::string("root_") + name] = state_[key][i++];
  }
  void add_joints(const char* key) {
    for (std::size_t i = 0; i < data_["joints"].size(); ++i) values[data_["joints"][i]] = state_[key][i];
  }
  std::map<std::string, double> values;

 private:
  const json &data_, &state_;
};

struct Case {
  Sample sample;
  reference::VectorX<double> zdot;
};

Case read_case(const json& data, const json& state, const model::CoordinateLayout& layout) {
  Values y(data, state), z(data, state), zdot(data, state), u(data, state);
  y.add("root_position", {"x", "y", "z"});
  y.add("root_quaternion_wxyz", {"qw", "qx", "qy", "qz"});
  y.add_joints("position");
  z.add("root_velocity_world", {"vx", "vy", "vz"});
  z.add("root_angular_velocity_body", {"wx", "wy", "wz"});
  z.add_joints("velocity");
  zdot.add("root_acceleration_world", {"vx", "vy", "vz"});
  zdot.add("root_angular_acceleration_body", {"wx", "wy", "wz"});
  zdot.add_joints("acceleration");
  u.add_joints("torque");
  Case result;
  result.sample.y = in_order(layout.position_names, y.values);
  result.sample.z = in_order(layout.velocity_names, z.values);
  result.sample.u = in_order(layout.input_names, u.values);
  result.sample.zdot.assign(result.sample.z.size(), 0.0);
  const std::vector<double> expected = in_order(layout.velocity_names, zdot.values);
  result.zdot = Eigen::Map<const reference::VectorX<double>>(expected.data(), Eigen::Index(expected.size()));
  return result;
}

double worst_error(const std::vector<Case>& cases, const auto& compute) {
  double worst = 0;
  for (const Case& c : cases) {
    const std::vector<double> zdot = compute(c.sample);
    const Eigen::Map<const reference::VectorX<double>> computed(zdot.data(), Eigen::Index(zdot.size()));
    worst = larger_error(worst, normwise_error(computed, c.zdot));
  }
  return worst;
}

TEST(FreeRoots, MatchIndependentAccelerations) {
  const std::vector<std::string> robots = robots_with_accelerations("free");
  ASSERT_FALSE(robots.empty());
  for (const std::string& robot : robots) {
    std::ifstream file(accelerations_path(robot, "free"));
    const json data = json::parse(file);
    model::Mechanism mechanism = free_robot(robot);
    const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
    std::vector<Case> cases;
    for (const json& state : data["states"]) cases.push_back(read_case(data, state, layout));
    ASSERT_GE(cases.size(), 8u);

    const auto interpret = [](const Derived& derived) {
      return
          [&derived](const Sample& s) { return interpreted<double>(derived.module, "forward_dynamics", s); };
    };
    dynamics::DerivationOptions chosen;
    choose_articulation(mechanism, {}).set(chosen);
    const Derived mixed = derive(mechanism, chosen), factorised = derive(mechanism);
    const double snapped = worst_error(cases, interpret(mixed));
    const double plain = worst_error(cases, interpret(factorised));
    mechanism = model::with_directions_as_read(mechanism);
    const Derived exact = derive(mechanism, chosen);
    const double unsnapped = worst_error(cases, interpret(exact));
    fmt::print("{:<14} chosen {:.1e}, factorised {:.1e}, without snapping {:.1e}\n", robot, snapped, plain,
               unsnapped);
    EXPECT_LE(snapped, kTolerance) << robot;
    EXPECT_LE(plain, kTolerance) << robot;
    EXPECT_LE(unsnapped, 1e-11) << robot;
  }
}

TEST(FreeRoots, TakeFewOperations) {
  const auto operations = [](const std::string& robot) {
    const model::Mechanism mechanism = free_robot(robot);
    dynamics::DerivationOptions options;
    choose_articulation(mechanism, {}).set(options);
    for (const ir::Program& program : derive(mechanism, options).module.functions)
      if (program.name == "forward_dynamics") return ir::count_operations(program).arithmetic();
    return std::size_t(0);
  };
  const std::map<std::string, std::size_t> best = {{"biped", 3863}, {"hyq", 2609}, {"talos_reduced", 8595}};
  for (const auto& [robot, count] : best)
    if (has_robot(robot)) {
      EXPECT_EQ(operations(robot), count) << robot;
    }
}

}  // namespace
}  // namespace jourdain::tests
