// Jacobians of the emitted programs against differences of the symbolic equations in 60 digits, entry by
// entry: every model and hundreds of random scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <filesystem>
#include <set>

#include "agreement/leaf_value.hpp"
#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "dynamics/direction.hpp"
#include "dynamics/outputs.hpp"
#include "kinematics/numbers.hpp"
#include "properties/effort.hpp"
#include "properties/random_laws.hpp"
#include "properties/random_mixture.hpp"
#include "properties/random_scene.hpp"

namespace jourdain::tests {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

const std::uint64_t kScenes = draws_all_cases() ? 60 : 9, kScenesWithLaws = cases(24);
// Normwise; the derivatives of accelerations are solved with M, whose condition number is up to 1e8 in random scenes.
constexpr double kRelative = 1e-11, kOverCondition = 1e-14;

ir::Module derivative_module(const model::Mechanism& mechanism,
                             programs::DerivativeTerms terms = programs::DerivativeTerms::kAll) {
  const auto functions =
      programs::with_needed({"residual_derivatives", "forward_dynamics_derivatives", "linearize"},
                            programs::scene_facts(mechanism));
  ir::Module module;
  module.functions = programs::derivative_programs(programs::tree_sources(mechanism, {}), functions, terms);
  return passes::optimise(module).module;
}

/// Exact derivatives, a column each for displacements, velocities, inputs and time.
struct Exact {
  MatrixXd residual, zdot, outputs;
};

Exact exact_derivatives(const Derived& derived, const Sample& sample) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(derived.mechanism);
  const std::size_t nz = sample.z.size(), nu = sample.u.size(), columns = 2 * nz + nu + 1;
  Exact exact;
  for (std::size_t c = 0; c < columns; ++c) {
    dynamics::Direction d{std::vector<double>(nz), std::vector<double>(nz), std::vector<double>(nu), 0};
    (c < nz            ? d.displacement[c]
     : c < 2 * nz      ? d.velocity[c - nz]
     : c < 2 * nz + nu ? d.input[c - 2 * nz]
                       : d.time) = 1;
    const dynamics::SlopePrecision along = dynamics::moved_along(
        dynamics::exact(d), derived.equations.statements, layout.tangent,
        [&](kinematics::LeafKind kind, std::size_t i) { return leaf_value(sample, kind, i); });
    const auto rates = [&](const std::vector<kinematics::Ex>& expressions) {
      std::vector<double> list;
      for (const kinematics::Ex& e : expressions) list.push_back(dynamics::to_double(along.value(e).first));
      return list;
    };
    std::vector<kinematics::Ex> residual;
    for (std::size_t i = 0; i < nz; ++i) {
      residual.push_back(derived.equations.q_bar[i] - derived.equations.k_bar[i]);
      for (std::size_t j = 0; j < nz; ++j)
        residual[i] = residual[i] + derived.equations.M[i][j] * kinematics::exact(sample.zdot[j]);
    }
    const auto set = [&](MatrixXd& matrix, const std::vector<double>& column) {
      if (c == 0) matrix.resize(Index(column.size()), Index(columns));
      for (std::size_t i = 0; i < column.size(); ++i) matrix(Index(i), Index(c)) = column[i];
    };
    set(exact.residual, rates(residual));
    set(exact.zdot, rates(derived.equations.zdot));
    set(exact.outputs, rates(dynamics::output_entries(derived.equations)));
  }
  return exact;
}

/// An array of a function, zero where the program writes nothing.
MatrixXd array_of(const ir::Module& module, const std::string& function, const std::string& name, Index rows,
                  Index columns, const Sample& sample) {
  MatrixXd matrix = MatrixXd::Zero(rows, columns);
  const std::vector<double> values = interpreted<double>(module, function, sample);
  for (const ir::Program& program : module.functions)
    if (program.name == function)
      for (std::size_t k = 0; k < values.size(); ++k)
        if (program.outputs[k].name == name)
          matrix(program.outputs[k].row, std::max(0, program.outputs[k].column)) = values[k];
  return matrix;
}

