#include "studies/flow.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "support/check.hpp"

namespace jourdain::studies {

namespace {

void append(double number, std::vector<double>& parts) { parts.push_back(number); }
void append(const LongReal& number, std::vector<double>& parts) {
  parts.resize(parts.size() + kParts<LongReal>);
  number.split(parts.data() + parts.size() - kParts<LongReal>, kParts<LongReal>);
}

template <class Real>
std::vector<double> to_parts(std::span<const Real> numbers) {
  std::vector<double> parts;
  parts.reserve(numbers.size() * kParts<Real>);
  for (const Real& number : numbers) append(number, parts);
  return parts;
}

template <class Real>
std::vector<Real> from_parts(std::span<const double> parts) {
  std::vector<Real> numbers;
  numbers.reserve(parts.size() / kParts<Real>);
  for (std::size_t i = 0; i < parts.size(); i += kParts<Real>) numbers.push_back(number_at<Real>(&parts[i]));
  return numbers;
}

/// jourdain_inputs::at; `context` is the Inputs.
template <class Real>
void sample(void* context, const double* t, const double*, const double*, double* u) {
  const auto& inputs = *static_cast<const Inputs*>(context);
  const std::vector<Real> values = inputs.at(number_at<Real>(t));
  const std::vector<double> parts = to_parts<Real>(values);
  std::copy(parts.begin(), parts.end(), u);
}

}  // namespace

Memory fresh_memory(const jourdain_model_table& table, const jourdain_method& method) {
  const int rates = method.history * (table.position_count + table.velocity_count),
            accelerations = method.implicit * table.velocity_count;
  return Memory(static_cast<std::size_t>(1 + (rates + accelerations) * table.parts));
}

template <class Real>
Flow<Real>::Flow(const jourdain_model_table& table, const Inputs& inputs) : table_(table), inputs_(inputs) {
  JD_CHECK(table.parts == kParts<Real>, "the table has {} parts per number", table.parts);
  JD_CHECK(inputs.at(0.0).size() == static_cast<std::size_t>(table.input_count), "{} values for {} inputs",
           inputs.at(0.0).size(), table.input_count);
}

template <class Real>
Point<Real> Flow<Real>::start() const {
  Point<Real> point{Real(0.0), std::vector<Real>(start_.begin(), start_.end())};
  if (start_.empty()) {
    std::vector<double> parts(size() * kParts<Real>);
    table_.initial_state(parts.data(), parts.data() + position_count() * kParts<Real>);
    point.x = from_parts<Real>(parts);
  }
  Memory memory = fresh_memory(table_.methods[0]);
  Point<Real> stepped = point;
  step(table_.methods[0], stepped, 0, 1, memory);
  // Velocities, states and memories are not a step's: that samples those of period 0.
  std::copy_n(stepped.x.begin(), position_count(), point.x.begin());
  return closed(std::move(point));
}

template <class Real>
std::vector<Real> Flow<Real>::rates(const Real& t, const std::vector<Real>& x) const {
  const std::vector<double> time = to_parts<Real>(std::span(&t, 1)), state = to_parts<Real>(x),
                            u = to_parts<Real>(inputs_.at(t));
  std::vector<double> f(state.size());
  const std::size_t velocities = position_count() * kParts<Real>;
  table_.rates(time.data(), state.data(), state.data() + velocities, u.data(), f.data(),
               f.data() + velocities);
  return from_parts<Real>(f);
}

template <class Real>
Memory Flow<Real>::fresh_memory(const jourdain_method& method) const {
  return studies::fresh_memory(table_, method);
}

template <class Real>
Memory Flow<Real>::memory_of(const jourdain_method& method, const std::vector<Point<Real>>& earlier) const {
  JD_CHECK(earlier.size() == static_cast<std::size_t>(method.history), "{} points for {}", earlier.size(),
           method.history);
  if (method.history == 0) return fresh_memory(method);
  Memory memory = {static_cast<double>(method.history)};
  std::vector<std::vector<Real>> rates_at;
  for (const Point<Real>& point : earlier) rates_at.push_back(rates(point.t, point.x));
  for (const auto& f : rates_at)
    for (std::size_t i = 0; i < position_count(); ++i) append(f[i], memory);
  for (const auto& f : rates_at)
    for (std::size_t i = position_count(); i < size(); ++i) append(f[i], memory);
  return memory;
}

template <class Real>
void Flow<Real>::step(const jourdain_method& method, Point<Real>& point, double h, long count,
                      Memory& memory) const {
  std::vector<double> time = to_parts<Real>(std::span(&point.t, 1)), state = to_parts<Real>(point.x);
  const Real length(h);
  const std::vector<double> h_parts = to_parts<Real>(std::span(&length, 1));
  double* const z = state.data() + position_count() * kParts<Real>;
  if (held_) {
    for (long i = 0; i < count; ++i) {
      const std::vector<double> u = to_parts<Real>(inputs_.at(number_at<Real>(time.data())));
      const jourdain_inputs inputs{u.data(), nullptr, nullptr};
      method.steps(time.data(), state.data(), z, &inputs, h_parts.data(), 1, memory.data());
    }
  } else {
    const jourdain_inputs inputs{nullptr, sample<Real>, const_cast<Inputs*>(&inputs_)};
    method.steps(time.data(), state.data(), z, &inputs, h_parts.data(), count, memory.data());
  }
  point = {number_at<Real>(time.data()), from_parts<Real>(state)};
}

template <class Real>
double Flow<Real>::energy(const Point<Real>& point) const {
  const std::vector<double> time = to_parts<Real>(std::span(&point.t, 1)), state = to_parts<Real>(point.x);
  std::vector<double> kinetic(kParts<Real>), potential(kParts<Real>);
  const double* z = state.data() + position_count() * kParts<Real>;
  table_.kinetic_energy(time.data(), state.data(), z, kinetic.data());
  table_.potential_energy(time.data(), state.data(), z, potential.data());
  return static_cast<double>(number_at<Real>(kinetic.data()) + number_at<Real>(potential.data()));
}

template <class Real>
double Flow<Real>::kinetic_energy(const Point<Real>& point) const {
  const std::vector<double> time = to_parts<Real>(std::span(&point.t, 1)), state = to_parts<Real>(point.x);
  std::vector<double> kinetic(kParts<Real>);
  table_.kinetic_energy(time.data(), state.data(), state.data() + position_count() * kParts<Real>,
                        kinetic.data());
  return static_cast<double>(number_at<Real>(kinetic.data()));
}

template <class Real>
Point<Real> Flow<Real>::corrected(const Point<Real>& point) const {
  if (!has_loops()) return point;
  const std::vector<double> time = to_parts<Real>(std::span(&point.t, 1));
  std::vector<double> state = to_parts<Real>(point.x);
  table_.correct(time.data(), state.data(), state.data() + position_count() * kParts<Real>);
  return {point.t, from_parts<Real>(state)};
}

template <class Real>
Point<Real> Flow<Real>::closed(Point<Real> point) const {
  constexpr int kMostCorrections = 60;
  constexpr double kRoundings = 8;
  bool changes = has_loops();
  for (int i = 0; changes && i < kMostCorrections; ++i) {
    Point<Real> next = corrected(point);
    changes = false;
    for (std::size_t k = 0; k < next.x.size(); ++k) {
      const double change = std::fabs(static_cast<double>(next.x[k] - point.x[k]));
      const double size = 1 + std::fabs(static_cast<double>(next.x[k]));
      changes = changes || change > kRoundings * table_.unit_roundoff * size;
    }
    point = std::move(next);
  }
  return point;
}

template <class Real>
jourdain_closing Flow<Real>::last_closing() const {
  jourdain_closing closing;
  table_.closing(&closing);
  return closing;
}

template <class Real>
bool Flow<Real>::is_trusted() const {
  if (!has_loops()) return true;
  const jourdain_closing closing = last_closing();
  return closing.regularity >= table_.least_regularity && !(closing.beyond > 0);
}

template <class Real>
Residuals Flow<Real>::residuals(const Point<Real>& point) const {
  return residuals_but(point, {});
}

template <class Real>
Residuals Flow<Real>::residuals_of_closed_rows(const Point<Real>& point) const {
  return residuals_but(point, left_open_);
}

template <class Real>
Residuals Flow<Real>::residuals_but(const Point<Real>& point, const std::vector<std::size_t>& rows) const {
  if (!has_loops()) return {};
  const std::vector<double> time = to_parts<Real>(std::span(&point.t, 1)), state = to_parts<Real>(point.x);
  std::vector<double> g(static_cast<std::size_t>(table_.constraint_count) * kParts<Real>), rate = g;
  table_.constraint_residual(time.data(), state.data(), state.data() + position_count() * kParts<Real>,
                             g.data(), rate.data());
  const auto largest = [&rows](const std::vector<double>& parts) {
    double result = 0;
    std::vector<Real> entries = from_parts<Real>(parts);
    for (const std::size_t row : rows) entries[row] = Real(0.0);
    for (const Real& entry : entries) {
      const double size = std::fabs(static_cast<double>(entry));
      if (!(size <= result)) result = std::isnan(size) ? INFINITY : size;
    }
    return result;
  };
  return {largest(g), largest(rate)};
}

template <class Real>
std::vector<Real> inverse_dynamics(const jourdain_model_table& table, const Real& t,
                                   const std::vector<Real>& y, const std::vector<Real>& z,
                                   const std::vector<Real>& zdot) {
  const std::vector<double> time = to_parts<Real>(std::span(&t, 1)), position = to_parts<Real>(y),
                            velocity = to_parts<Real>(z), acceleration = to_parts<Real>(zdot);
  std::vector<double> forces(acceleration.size());
  table.inverse_dynamics(time.data(), position.data(), velocity.data(), acceleration.data(), forces.data());
  return from_parts<Real>(forces);
}

template std::vector<double> inverse_dynamics(const jourdain_model_table&, const double&,
                                              const std::vector<double>&, const std::vector<double>&,
                                              const std::vector<double>&);
template std::vector<LongReal> inverse_dynamics(const jourdain_model_table&, const LongReal&,
                                                const std::vector<LongReal>&, const std::vector<LongReal>&,
                                                const std::vector<LongReal>&);
template class Flow<double>;
template class Flow<LongReal>;

}  // namespace jourdain::studies
