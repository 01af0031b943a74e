// The published and independently computed cases that tests compare with, as plain data. tests/data is part of
// the project: what is missing there fails. Public robots that may not be redistributed lie beside the project
// and add cases where they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {

/// A model of the project: models/<name>.
std::filesystem::path model_path(const std::string& name);
/// tests/data/<name>.
std::filesystem::path data_path(const std::string& name);
/// The folder of public robots beside the project; it need not be there.
std::filesystem::path public_data_path(const std::string& name);

/// Names of the robots with accelerations for that root ("fixed", "free"): ours, and the public ones that are there.
std::vector<std::string> robots_with_accelerations(const std::string& root);
/// The file of those accelerations.
std::filesystem::path accelerations_path(const std::string& robot, const std::string& root);
/// Is the robot's description there? Says so on the terminal where it is not. Ours always is.
bool has_robot(const std::string& robot);

/// Reads a model file; throws std::runtime_error with the diagnostics when it has errors.
model::Mechanism read_model(const std::filesystem::path& path, const model::ReadOptions& options = {});

/// One state of a robot and the joint accelerations that an independent library computes there. rad, m, N m,
/// N.
struct AccelerationState {
  std::vector<double> position, velocity, torque, acceleration;
};

/// One file of accelerations; the entries of each state follow `joints`.
struct AccelerationCase {
  std::string robot;
  std::vector<double> gravity;
  std::vector<std::string> joints;
  std::vector<AccelerationState> states;
};

/// Those of `robots_with_accelerations("fixed")`.
std::vector<AccelerationCase> fixed_root_accelerations();
/// Description of a robot of ours, or of a public one.
std::filesystem::path urdf_path(const std::string& robot);

/// Values of `joints` (same order and count) in the order of the mechanism's coordinates; a coordinate
/// without a value throws std::runtime_error.
reference::VectorX<double> in_coordinate_order(const model::Mechanism& mechanism,
                                               const std::vector<std::string>& joints,
                                               const std::vector<double>& values);
/// The same in the order of the mechanism's actuators, by the joints that they act on.
reference::VectorX<double> in_actuator_order(const model::Mechanism& mechanism,
                                             const std::vector<std::string>& joints,
                                             const std::vector<double>& values);

/// ‖actual − expected‖ / ‖expected‖ over all entries.
double normwise_error(const reference::MatrixX<double>& actual, const reference::MatrixX<double>& expected);

/// The larger of two errors; NaN where one is, which std::max would drop.
double larger_error(double one, double other);

/// Published outputs of the Puma 560: tau = M qdd + c + g, that is c = −k̄ and g = q̄ without inputs.
struct PumaCase {
  reference::VectorX<double> q, qd, qdd, tau, g, c;
  reference::MatrixX<double> M;
};

/// Reads tests/data/reference/puma560.json.
PumaCase read_puma_case();

}  // namespace jourdain::tests
