#include "validate/translation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/direction.hpp"
#include "dynamics/high_precision.hpp"
#include "kinematics/numbers.hpp"
#include "model/coordinates.hpp"
#include "reference/minimal.hpp"
#include "validate/samples.hpp"

namespace jourdain::validate {

using dynamics::Direction;
using dynamics::DirectionalDerivatives;
using dynamics::Equations;
using dynamics::HighPrecision;
using dynamics::to_double;
using ir::LeafKind;

namespace {

using Reference = reference::Reference<long double>;
using Vector = reference::VectorX<long double>;

/// Mass matrices with a larger condition number have no accelerations; loops may give them some.
constexpr long double kSolvable = 1e16L;

/// The comparison at one sample; worst errors and failures go into a verdict.
class Comparison {
 public:
  Comparison(const model::Mechanism& mechanism, const Equations& equations, const Equations* applied,
             const ir::Module& module, const Sample& sample, Verdict& verdict)
      : mechanism_(mechanism),
        equations_(equations),
        load_(applied),
        module_(module),
        sample_(sample),
        verdict_(verdict),
        exact_(equations.statements,
               [&](kinematics::LeafKind kind, std::size_t i) { return leaf_value(kind, i); }),
        parameters_(sample.parameters.begin(), sample.parameters.end()),
        reference_(mechanism, parameters_),
        terms_(reference_.evaluate(state(), to_vector(sample.u))) {
    reference::widen_scales(terms_);
    // An angle of many turns is rounded with its size.
    const long double turns = reference_.largest_angle(state()) / std::numbers::pi_v<long double>;
    terms_.M_scale *= turns;
    terms_.k_scale *= turns;
    terms_.q_scale *= turns;
    if (mechanism.outputs.empty()) return;
    const bool given = equations.outputs_take_leaves;
    const Vector zdot = given ? to_vector(sample.zdot) : reference::forward_dynamics<long double>(terms_);
    const Vector load = terms_.M_scale * zdot.cwiseAbs() + terms_.k_scale + terms_.q_scale;
    Vector scale = zdot.cwiseAbs();
    if (!given) scale += terms_.M.inverse().cwiseAbs() * load;
    outputs_ = reference_.outputs(state(), to_vector(sample.u), zdot, scale);
    for (reference::OutputValue<long double>& output : outputs_)
      for (long double& entry : output.scales) entry *= turns;
  }

  void run() {
    compare_with_reference();
    measure_snapping();
    const std::vector<double> constants = interpret_constants();
    for (const ir::Program& program : module_.functions) compare_program(program, constants);
    verdict_.condition =
        std::max(verdict_.condition, static_cast<double>(reference::condition<long double>(terms_.M)));
  }

 private:
  double leaf_value(kinematics::LeafKind kind, std::size_t i) const {
    switch (kind) {
      case kinematics::LeafKind::kParameter:
        return sample_.parameters[i];
      case kinematics::LeafKind::kPosition:
        return sample_.y[i];
      case kinematics::LeafKind::kVelocity:
        return sample_.z[i];
      case kinematics::LeafKind::kAcceleration:
        return sample_.zdot[i];
      case kinematics::LeafKind::kMultiplier:
        return 0;  // as if the loops were open
      case kinematics::LeafKind::kInput:
        return sample_.u[i];
      case kinematics::LeafKind::kTime:
        return sample_.t;
    }
    return 0;
  }

  reference::State<long double> state() const {
    return {sample_.t, to_vector(sample_.y), to_vector(sample_.z)};
  }

  static Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }
  static Eigen::Index at(int i) { return static_cast<Eigen::Index>(i); }

  /// |value − expected| in units of `scale`. Where both are not numbers they agree; where one is, they do not.
  static double error(double value, double expected, long double scale) {
    if (std::isnan(value) || std::isnan(expected))
      return std::isnan(value) == std::isnan(expected) ? 0 : INFINITY;
    const double difference = std::fabs(value - expected);
    return difference == 0 ? 0 : static_cast<double>(difference / scale);
  }

  void record(double& worst, double measured, double limit, const std::string& what) {
    if (!(measured <= limit))
      verdict_.failures.push_back(fmt::format("{} is off by {:.2g} of its term sum", what, measured));
    if (measured > worst) worst = measured;
  }

