#include "validate/translation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dynamics/high_precision.hpp"
#include "kinematics/numbers.hpp"
#include "model/coordinates.hpp"
#include "reference/minimal.hpp"

namespace jourdain::validate {

using dynamics::Equations;
using dynamics::HighPrecision;
using dynamics::to_double;
using ir::LeafKind;

namespace {

using Reference = reference::Reference<long double>;
using Vector = reference::VectorX<long double>;

/// One point of comparison.
struct Sample {
  double t = 0;
  std::vector<double> parameters, y, z, u, zdot;
};

/// Uniform numbers that are the same on every platform (std::uniform_real_distribution is not).
class Uniform {
 public:
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_{20061};
};

/// Steps towards the initial state where a random state has no values.
constexpr int kTries = 40;

/// For each entry of y whether it is an angle.
std::vector<bool> angular_positions(const model::Mechanism& mechanism,
                                    const model::CoordinateLayout& layout) {
  std::vector<bool> angular(layout.position_count(), false);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].position[c])
        angular[*entry] = mechanism.joints[j].coordinates[c].angular;
  return angular;
}

void normalise(double* quaternion) {
  double square = 0;
  for (int i = 0; i < 4; ++i) square += quaternion[i] * quaternion[i];
  for (int i = 0; i < 4; ++i) quaternion[i] /= std::sqrt(square);
}

/// The state that the model starts from, at the default values of the parameters.
void start(const model::Mechanism& mechanism, Sample& sample) {
  const reference::State<long double> state = Reference(mechanism).initial_state();
  for (std::size_t i = 0; i < sample.y.size(); ++i)
    sample.y[i] = static_cast<double>(state.y[static_cast<Eigen::Index>(i)]);
  for (std::size_t i = 0; i < sample.z.size(); ++i)
    sample.z[i] = static_cast<double>(state.z[static_cast<Eigen::Index>(i)]);
}

Vector to_vector(const std::vector<double>& values) {
  Vector v(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[static_cast<Eigen::Index>(i)] = values[i];
  return v;
}

/// Whether all that the equations consist of has a value there: a root of a negative number has none.
bool is_defined(const model::Mechanism& mechanism, const Sample& sample) {
  const Reference reference(mechanism,
                            std::vector<long double>(sample.parameters.begin(), sample.parameters.end()));
  const auto terms =
      reference.evaluate({sample.t, to_vector(sample.y), to_vector(sample.z)}, to_vector(sample.u));
  return std::isfinite(terms.kinetic_energy + terms.potential_energy) && terms.k_bar.allFinite() &&
         terms.q_bar.allFinite();
}

/// Half the way towards the initial state.
void move_to_start(const model::Mechanism& mechanism, Sample& sample) {
  Sample initial = sample;
  start(mechanism, initial);
  sample.t /= 2;
  for (std::size_t i = 0; i < sample.y.size(); ++i) sample.y[i] = (sample.y[i] + initial.y[i]) / 2;
  for (std::size_t i = 0; i < sample.z.size(); ++i) sample.z[i] = (sample.z[i] + initial.z[i]) / 2;
  for (const std::size_t q : model::lay_out_coordinates(mechanism).quaternions) normalise(&sample.y[q]);
}

std::vector<Sample> draw_samples(const model::Mechanism& mechanism, std::size_t count) {
  Uniform uniform;
  std::vector<Sample> samples;
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const std::vector<bool> angular = angular_positions(mechanism, layout);
  for (std::size_t k = 0; k < count; ++k) {
    Sample sample;
    sample.t = k == 0 ? 0.0 : uniform(0, 2);
    for (const model::Parameter& parameter : mechanism.parameters)
      sample.parameters.push_back(parameter.value * (k == 0 ? 1.0 : uniform(0.9, 1.1)));
    for (std::size_t i = 0; i < layout.position_count(); ++i)
      sample.y.push_back(uniform(-1, 1) * (angular[i] ? 3.14 : 1.0));
    for (std::size_t i = 0; i < layout.velocity_count(); ++i) {
      sample.z.push_back(uniform(-2, 2));
      sample.zdot.push_back(uniform(-5, 5));
    }
    for (std::size_t i = 0; i < layout.input_count(); ++i) sample.u.push_back(uniform(-5, 5));
    for (const std::size_t q : layout.quaternions) normalise(&sample.y[q]);
    if (k == 0) start(mechanism, sample);
    for (int i = 0; k > 0 && i < kTries && !is_defined(mechanism, sample); ++i)
      move_to_start(mechanism, sample);
    samples.push_back(sample);
  }
  return samples;
}

/// The comparison at one sample; worst errors and failures go into a verdict.
class Comparison {
 public:
  Comparison(const model::Mechanism& mechanism, const Equations& equations, const ir::Module& module,
             const Sample& sample, Verdict& verdict)
      : mechanism_(mechanism),
        equations_(equations),
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
    const Vector zdot = reference::forward_dynamics<long double>(terms_);
    const Vector load = terms_.M_scale * zdot.cwiseAbs() + terms_.k_scale + terms_.q_scale;
    const Vector scale = zdot.cwiseAbs() + terms_.M.inverse().cwiseAbs() * load;
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
    const std::size_t n = equations_.zdot.size();
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
    if (!mechanism_.snap || equations_.zdot.empty()) return;
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
    if (function == "kinetic_energy") return {equations_.kinetic_energy, kinetic_scale()};
    if (function == "potential_energy") return {equations_.potential_energy, potential_scale()};
    JD_CHECK(function == "initial_state", "no expectation for '{}'", function);
    const kinematics::Ex& start =
        output.name == "y" ? equations_.initial_position[i] : equations_.initial_velocity[i];
    return {start, std::fabs(to_double(exact_.value(start)))};
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
                             const ir::Module& module, std::size_t states) {
  Verdict verdict;
  verdict.states = states;
  for (const Sample& sample : draw_samples(mechanism, states))
    Comparison(mechanism, equations, module, sample, verdict).run();
  return verdict;
}

}  // namespace jourdain::validate
