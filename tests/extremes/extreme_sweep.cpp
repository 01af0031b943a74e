#include "extremes/extreme_sweep.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <numbers>

#include "compile/articulation.hpp"
#include "validate/translation.hpp"

namespace jourdain::tests {

namespace {

using ExactMatrix = std::vector<std::vector<support::ScaledReal>>;

support::ScaledReal norm(const ExactMatrix& a) {
  support::ScaledReal sum = 0;
  for (const std::vector<support::ScaledReal>& row : a)
    for (const support::ScaledReal& entry : row) sum = sum + entry * entry;
  return sqrt(sum);
}

/// By Gauss and Jordan without pivoting, which a symmetric positive definite matrix does not need.
ExactMatrix inverse(ExactMatrix a) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    const support::ScaledReal pivot = support::ScaledReal(1) / a[k][k];
    a[k][k] = 1;
    for (support::ScaledReal& entry : a[k]) entry = entry * pivot;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const support::ScaledReal factor = a[i][k];
      a[i][k] = 0;
      for (std::size_t j = 0; j < n; ++j) a[i][j] = a[i][j] - factor * a[k][j];
    }
  }
  return a;
}

double condition(const ExactMatrix& M) { return dynamics::to_double(norm(M) * norm(inverse(M))); }

ExactMatrix scaled_to_unit_diagonal(ExactMatrix M) {
  std::vector<support::ScaledReal> root;
  for (std::size_t i = 0; i < M.size(); ++i) root.push_back(sqrt(M[i][i]));
  for (std::size_t i = 0; i < M.size(); ++i)
    for (std::size_t j = 0; j < M.size(); ++j) M[i][j] = M[i][j] / (root[i] * root[j]);
  return M;
}

ExactMatrix mass_matrix(const Derived& derived, const Judge& judge) {
  ExactMatrix M;
  for (const std::vector<kinematics::Ex>& row : derived.equations.M) {
    M.emplace_back();
    for (const kinematics::Ex& entry : row) M.back().push_back(judge.exact(entry));
  }
  return M;
}

/// Calls `visit(entry of y, entry of z)` for every angle among the coordinates.
template <class Visit>
void visit_angles(const model::Mechanism& mechanism, Visit visit) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto y = layout.joints[j].position[c]; y && mechanism.joints[j].coordinates[c].angular)
        visit(*y, *layout.joints[j].velocity[c]);
}

Conditioning conditioning(const Derived& derived, const Judge& judge) {
  const ExactMatrix M = mass_matrix(derived, judge);
  Conditioning result{condition(M), condition(scaled_to_unit_diagonal(M)), 1};
  double least = INFINITY, most = 0;
  visit_angles(derived.mechanism, [&](std::size_t, std::size_t z) {
    const double moment = dynamics::to_double(M[z][z]);
    least = std::min(least, moment);
    most = std::max(most, moment);
  });
  if (most > 0) result.moments = most / least;
  return result;
}

/// Sum of all angles, or the largest prescribed one, in half turns.
double half_turns(const Derived& derived, const Sample& sample) {
  const reference::Reference<double> reference(derived.mechanism, sample.parameters);
  double sum = 0;
  visit_angles(derived.mechanism, [&](std::size_t y, std::size_t) { sum += std::fabs(sample.y[y]); });
  reference::State<double> state{
      sample.t, reference::VectorX<double>::Zero(Eigen::Index(sample.y.size())), {}};
  return std::max(sum, reference.largest_angle(state)) / std::numbers::pi;
}

double explained(Loss loss, const Derived& derived, const Sample& sample, const Conditioning& conditioning) {
  switch (loss) {
    case Loss::kNone:
      return 1;
    case Loss::kLargeAngle:
      return std::max(1.0, half_turns(derived, sample));
    case Loss::kSmallMoment:
      return conditioning.moments;
  }
  return 1;
}

template <class Real>
Sample rounded(Sample sample) {
  for (std::vector<double>* values : {&sample.parameters, &sample.y, &sample.z, &sample.u})
    for (double& value : *values) value = double(Real(value));
  sample.t = double(Real(sample.t));
  return sample;
}

}  // namespace

template <class Real>
Accuracy accuracy(const Derived& derived, const Sample& given, Loss loss) {
  constexpr double kUnitRoundoff = double(std::numeric_limits<Real>::epsilon()) / 2;
  const Sample sample = rounded<Real>(given);
  const Judge judge(derived, sample);
  Accuracy result;
  result.conditioning = conditioning(derived, judge);
  result.loss = explained(loss, derived, sample, result.conditioning);
  result.regular = std::max(result.conditioning.scaled, result.loss) * kUnitRoundoff < kRegular;
  std::feclearexcept(FE_OVERFLOW | FE_UNDERFLOW);
  const std::vector<Real> values = interpreted<Real>(derived.module, "forward_dynamics", sample);
  result.left_range = std::fetestexcept(FE_OVERFLOW | FE_UNDERFLOW) != 0;
  const std::vector<double> zdot(values.begin(), values.end());
  result.backward = judge.backward_error(zdot) / kUnitRoundoff;
  result.forward = judge.forward_error(zdot) / kUnitRoundoff;
  return result;
}

template Accuracy accuracy<double>(const Derived&, const Sample&, Loss);
template Accuracy accuracy<float>(const Derived&, const Sample&, Loss);

Derived derive_extreme(const model::Mechanism& mechanism) {
  dynamics::DerivationOptions options;
  choose_articulation(mechanism, {}).set(options);
  return derive(mechanism, options);
}

void Sweep::prepare(int exponent) {
  if (!derived_ || family_.in_scene)
    derived_ = derive_extreme(read_scene(family_.description(std::exp2(exponent))));
}

std::vector<Measurement> Sweep::at(int exponent, std::uint64_t seeds) {
  prepare(exponent);
  std::vector<Measurement> list;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Sample sample = random_sample(derived_->mechanism, seed);
    family_.adjust(std::exp2(exponent), sample);
    list.push_back({exponent, seed, accuracy<double>(*derived_, sample, family_.loss),
                    accuracy<float>(*derived_, sample, family_.loss)});
  }
  return list;
}

std::vector<std::string> Sweep::refusals() const {
  return validate::validate_translation(derived_->mechanism, derived_->equations, derived_->module).failures;
}

}  // namespace jourdain::tests
