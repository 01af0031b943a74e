#include "shared_data.hpp"
#include "support/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace jourdain::tests {

namespace {

using nlohmann::json;

json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  return json::parse(file);
}

/// Numbers are written as such, or as text where that shows more digits.
double number(const json& value) {
  return value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr) : value.get<double>();
}

reference::VectorX<double> vector(const json& values) {
  reference::VectorX<double> result(Eigen::Index(values.size()));
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = number(values[std::size_t(i)]);
  return result;
}

double value_of(const std::string& joint, const std::vector<std::string>& joints,
                const std::vector<double>& values) {
  const auto found = std::find(joints.begin(), joints.end(), joint);
  if (found == joints.end()) throw std::runtime_error(fmt::format("no value for joint '{}'", joint));
  return values.at(std::size_t(found - joints.begin()));
}

}  // namespace

std::filesystem::path model_path(const std::string& name) {
  return std::filesystem::path(JOURDAIN_SOURCE_DIR) / "models" / name;
}

std::filesystem::path shared_path(const std::string& name) {
  return std::filesystem::path(JOURDAIN_SOURCE_DIR "/../shared") / name;
}

std::filesystem::path urdf_path(const std::string& robot) {
  return shared_path("data/urdf/" + robot + ".urdf");
}

model::Mechanism read_model(const std::filesystem::path& path, const model::ReadOptions& options) {
  support::Diagnostics diagnostics(path.string(), support::read_file(path.string()));
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, options);
  if (!mechanism) throw std::runtime_error(diagnostics.format());
  return *mechanism;
}

std::vector<AccelerationCase> fixed_root_accelerations() {
  const std::filesystem::path folder = shared_path("data/accelerations");
  if (!std::filesystem::exists(folder)) return {};
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(".fixed.json")) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<AccelerationCase> cases;
  for (const std::filesystem::path& path : paths) {
    const json data = read_json(path);
    AccelerationCase& read =
        cases.emplace_back(AccelerationCase{data["robot"], data["gravity"], data["joints"], {}});
    for (const json& state : data["states"])
      read.states.push_back({state["position"], state["velocity"], state["torque"], state["acceleration"]});
  }
  return cases;
}

reference::VectorX<double> in_coordinate_order(const model::Mechanism& mechanism,
                                               const std::vector<std::string>& joints,
                                               const std::vector<double>& values) {
  const std::vector<model::JointIndex> order = model::moving_joints(mechanism);
  reference::VectorX<double> result(Eigen::Index(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i)
    result[Eigen::Index(i)] = value_of(mechanism.joints[order[i].value].name, joints, values);
  return result;
}

reference::VectorX<double> in_actuator_order(const model::Mechanism& mechanism,
                                             const std::vector<std::string>& joints,
                                             const std::vector<double>& values) {
  reference::VectorX<double> result(Eigen::Index(mechanism.actuators.size()));
  for (std::size_t i = 0; i < mechanism.actuators.size(); ++i)
    result[Eigen::Index(i)] =
        value_of(mechanism.joints[mechanism.actuators[i].joint.value].name, joints, values);
  return result;
}

double normwise_error(const reference::MatrixX<double>& actual, const reference::MatrixX<double>& expected) {
  return (actual - expected).norm() / expected.norm();
}

double larger_error(double one, double other) { return one <= other || std::isnan(other) ? other : one; }

PumaCase read_puma_case() {
  const json data = read_json(shared_path("reference/puma560.json"));
  reference::MatrixX<double> M(6, 6);
  for (Eigen::Index row = 0; row < 6; ++row) M.row(row) = vector(data["M"][std::size_t(row)]);
  return {vector(data["q"]),
          vector(data["qd"]),
          vector(data["qdd"]),
          vector(data["tau"]),
          vector(data["g"]),
          vector(data["c"]),
          M};
}

}  // namespace jourdain::tests