  void compare_with_reference() {
    const std::size_t n = equations_.M.size();
    const auto compare = [&](const kinematics::Ex& value, long double expected, long double scale,
                             const std::string& what) {
      record(verdict_.reference_error,
             error(to_double(exact_.value(value)), static_cast<double>(expected), scale), kTolerance,
             what + " of the symbolic equations against the numeric reference");
    };
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        compare(equations_.M[i][j], terms_.M(at(i), at(j)), terms_.M_scale(at(i), at(j)),
                fmt::format("M[{}][{}]", i, j));
      compare(equations_.k_bar[i], terms_.k_bar[at(i)], terms_.k_scale[at(i)], fmt::format("k_bar[{}]", i));
      compare(equations_.q_bar[i], terms_.q_bar[at(i)], terms_.q_scale[at(i)], fmt::format("q_bar[{}]", i));
    }
    const Vector rate = reference_.position_rate(state());
    for (std::size_t i = 0; i < equations_.ydot.size(); ++i)
      compare(equations_.ydot[i], rate[at(i)], rate_scale(), fmt::format("position_rate[{}]", i));
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      std::size_t entry = 0;
      for (const dynamics::OutputValues& member : equations_.outputs[k])
        for (const kinematics::Ex& value : member.values) {
          compare(value, outputs_[k].values[entry], outputs_[k].scales[entry],
                  fmt::format("output {} {}", equations_.output_names[k], member.member));
          ++entry;
        }
    }
    compare(equations_.kinetic_energy, terms_.kinetic_energy, kinetic_scale(), "kinetic_energy");
    compare(equations_.potential_energy, terms_.potential_energy, potential_scale(), "potential_energy");
  }

  long double kinetic_scale() const { return terms_.kinetic_scale; }

  /// Of a rate that is a product of a quaternion and an angular velocity.
  long double rate_scale() const { return state().z.norm(); }

  /// The potential itself and its change over a unit of each coordinate.
  long double potential_scale() const { return terms_.potential_scale + terms_.q_scale.sum(); }

  void measure_snapping() {
    if (!mechanism_.snap || equations_.M.empty()) return;
    if (reference::condition<long double>(terms_.M) > kSolvable) return;
    const auto unsnapped =
        Reference(mechanism_, parameters_, reference::Snap::kOff).evaluate(state(), to_vector(sample_.u));
    const Vector a = reference::forward_dynamics<long double>(terms_),
                 b = reference::forward_dynamics<long double>(unsnapped);
    const long double norm = b.norm();
    const double effect = norm > 0 ? static_cast<double>((a - b).norm() / norm) : 0;
    if (!(effect <= kSnapEffect))
      verdict_.failures.push_back(
          fmt::format("snapping rotations changes the accelerations by {:.2g}; use --no-snap", effect));
    verdict_.snap_effect = std::max(verdict_.snap_effect, effect);
  }

  std::vector<double> interpret_constants() const {
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kParameter] = sample_.parameters;
    return ir::interpret(module_.constants, leaves);
  }

  void compare_program(const ir::Program& program, const std::vector<double>& constants) {
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kConstant] = constants;
    leaves[LeafKind::kPosition] = sample_.y;
    leaves[LeafKind::kVelocity] = sample_.z;
    leaves[LeafKind::kAcceleration] = sample_.zdot;
    leaves[LeafKind::kInput] = sample_.u;
    leaves[LeafKind::kTime] = {sample_.t};
    const std::vector<double> values = ir::interpret(program, leaves);
    if (program.name == "forward_dynamics") return compare_accelerations(values);
    if (program.name == "outputs") return compare_requested(values);
    if (program.name == "forward_dynamics_derivatives" || program.name == "linearize")
      return compare_acceleration_derivatives(program, values);
    if (program.name == "residual_derivatives") return compare_residual_derivatives(program, values);
    for (std::size_t k = 0; k < values.size(); ++k) compare_output(program, program.outputs[k], values[k]);
  }

  /// The outputs that the model asks for, in the order of their entries.
  void compare_requested(const std::vector<double>& values) {
    std::size_t k = 0;
    for (std::size_t o = 0; o < outputs_.size(); ++o) {
      std::size_t entry = 0;
      for (const dynamics::OutputValues& member : equations_.outputs[o])
        for (const kinematics::Ex& expected : member.values) {
          record(verdict_.entry_error,
                 error(values[k++], to_double(exact_.value(expected)), outputs_[o].scales[entry++]),
                 kTolerance,
                 fmt::format("output {} {} of the program", equations_.output_names[o], member.member));
        }
    }
  }

  void compare_output(const ir::Program& program, const ir::Output& output, double value) {
    const auto [expected, scale] = expectation(program.name, output);
    const std::string subscripts = (output.row >= 0 ? fmt::format("[{}]", output.row) : "") +
                                   (output.column >= 0 ? fmt::format("[{}]", output.column) : "");
    record(verdict_.entry_error, error(value, to_double(exact_.value(expected)), scale), kTolerance,
           program.name + subscripts + " of the program against the symbolic equations");
  }

  /// What an output of a program should be, and the sum of its absolute terms.
  std::pair<kinematics::Ex, long double> expectation(const std::string& function,
                                                     const ir::Output& output) const {
    const std::size_t i = static_cast<std::size_t>(std::max(output.row, 0));
    if (function == "mass_matrix")
      return {equations_.M[i][static_cast<std::size_t>(output.column)],
              terms_.M_scale(at(i), at(output.column))};
    if (function == "position_rate") return {equations_.ydot[i], rate_scale()};
    if (function == "k_bar") return {equations_.k_bar[i], terms_.k_scale[at(i)]};
    if (function == "q_bar") return {equations_.q_bar[i], terms_.q_scale[at(i)]};
    if (function == "inverse_dynamics") return {equations_.tau[i], torque_scale()[at(i)]};
    if (function == "residual") return {residual(i), torque_scale()[at(i)]};
    if (function == "kinetic_energy") return {equations_.kinetic_energy, kinetic_scale()};
    if (function == "potential_energy") return {equations_.potential_energy, potential_scale()};
    JD_CHECK(function == "initial_state", "no expectation for '{}'", function);
    const kinematics::Ex& start =
        output.name == "y" ? equations_.initial_position[i] : equations_.initial_velocity[i];
    return {start, std::fabs(to_double(exact_.value(start)))};
  }

  /// M ż − k̄ + q̄ at the sample's accelerations.
  kinematics::Ex residual(std::size_t row) const {
    kinematics::Ex sum = equations_.q_bar[row] - equations_.k_bar[row];
    for (std::size_t j = 0; j < equations_.M.size(); ++j)
      sum = sum + equations_.M[row][j] * kinematics::exact(sample_.zdot[j]);
    return sum;
  }

  DirectionalDerivatives along(const Equations& equations) const {
    const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism_);
    return dynamics::derivatives_along(
        sample_.direction, equations, model::tangent_of(mechanism_, layout),
        [this](kinematics::LeafKind kind, std::size_t i) { return leaf_value(kind, i); });
  }

  /// Component of the direction that a column of an array stands for.
  double component(const std::string& array, int column) const {
    const auto i = static_cast<std::size_t>(std::max(column, 0));
    const Direction& d = sample_.direction;
    const std::size_t n = d.velocity.size();
    if (column < 0) return d.time;
    if (array == "B" || array == "D" || array == "r_u") return d.input[i];
    if (array == "A" || array == "C") return i < n ? d.displacement[i] : d.velocity[i - n];
    return array == "r_y" || array == "zdot_y" ? d.displacement[i] : d.velocity[i];
  }

  /// Entries of Jacobians times the direction, and the sums of absolute terms.
  struct Products {
    Vector sum, scale;
  };

  /// Of rows from `first_row` on of the arrays listed.
  Products products(const ir::Program& program, const std::vector<double>& values,
                    const std::vector<std::string>& arrays, std::size_t first_row, std::size_t rows) const {
    Products result{Vector::Zero(at(rows)), Vector::Zero(at(rows))};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const ir::Output& output = program.outputs[k];
      const long row = output.row - static_cast<long>(first_row);
      if (std::find(arrays.begin(), arrays.end(), output.name) == arrays.end() || row < 0) continue;
      const long double term = static_cast<long double>(values[k]) * component(output.name, output.column);
      result.sum[row] += term;
      result.scale[row] += std::fabs(term);
    }
    return result;
  }

  void compare_residual_derivatives(const ir::Program& program, const std::vector<double>& values) {
    const std::size_t n = equations_.M.size();
    for (std::size_t k = 0; k < values.size(); ++k) {
      const ir::Output& output = program.outputs[k];
      if (output.name != "M") continue;
      const auto [expected, scale] = expectation("mass_matrix", output);
      record(verdict_.entry_error, error(values[k], to_double(exact_.value(expected)), scale), kTolerance,
             "an entry of M of residual_derivatives");
    }
    const Products r = products(program, values, {"r_y", "r_z", "r_u", "r_t"}, 0, n);
    const std::vector<double> expected = load_ ? along(*load_).q_bar : along(equations_).residual;
    for (std::size_t i = 0; i < n; ++i)
      record(verdict_.entry_error,
             error(static_cast<double>(r.sum[at(i)]), expected[i], r.scale[at(i)] + torque_scale()[at(i)]),
             kTolerance, fmt::format("row {} of the derivatives of the residual", i));
  }

  /// M δż against M times the derivative of ż in 60 digits, as a backward error; outputs by their term sums.
  void compare_acceleration_derivatives(const ir::Program& program, const std::vector<double>& values) {
    const std::size_t n = equations_.M.size();
    const DirectionalDerivatives expected = along(equations_);
    const bool linearizes = program.name == "linearize";
    const Products dz =
        products(program, values, {"zdot_y", "zdot_z", "A", "B", "rate_t"}, linearizes ? n : 0, n);
    Vector direction = Vector::Zero(at(n)), exact = Vector::Zero(at(n));
    std::vector<double> zdot;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (program.outputs[k].name == "zdot") zdot.push_back(values[k]);
    if (!zdot.empty()) compare_accelerations(zdot);
    for (std::size_t i = 0; i < n; ++i) exact[at(i)] = expected.zdot[i];
    const Vector acceleration = reference::forward_dynamics<long double>(terms_).cwiseAbs();
    const Vector load = terms_.M_scale * acceleration + terms_.k_scale + terms_.q_scale;
    // forward_dynamics_derivatives has no columns of inputs and time.
    if (!linearizes) exact -= terms_.M.inverse() * input_and_time_part();
    const Vector difference = terms_.M * (dz.sum - exact);
    const Vector scale = terms_.M_scale * (dz.scale + acceleration) + load;
    for (std::size_t i = 0; i < n; ++i)
      record(verdict_.backward_error, error(static_cast<double>(difference[at(i)]), 0, scale[at(i)]),
             kTolerance, fmt::format("row {} of M times the derivatives of zdot", i));
    if (linearizes) compare_output_derivatives(program, values, expected.outputs);
  }

  /// What inputs and time contribute to M δż.
  Vector input_and_time_part() const {
    Direction rest = sample_.direction;
    std::fill(rest.displacement.begin(), rest.displacement.end(), 0.0);
    std::fill(rest.velocity.begin(), rest.velocity.end(), 0.0);
    const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism_);
    return terms_.M *
           to_vector(dynamics::derivatives_along(
                         rest, equations_, model::tangent_of(mechanism_, layout),
                         [this](kinematics::LeafKind kind, std::size_t i) { return leaf_value(kind, i); })
                         .zdot);
  }

  void compare_output_derivatives(const ir::Program& program, const std::vector<double>& values,
                                  const std::vector<double>& expected) {
    std::vector<long double> scales;
    for (const reference::OutputValue<long double>& output : outputs_)
      scales.insert(scales.end(), output.scales.begin(), output.scales.end());
    const Products o = products(program, values, {"C", "D", "output_t"}, 0, expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      record(verdict_.entry_error,
             error(static_cast<double>(o.sum[at(i)]), expected[i],
                   (o.scale[at(i)] + scales[i]) *
                       std::max<long double>(1, reference::condition<long double>(terms_.M))),
             kTolerance, fmt::format("row {} of C and D", i));
  }

  Vector torque_scale() const {
    return terms_.M_scale * to_vector(sample_.zdot).cwiseAbs() + terms_.k_scale + terms_.q_scale;
  }

  /// Backward error of M ż = k̄ − q̄ with M, k̄ and q̄ in 60 digits, row by row.
  void compare_accelerations(const std::vector<double>& zdot) {
    const Vector scale = terms_.M_scale * to_vector(zdot).cwiseAbs() + terms_.k_scale + terms_.q_scale;
    for (std::size_t i = 0; i < zdot.size(); ++i) {
      double residual = NAN;
      if (std::all_of(zdot.begin(), zdot.end(), [](double a) { return std::isfinite(a); })) {
        cln::cl_R sum = exact_.value(equations_.q_bar[i]) - exact_.value(equations_.k_bar[i]);
        for (std::size_t j = 0; j < zdot.size(); ++j)
          sum = sum + exact_.value(equations_.M[i][j]) * exact_.value(kinematics::exact(zdot[j]));
        residual = to_double(sum);
      }
      record(verdict_.backward_error, error(residual, 0, scale[at(i)]), kTolerance,
             fmt::format("row {} of M zdot = k_bar - q_bar with the program's zdot", i));
    }
  }

  const model::Mechanism& mechanism_;
  const Equations& equations_;
  const Equations* load_;
  const ir::Module& module_;
  const Sample& sample_;
  Verdict& verdict_;
  HighPrecision exact_;
  std::vector<long double> parameters_;
  Reference reference_;
  reference::Terms<long double> terms_;
  std::vector<reference::OutputValue<long double>> outputs_;
};

}  // namespace

Verdict validate_translation(const model::Mechanism& mechanism, const Equations& equations,
                             const ir::Module& module, std::size_t states, const Equations* load) {
  Verdict verdict;
  verdict.states = states;
  for (const Sample& sample : draw_samples(mechanism, states))
    Comparison(mechanism, equations, load, module, sample, verdict).run();
  return verdict;
}

}  // namespace jourdain::validate