double relative(const MatrixXd& actual, const MatrixXd& exact) {
  if (actual.size() == 0) return 0;
  const double norm = exact.norm(), difference = (actual - exact).norm();
  return difference == 0 ? 0 : difference / norm;
}

/// Worst normwise errors.
struct Errors {
  double residual = 0, zdot = 0, zdot_over_condition = 0, outputs_over_condition = 0, time = 0;

  void widen(const Errors& other) {
    residual = larger_error(residual, other.residual);
    zdot = larger_error(zdot, other.zdot);
    zdot_over_condition = larger_error(zdot_over_condition, other.zdot_over_condition);
    outputs_over_condition = larger_error(outputs_over_condition, other.outputs_over_condition);
    time = larger_error(time, other.time);
  }
};

Errors errors_of(const Derived& derived, const Sample& sample) {
  const ir::Module module = derivative_module(derived.mechanism);
  const Exact exact = exact_derivatives(derived, sample);
  const Index n = Index(sample.z.size()), nu = Index(sample.u.size());
  const double condition = Judge(derived, sample).condition();
  Errors errors;
  const auto r = [&](const char* name, Index columns) {
    return array_of(module, "residual_derivatives", name, n, columns, sample);
  };
  errors.residual = relative(r("r_y", n), exact.residual.leftCols(n));
  errors.residual = larger_error(errors.residual, relative(r("r_z", n), exact.residual.middleCols(n, n)));
  errors.residual =
      larger_error(errors.residual, relative(r("r_u", nu), exact.residual.middleCols(2 * n, nu)));
  errors.time = relative(r("r_t", 1), exact.residual.rightCols(1));
  const auto f = [&](const char* name) {
    return array_of(module, "forward_dynamics_derivatives", name, n, n, sample);
  };
  errors.zdot = larger_error(relative(f("zdot_y"), exact.zdot.leftCols(n)),
                             relative(f("zdot_z"), exact.zdot.middleCols(n, n)));
  // States displace nothing: x has a number less for each.
  const auto moved = Index(model::lay_out_coordinates(derived.mechanism).first_state()), nx = moved + n;
  const auto by_state = [&](const MatrixXd& by_all) {
    MatrixXd columns(by_all.rows(), nx);
    columns << by_all.leftCols(moved), by_all.middleCols(n, n);
    return columns;
  };
  const MatrixXd A = array_of(module, "linearize", "A", nx, nx, sample),
                 B = array_of(module, "linearize", "B", nx, nu, sample);
  errors.zdot = larger_error(errors.zdot, relative(A.bottomRows(n), by_state(exact.zdot)));
  errors.zdot = larger_error(errors.zdot, relative(B.bottomRows(n), exact.zdot.middleCols(2 * n, nu)));
  const MatrixXd rate_t = array_of(module, "linearize", "rate_t", nx, 1, sample);
  errors.zdot = larger_error(errors.zdot, relative(rate_t.bottomRows(n), exact.zdot.rightCols(1)));
  errors.zdot_over_condition = errors.zdot / condition;
  const Index no = exact.outputs.rows();
  if (no > 0) {
    MatrixXd CD(no, nx + nu + 1), expected = CD;
    expected << by_state(exact.outputs), exact.outputs.rightCols(nu + 1);
    CD << array_of(module, "linearize", "C", no, nx, sample),
        array_of(module, "linearize", "D", no, nu, sample),
        array_of(module, "linearize", "output_t", no, 1, sample);
    errors.outputs_over_condition = relative(CD, expected) / condition;
  }
  return errors;
}

TEST(Derivatives, OfEveryModelAgreeWithDifferencesInSixtyDigits) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(model_path("")))
    if (entry.path().extension() == ".toml") paths.insert(entry.path());
  std::size_t number = 0;
  for (const std::filesystem::path& path : paths) {
    if (!draws(++number, 3)) continue;
    model::Mechanism tree = read_model(path);
    tree.loops.clear();  // accelerations with loops are none of the tree's equations
    const Derived derived = derive(tree);
    Errors worst;
    for (std::uint64_t seed = 0; seed < 3; ++seed)
      worst.widen(errors_of(derived, random_sample(derived.mechanism, seed)));
    EXPECT_LE(worst.residual, kRelative) << path;
    EXPECT_LE(worst.time, kRelative) << path;
    EXPECT_LE(worst.zdot, kRelative) << path;
    EXPECT_LE(worst.outputs_over_condition, kRelative) << path;
  }
}

