#include "validate/samples.hpp"

#include <cmath>
#include <cstdint>

#include "model/angular_entries.hpp"
#include "model/coordinates.hpp"
#include "support/uniform.hpp"

namespace jourdain::validate {

using Reference = reference::Reference<long double>;
using support::Uniform;

namespace {

constexpr std::uint64_t kSeed = 20061;

/// Steps towards the initial state where a random state has no values.
constexpr int kTries = 40;

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

void draw_direction(std::size_t displacements, Uniform& uniform, Sample& sample) {
  for (std::size_t i = 0; i < sample.z.size(); ++i) {
    if (i < displacements) sample.direction.displacement.push_back(uniform(-1, 1));
    sample.direction.velocity.push_back(uniform(-1, 1));
  }
  for (std::size_t i = 0; i < sample.u.size(); ++i) sample.direction.input.push_back(uniform(-1, 1));
  sample.direction.time = uniform(-1, 1);
}

}  // namespace

Point point_at(const model::Mechanism& mechanism, const Sample& sample) {
  using ir::LeafKind;
  Point point;
  const auto take = [&](LeafKind kind, const std::vector<double>& values) {
    point.rounded[kind] = values;
    point.exact[kind].assign(values.begin(), values.end());
  };
  take(LeafKind::kParameter, sample.parameters);
  take(LeafKind::kPosition, sample.y);
  take(LeafKind::kVelocity, sample.z);
  take(LeafKind::kAcceleration, sample.zdot);
  take(LeafKind::kInput, sample.u);
  take(LeafKind::kTime, {sample.t});
  take(LeafKind::kStepLength, {sample.h});
  std::vector<ScaledReal>& y = point.exact[LeafKind::kPosition];
  for (const std::size_t q : model::lay_out_coordinates(mechanism).quaternions) {
    ScaledReal square;
    for (std::size_t k = q; k < q + 4; ++k) square += y[k] * y[k];
    const ScaledReal length = sqrt(square);
    for (std::size_t k = q; k < q + 4; ++k) y[k] /= length;
  }
  point.direction = dynamics::exact(sample.direction);
  return point;
}

reference::VectorX<long double> to_vector(const std::vector<double>& values) {
  reference::VectorX<long double> v(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[static_cast<Eigen::Index>(i)] = values[i];
  return v;
}

namespace {

/// A state drawn about its initial value.
double drawn(const model::StateVariable& state, double share, const Sample& sample) {
  return state.initial.evaluate<double>(sample.parameters) +
         share * state.nominal.evaluate<double>(sample.parameters);
}

/// A step that is about as long as a state is large: whether one that counts down is due is as likely as not.
double step_length(const model::Mechanism& mechanism, const Sample& sample, Uniform& uniform) {
  const std::size_t first = sample.z.size() - mechanism.states.size();
  const auto any = static_cast<std::size_t>(uniform(0, static_cast<double>(mechanism.states.size())));
  return std::fabs(sample.z[first + any]) * uniform(0.1, 8);
}

/// Positions, velocities and inputs of these sizes, states about their initial values; angles go round once. Parameters
/// within a tenth of their values, or as they are.
Sample drawn(const model::Mechanism& mechanism, bool is_varied, double length, double speed, double input,
             Uniform& uniform, Uniform& directions) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const std::vector<bool> angular = model::angular_positions(mechanism);
  Sample sample;
  sample.t = is_varied ? uniform(0, 2) : 0.0;
  for (const model::Parameter& parameter : mechanism.parameters) {
    const double value = parameter.value * (is_varied ? uniform(0.9, 1.1) : 1.0);
    sample.parameters.push_back(std::isfinite(value) ? value : parameter.value);
  }
  for (std::size_t i = 0; i < layout.position_count(); ++i)
    sample.y.push_back(uniform(-1, 1) * (angular[i] ? 3.14 : length));
  for (std::size_t i = 0; i < layout.velocity_count(); ++i) {
    const double share = speed * uniform(-2, 2);
    sample.z.push_back(
        i < layout.first_state() ? share : drawn(mechanism.states[i - layout.first_state()], share, sample));
    sample.zdot.push_back(uniform(-5, 5));
  }
  for (std::size_t i = 0; i < layout.input_count(); ++i) sample.u.push_back(input * uniform(-5, 5));
  for (const std::size_t q : layout.quaternions) normalise(&sample.y[q]);
  if (has_samples(mechanism)) sample.h = step_length(mechanism, sample, directions);
  draw_direction(layout.first_state(), directions, sample);
  return sample;
}

}  // namespace

std::vector<Sample> draw_samples(const model::Mechanism& mechanism, std::size_t count) {
  Uniform uniform(kSeed), directions(kSeed);
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < count; ++k) {
    Sample sample = drawn(mechanism, k > 0, 1.0, 1.0, 1.0, uniform, directions);
    if (k == 0) start(mechanism, sample);
    for (int i = 0; k > 0 && i < kTries && !is_defined(mechanism, sample); ++i)
      move_to_start(mechanism, sample);
    samples.push_back(sample);
  }
  return samples;
}

FarSamples::FarSamples(const model::Mechanism& mechanism) : mechanism_(mechanism), uniform_(kSeed + 1) {}

std::optional<Sample> FarSamples::draw() {
  const auto size = [this] { return std::pow(10.0, std::floor(uniform_(-3, 3))); };
  const double length = size(), speed = size(), input = size();
  Uniform directions = uniform_;
  Sample sample = drawn(mechanism_, true, length, speed, input, uniform_, directions);
  if (is_defined(mechanism_, sample)) return sample;
  return {};
}

}  // namespace jourdain::validate
