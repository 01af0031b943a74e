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

std::filesystem::path data_path(const std::string& name) {
  return std::filesystem::path(JOURDAIN_SOURCE_DIR) / "tests/data" / name;
}

std::filesystem::path public_data_path(const std::string& name) {
  return std::filesystem::path(JOURDAIN_SOURCE_DIR "/../shared/data") / name;
}

std::vector<std::string> robots_with_accelerations(const std::string& root) {
  std::vector<std::string> robots;
  for (const std::filesystem::path& folder :
       {data_path("accelerations"), public_data_path("accelerations")}) {
    if (folder != data_path("accelerations") && !std::filesystem::exists(folder)) {
      fmt::print("no public robots in {}: those of tests/data alone\n", folder.string());
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string file = entry.path().filename().string(), end = "." + root + ".json";
      if (file.ends_with(end)) found.push_back(file.substr(0, file.size() - end.size()));
    }
    std::sort(found.begin(), found.end());
    robots.insert(robots.end(), found.begin(), found.end());
  }
  return robots;
}

std::filesystem::path accelerations_path(const std::string& robot, const std::string& root) {
  const std::string name = fmt::format("accelerations/{}.{}.json", robot, root);
  return std::filesystem::exists(data_path(name)) ? data_path(name) : public_data_path(name);
}

std::filesystem::path urdf_path(const std::string& robot) {
  const std::filesystem::path ours = data_path("robots/" + robot + ".urdf");
  return std::filesystem::exists(ours) ? ours : public_data_path("urdf/" + robot + ".urdf");
}

bool has_robot(const std::string& robot) {
  const bool found = std::filesystem::exists(urdf_path(robot));
  if (!found) fmt::print("public robot {} is not there: a case less\n", robot);
  return found;
}

model::Mechanism read_model(const std::filesystem::path& path, const model::ReadOptions& options) {
  support::Diagnostics diagnostics(path.string(), support::read_file(path.string()));
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, options);
  if (!mechanism) throw std::runtime_error(diagnostics.format());
  return *mechanism;
}

std::vector<AccelerationCase> fixed_root_accelerations() {
  std::vector<AccelerationCase> cases;
  for (const std::string& robot : robots_with_accelerations("fixed")) {
    const json data = read_json(accelerations_path(robot, "fixed"));
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
  const json data = read_json(data_path("reference/puma560.json"));
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