void expect_derivatives(model::Mechanism (*draw)(std::uint64_t seed), std::uint64_t scenes) {
  Errors worst;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const Derived derived = derive(draw(seed));
    if (derived.equations.zdot.empty()) continue;
    const Errors errors = errors_of(derived, random_sample(derived.mechanism, seed));
    EXPECT_LE(errors.residual, kRelative) << seed;
    EXPECT_LE(errors.time, kRelative) << seed;
    EXPECT_LE(errors.zdot_over_condition, kOverCondition) << seed;
    EXPECT_LE(errors.outputs_over_condition, kOverCondition) << seed;
    worst.widen(errors);
  }
  fmt::print(
      "{} scenes: residual {:.1e}, by time {:.1e}, accelerations {:.1e} ({:.1e} over cond(M)), outputs "
      "{:.1e} over it\n",
      scenes, worst.residual, worst.time, worst.zdot, worst.zdot_over_condition,
      worst.outputs_over_condition);
}

TEST(Derivatives, OfRandomScenesAgreeWithDifferencesInSixtyDigits) {
  expect_derivatives(random_scene, kScenes);
}

TEST(Derivatives, OfLawsAgreeWithDifferencesInSixtyDigits) {
  expect_derivatives(random_scene_with_laws, kScenesWithLaws);
}

TEST(Derivatives, OfMixturesAgreeWithDifferencesInSixtyDigits) {
  expect_derivatives([](std::uint64_t seed) { return random_mixture(3 * seed); }, kScenesWithLaws);
}

TEST(Derivatives, OfCallsOfTheUserAgreeWithDifferencesInSixtyDigits) {
  expect_derivatives(random_scene_with_calls, kScenesWithLaws);
}

TEST(Derivatives, OfAppliedForcesAreThoseOfTheEquationsWithoutWeightAndInertia) {
  const model::Mechanism mechanism = read_model(model_path("flyball_governor.toml"));
  const ir::Module all = derivative_module(mechanism),
                   applied = derivative_module(mechanism, programs::DerivativeTerms::kApplied);
  model::Mechanism weightless = mechanism;
  weightless.gravity = {0.0, 0.0, 0.0};
  const Derived derived = derive(weightless);
  Sample sample = random_sample(mechanism, 1);
  std::fill(sample.z.begin(), sample.z.end(),
            0.0);  // without velocities and accelerations inertia has no derivatives
  std::fill(sample.zdot.begin(), sample.zdot.end(), 0.0);
  const Index n = Index(sample.z.size());
  const Exact exact = exact_derivatives(derived, sample);
  EXPECT_LE(
      relative(array_of(applied, "residual_derivatives", "r_y", n, n, sample), exact.residual.leftCols(n)),
      kRelative);
  EXPECT_LE(relative(array_of(applied, "residual_derivatives", "r_z", n, n, sample),
                     exact.residual.middleCols(n, n)),
            kRelative);
  const auto operations = [](const ir::Module& module) {
    for (const ir::Program& program : module.functions)
      if (program.name == "residual_derivatives") return ir::count_operations(program).arithmetic();
    return std::size_t(0);
  };
  EXPECT_LT(operations(applied), operations(all));
}

std::size_t operations(const char* model, const std::string& function) {
  const ir::Module module = derivative_module(read_model(model_path(model)));
  for (const ir::Program& program : module.functions)
    if (program.name == function) return ir::count_operations(program).arithmetic();
  return 0;
}

TEST(Derivatives, OfForwardDynamicsTakeFewerOperationsThanOtherGeneratorsNeed) {
  EXPECT_EQ(operations("ur5.toml", "forward_dynamics_derivatives"), 1313u);
  EXPECT_EQ(operations("panda.toml", "forward_dynamics_derivatives"), 4456u);
}

}  // namespace
}  // namespace jourdain::tests
