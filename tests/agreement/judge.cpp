#include "agreement/judge.hpp"

#include <cmath>

#include "agreement/leaf_value.hpp"
#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "kinematics/numbers.hpp"
#include "programs/functions.hpp"
#include "programs/tree_functions.hpp"
#include "properties/random.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::tests {

using ir::LeafKind;
using reference::VectorX;

namespace {

VectorX<long double> to_vector(const std::vector<double>& values) {
  VectorX<long double> v(Eigen::Index(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[Eigen::Index(i)] = values[i];
  return v;
}

double relative(double value, double exact, long double scale) {
  const double difference = std::fabs(value - exact);
  return difference == 0 ? 0 : double(difference / scale);
}

reference::Terms<long double> reference_terms(const Derived& derived, const Sample& sample) {
  const std::vector<long double> parameters(sample.parameters.begin(), sample.parameters.end());
  const reference::Reference<long double> reference(derived.mechanism, parameters);
  auto terms = reference.evaluate({.t = sample.t, .y = to_vector(sample.y), .z = to_vector(sample.z)},
                                  to_vector(sample.u));
  reference::widen_scales(terms);
  return terms;
}

}  // namespace

Sample random_sample(const model::Mechanism& mechanism, std::uint64_t seed, bool single) {
  Random random(seed + 77);
  const auto rounded = [single](double v) { return single ? double(float(v)) : v; };
  const reference::State<double> state = random_state(mechanism, seed);
  const VectorX<double> u = random_inputs(mechanism, seed);
  Sample sample;
  for (const model::Parameter& parameter : mechanism.parameters)
    sample.parameters.push_back(rounded(parameter.value * random.uniform(0.9, 1.1)));
  sample.t = rounded(state.t);
  for (Eigen::Index i = 0; i < state.y.size(); ++i) sample.y.push_back(rounded(state.y[i]));
  for (Eigen::Index i = 0; i < state.z.size(); ++i) {
    sample.z.push_back(rounded(state.z[i]));
    sample.zdot.push_back(rounded(random.uniform(-5, 5)));
  }
  for (Eigen::Index i = 0; i < u.size(); ++i) sample.u.push_back(rounded(u[i]));
  sample.h = rounded(random.uniform(0, 0.1));
  return sample;
}

template <class Real>
std::vector<Real> interpreted(const ir::Module& module, const std::string& name, const Sample& sample) {
  const auto cast = [](const std::vector<double>& values) {
    return std::vector<Real>(values.begin(), values.end());
  };
  ir::LeafValues<Real> leaves;
  leaves[LeafKind::kParameter] = cast(sample.parameters);
  leaves[LeafKind::kConstant] = ir::interpret(module.constants, leaves);
  leaves[LeafKind::kPosition] = cast(sample.y);
  leaves[LeafKind::kVelocity] = cast(sample.z);
  leaves[LeafKind::kAcceleration] = cast(sample.zdot);
  leaves[LeafKind::kInput] = cast(sample.u);
  leaves[LeafKind::kTime] = {static_cast<Real>(sample.t)};
  leaves[LeafKind::kStepLength] = {static_cast<Real>(sample.h)};
  for (const ir::Program& program : module.functions)
    if (program.name == name) return ir::interpret(program, leaves);
  JD_CHECK(false, "no function '{}'", name);
  return {};
}

template std::vector<double> interpreted(const ir::Module&, const std::string&, const Sample&);
template std::vector<float> interpreted(const ir::Module&, const std::string&, const Sample&);

Derived derive(model::Mechanism mechanism, const dynamics::DerivationOptions& options) {
  Derived derived{std::move(mechanism), {}, {}};
  derived.equations = dynamics::derive_equations(derived.mechanism, options);
  const auto functions =
      programs::with_needed(programs::default_functions(), programs::scene_facts(derived.mechanism));
  derived.module = passes::optimise(programs::lower_functions(derived.equations, functions)).module;
  return derived;
}

Judge::Judge(const Derived& derived, const Sample& sample)
    : equations_(derived.equations),
      exact_(derived.equations.statements,
             [&sample](kinematics::LeafKind kind, std::size_t i) { return leaf_value(sample, kind, i); }),
      terms_(reference_terms(derived, sample)),
      torque_scale_(terms_.M_scale * to_vector(sample.zdot).cwiseAbs() + terms_.k_scale + terms_.q_scale),
      condition_(double(reference::condition<long double>(terms_.M))) {}

std::vector<double> Judge::values(const std::vector<kinematics::Ex>& expressions) const {
  std::vector<double> list;
  for (const kinematics::Ex& e : expressions) list.push_back(dynamics::to_double(exact_.value(e)));
  return list;
}

double Judge::backward_error(const std::vector<double>& zdot) const {
  const VectorX<long double> scale =
      terms_.M_scale * to_vector(zdot).cwiseAbs() + terms_.k_scale + terms_.q_scale;
  double worst = 0;
  for (std::size_t i = 0; i < zdot.size(); ++i) {
    if (!std::isfinite(zdot[i])) return zdot[i];
    support::ScaledReal residual = exact_.value(equations_.q_bar[i]) - exact_.value(equations_.k_bar[i]);
    for (std::size_t j = 0; j < zdot.size(); ++j)
      residual = residual + exact_.value(equations_.M[i][j]) * exact_.value(kinematics::exact(zdot[j]));
    worst = larger_error(worst, relative(dynamics::to_double(residual), 0, scale[Eigen::Index(i)]));
  }
  return worst;
}

double Judge::forward_error(const std::vector<double>& zdot) const {
  const std::vector<double> exact = values(equations_.zdot);
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < zdot.size(); ++i) {
    difference = std::hypot(difference, zdot[i] - exact[i]);
    norm = std::hypot(norm, exact[i]);
  }
  // Where the exact accelerations vanish, all terms cancelled: what they could have caused is the measure.
  if (norm == 0) norm = double((terms_.k_scale + terms_.q_scale).norm() * condition_ / terms_.M.norm());
  return difference == 0 ? 0 : difference / norm;
}

double Judge::mass_matrix_error(const std::vector<double>& M) const {
  double worst = 0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < equations_.M.size(); ++i)
    for (std::size_t j = i; j < equations_.M.size(); ++j)
      worst = larger_error(worst, relative(M[k++], dynamics::to_double(exact_.value(equations_.M[i][j])),
                                           terms_.M_scale(Eigen::Index(i), Eigen::Index(j))));
  return worst;
}

namespace {

double vector_error(const std::vector<double>& actual, const std::vector<double>& exact,
                    const VectorX<long double>& scale) {
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    worst = larger_error(worst, relative(actual[i], exact[i], scale[Eigen::Index(i)]));
  return worst;
}

}  // namespace

double Judge::k_bar_error(const std::vector<double>& k) const {
  return vector_error(k, values(equations_.k_bar), terms_.k_scale);
}

double Judge::q_bar_error(const std::vector<double>& q) const {
  return vector_error(q, values(equations_.q_bar), terms_.q_scale);
}

double Judge::torque_error(const std::vector<double>& tau) const {
  return vector_error(tau, values(equations_.tau), torque_scale_);
}

}  // namespace jourdain::tests
