// Accelerations, joint reactions and drives of every model of the repository against the descriptor form,
// loops left open.
#include "reference/descriptor.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"

namespace jourdain::tests {
namespace {

using Vector = reference::VectorX<long double>;

// Double against long double; accelerations and wrenches relative to the largest of the model's.
constexpr double kTolerance = 1e-10;
constexpr std::uint64_t kStates = 20;

/// The model's tree with a reaction output for each joint and a drive for each prescribed coordinate, and nothing else.
model::Mechanism with_all_reactions(model::Mechanism mechanism) {
  mechanism.outputs.clear();
  mechanism.loops.clear();
  const auto add = [&](model::OutputKind kind, std::size_t joint, std::size_t coordinate) {
    model::Output output;
    output.name = fmt::format("out{}", mechanism.outputs.size());
    output.kind = kind;
    output.joint = model::JointIndex(joint);
    output.coordinate = coordinate;
    mechanism.outputs.push_back(output);
  };
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    add(model::OutputKind::kReaction, j, 0);
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (mechanism.joints[j].coordinates[c].motion) add(model::OutputKind::kDrive, j, c);
  }
  return mechanism;
}

Vector to_vector(const std::vector<double>& values) {
  Vector v(Eigen::Index(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[Eigen::Index(i)] = values[i];
  return v;
}

/// Numbers of the outputs as the descriptor form has them.
std::vector<double> expected_outputs(const model::Mechanism& mechanism,
                                     const reference::DescriptorSolution<long double>& solution) {
  std::vector<double> values;
  for (const model::Output& output : mechanism.outputs) {
    const std::size_t j = output.joint.value;
    if (output.kind == model::OutputKind::kDrive) {
      values.push_back(double(*solution.drives[j][output.coordinate]));
      continue;
    }
    const auto &own = solution.reactions[j], &rotor = solution.rotor_wrenches[j];
    for (int i = 0; i < 3; ++i) values.push_back(double(own.force[i] + rotor.force[i]));
    for (int i = 0; i < 3; ++i) values.push_back(double(own.moment[i] + rotor.moment[i]));
  }
  return values;
}

/// Of the largest expected number, or of `size`.
double relative_error(const std::vector<double>& actual, const std::vector<double>& expected,
                      double size = 1e-3) {
  double worst = 0;
  for (const double value : expected) size = std::max(size, std::fabs(value));
  for (std::size_t i = 0; i < expected.size(); ++i)
    worst = larger_error(worst, std::fabs(actual.at(i) - expected[i]) / size);
  return worst;
}

TEST(DescriptorForm, GivesAccelerationsReactionsAndDrivesOfEveryModel) {
  fmt::print("{:<20} {:>14} {:>10}\n", "model", "accelerations", "reactions");
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(model_path("").parent_path()))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  ASSERT_GE(paths.size(), 16u);
  for (const auto& path : paths) {
    const Derived derived = derive(with_all_reactions(read_model(path)));
    double accelerations = 0, reactions = 0;
    for (std::uint64_t seed = 0; seed < kStates; ++seed) {
      const Sample sample = random_sample(derived.mechanism, seed);
      const std::vector<long double> parameters(sample.parameters.begin(), sample.parameters.end());
      const reference::DescriptorReference<long double> form(derived.mechanism, parameters);
      const auto solution =
          form.solve(sample.t, to_vector(sample.y), to_vector(sample.z), to_vector(sample.u));
      const Eigen::VectorXd zdot = solution.zdot.cast<double>();
      accelerations = larger_error(
          accelerations, relative_error(interpreted<double>(derived.module, "forward_dynamics", sample),
                                        {zdot.begin(), zdot.end()}));
      reactions =
          larger_error(reactions, relative_error(interpreted<double>(derived.module, "outputs", sample),
                                                 expected_outputs(derived.mechanism, solution),
                                                 1e-3 * (1 + zdot.lpNorm<Eigen::Infinity>())));
    }
    fmt::print("{:<20} {:>14.1e} {:>10.1e}\n", path.stem().string(), accelerations, reactions);
    EXPECT_LE(accelerations, kTolerance) << path;
    EXPECT_LE(reactions, kTolerance) << path;
  }
}

}  // namespace
}  // namespace jourdain::tests
