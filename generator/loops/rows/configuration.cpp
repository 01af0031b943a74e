#include "loops/rows/configuration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/decompositions.hpp"
#include "support/matrix_index.hpp"
#include "support/uniform.hpp"

namespace jourdain::loops {

using ir::LeafKind;

namespace {

using support::at;

Matrix columns_of(const Matrix& A, const std::vector<bool>& moving) {
  Matrix B = A;
  for (std::size_t k = 0; k < moving.size(); ++k)
    if (!moving[k]) B.col(at(k)).setZero();
  return B;
}

Vector vector_of(const std::vector<long double>& entries) {
  return Eigen::Map<const Vector>(entries.data(), at(entries.size()));
}

}  // namespace

NumericClosure::NumericClosure(const model::Mechanism& mechanism, const ConstraintPrograms& programs,
                               std::vector<double> parameters)
    : programs_(programs),
      parameters_(std::move(parameters)),
      rows_(programs.value.outputs.size()),
      units_(units_of(mechanism, parameters_)),
      row_units_(vector_of(units_.rows)),
      velocity_units_(vector_of(units_.velocities)) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  tangent_ = layout.tangent;
  velocities_ = layout.velocity_count();
  inputs_ = layout.input_count();
  for (const model::StateVariable& state : mechanism.states)
    states_.push_back(state.initial.evaluate<double>(parameters_));
  for (const ir::Output& output : programs.velocities.outputs)
    without_position_.push_back(support::subscript(output.row));
}

Matrix NumericClosure::jacobian(const Configuration& config, RowsOf rows) const {
  Matrix G = jacobian(config);
  if (rows == RowsOf::kPositions)
    for (const std::size_t r : without_position_) G.row(at(r)).setZero();
  return G;
}

ir::LeafValues<long double> NumericClosure::leaves(const Configuration& config, const Vector& z) const {
  ir::LeafValues<long double> values;
  values[LeafKind::kParameter].assign(parameters_.begin(), parameters_.end());
  values[LeafKind::kPosition].assign(config.y.begin(), config.y.end());
  std::vector<long double>& velocities = values[LeafKind::kVelocity];
  velocities.assign(z.begin(), z.end());
  velocities.resize(velocities_);
  if (config.states.size() > 0)
    std::copy(config.states.begin(), config.states.end(), velocities.end() - config.states.size());
  else if (z.size() == 0)
    std::copy(states_.begin(), states_.end(), velocities.end() - static_cast<std::ptrdiff_t>(states_.size()));
  values[LeafKind::kInput].assign(inputs_, 0);
  values[LeafKind::kTime] = {config.t};
  return values;
}

void NumericClosure::disregard(const std::vector<std::size_t>& rows, long double limit) {
  disregarded_ = rows;
  limit_ = limit;
}

bool NumericClosure::closes(const Configuration& config) const {
  constexpr long double kFinest = 1e-3L;
  const Vector g = regarded(value(config));
  for (Eigen::Index r = 0; r < g.size(); ++r)
    if (!(std::abs(g[r]) <= kClosed * std::max(kFinest, row_units_[r]))) return false;
  return true;
}

bool NumericClosure::is_closed(const Configuration& config) const {
  const Vector g = value(config);
  return closes(config) && std::all_of(disregarded_.begin(), disregarded_.end(),
                                       [&](std::size_t r) { return std::abs(g[at(r)]) <= limit_; });
}

Vector NumericClosure::regarded(Vector g) const {
  for (const std::size_t r : disregarded_) g[at(r)] = 0;
  return g;
}

Matrix NumericClosure::regarded(Matrix G) const {
  for (const std::size_t r : disregarded_) G.row(at(r)).setZero();
  return G;
}

Vector NumericClosure::counted(const Vector& g) const {
  return regarded(Vector(g.cwiseQuotient(row_units_)));
}

Vector NumericClosure::closing(const Matrix& G, const Vector& g, const std::vector<bool>& moving) const {
  return velocity_units_.cwiseProduct(least_norm(columns_of(regarded(in_units(G)), moving), -g));
}

Matrix NumericClosure::in_units(const Matrix& G) const {
  return row_units_.cwiseInverse().asDiagonal() * G * velocity_units_.asDiagonal();
}

std::vector<Matrix> NumericClosure::in_units(const std::vector<Matrix>& jacobians) const {
  std::vector<Matrix> list;
  for (const Matrix& G : jacobians) list.push_back(in_units(G));
  return list;
}

long double NumericClosure::extent(const Vector& displacement) const {
  return displacement.cwiseQuotient(velocity_units_).lpNorm<Eigen::Infinity>();
}

Vector NumericClosure::opening_rate(const Configuration& config, const Vector& z) const {
  return regarded(Vector(jacobian(config) * z + time_rate(config)));
}

NumericClosure::Bend NumericClosure::bend(const Configuration& config, const Vector& z,
                                          const std::vector<std::size_t>& rows) const {
  const Vector gamma = bias(config, z).cwiseQuotient(row_units_)(rows);
  const Matrix G = in_units(jacobian(config))(rows, Eigen::all);
  return {gamma - G * least_norm(G, gamma), gamma.size() > 0 ? gamma.lpNorm<Eigen::Infinity>() : 0};
}

Vector NumericClosure::value(const Configuration& config) const {
  const std::vector<long double> g = ir::interpret(programs_.value, leaves(config, {}));
  return Eigen::Map<const Vector>(g.data(), at(g.size()));
}

Matrix NumericClosure::jacobian(const Configuration& config) const {
  const std::vector<long double> values = ir::interpret(programs_.jacobian, leaves(config, {}));
  Matrix G = Matrix::Zero(at(rows_), at(velocities_));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = programs_.jacobian.outputs[k];
    if (output.name == "G") G(at(output.row), at(output.column)) = values[k];
  }
  return G;
}

Vector NumericClosure::time_rate(const Configuration& config) const {
  const std::vector<long double> values = ir::interpret(programs_.jacobian, leaves(config, {}));
  Vector rate = Vector::Zero(at(rows_));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (programs_.jacobian.outputs[k].name == "g_t") rate[at(programs_.jacobian.outputs[k].row)] = values[k];
  return rate;
}

Vector NumericClosure::bias(const Configuration& config, const Vector& z) const {
  const std::vector<long double> values = ir::interpret(programs_.rates, leaves(config, z));
  Vector gamma = Vector::Zero(at(rows_));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (programs_.rates.outputs[k].name == "gamma") gamma[at(programs_.rates.outputs[k].row)] = values[k];
  return gamma;
}

NumericClosure::Miss NumericClosure::missed(const Configuration& config) const {
  const std::vector<long double> values = ir::interpret(programs_.misses, leaves(config, {}));
  Miss worst;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = programs_.misses.outputs[k];
    long double length = output.name == "miss" ? std::sqrt(values[k]) : 0;
    if (output.name != "miss" && !(values[k] > 0)) length = std::numeric_limits<long double>::infinity();
    if (!(length <= worst.length)) worst = {length, support::subscript(output.row)};
  }
  return worst;
}

std::vector<std::size_t> NumericClosure::reversed(const Configuration& config) const {
  const std::vector<long double> values = ir::interpret(programs_.senses, leaves(config, {}));
  std::vector<std::size_t> loops;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto loop = static_cast<std::size_t>(programs_.senses.outputs[k].row);
    if (values[k] < 0 && (loops.empty() || loops.back() != loop)) loops.push_back(loop);
  }
  return loops;
}

long double NumericClosure::distance(const Configuration& from, const Configuration& to) const {
  long double largest = 0;
  for (const model::Tangent::Scalar& s : tangent_.scalars) {
    const long double change = std::abs(to.y[at(s.position)] - from.y[at(s.position)]);
    largest = std::max(largest, change / velocity_units_[at(s.velocity)]);
  }
  for (const model::Tangent::Scalar& s : tangent_.quaternions) {
    const Vector change = to.y.segment<4>(at(s.position)) - from.y.segment<4>(at(s.position));
    largest = std::max(largest, 2 * change.norm());
  }
  return largest;
}

Configuration NumericClosure::displaced(const Configuration& from, const Vector& d) const {
  Configuration moved = from;
  for (const model::Tangent::Scalar& s : tangent_.scalars) moved.y[at(s.position)] += d[at(s.velocity)];
  for (const model::Tangent::Scalar& s : tangent_.quaternions) {
    const Eigen::Quaternion<long double> q(from.y[at(s.position)], from.y[at(s.position + 1)],
                                           from.y[at(s.position + 2)], from.y[at(s.position + 3)]);
    const Eigen::Vector3<long double> turn = d.segment<3>(at(s.velocity));
    const long double angle = turn.norm();
    Eigen::Vector3<long double> axis = Eigen::Vector3<long double>::UnitX();
    if (angle > 0) axis = turn / angle;
    const Eigen::Quaternion<long double> by(Eigen::AngleAxis<long double>(angle, axis));
    const Eigen::Quaternion<long double> product = (q * by).normalized();
    moved.y.segment<4>(at(s.position)) << product.w(), product.x(), product.y(), product.z();
  }
  return moved;
}

Configuration NumericClosure::assembled(Configuration config, const std::vector<bool>& moving) const {
  constexpr int kSteps = 200;
  constexpr long double kLongest = 0.3L;  // of one step, in units: further the linearisation says little
  Vector g = counted(value(config));
  for (int i = 0; i < kSteps && !(g.lpNorm<Eigen::Infinity>() <= kClosed / 1e5L); ++i) {
    Vector step = closing(jacobian(config, RowsOf::kPositions), g, moving);
    if (!step.allFinite()) break;
    if (const long double length = extent(step); length > kLongest) step *= kLongest / length;
    Configuration best = displaced(config, step);
    Vector better = counted(value(best));
    for (int halvings = 0; halvings < 20 && !(better.norm() < g.norm()); ++halvings) {
      step /= 2;
      best = displaced(config, step);
      better = counted(value(best));
    }
    if (!(better.norm() < g.norm())) break;
    config = best;
    g = better;
  }
  return config;
}

Vector NumericClosure::consistent(const Configuration& config, const Vector& z,
                                  const std::vector<bool>& moving, RowsOf rows) const {
  Vector rate = opening_rate(config, z);
  if (rows == RowsOf::kPositions)
    for (const std::size_t r : without_position_) rate[at(r)] = 0;
  return z + closing(jacobian(config, rows), rate.cwiseQuotient(row_units_), moving);
}

Vector least_norm(const Matrix& A, const Vector& b) {
  if (A.size() == 0) return Vector::Zero(A.cols());
  return reference::least_norm<long double>(A, b, kRankTolerance);
}

bool in_range(const Configuration& config, const model::Mechanism& mechanism,
              const model::CoordinateLayout& layout) {
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c) {
      const auto& range = mechanism.joints[j].coordinates[c].range;
      const auto entry = layout.joints[j].position[c];
      if (range && entry && (config.y[at(*entry)] < (*range)[0] || config.y[at(*entry)] > (*range)[1]))
        return false;
    }
  return true;
}

namespace {

/// Where nothing but time moves a mechanism without freedom: a way of about 0.7 units at its speed at first, in steps
/// after which little is left to close, so that it ends on the branch on which it begins; nothing where no way leads.
std::optional<Configuration> driven(const NumericClosure& closure, const Configuration& from,
                                    long double time) {
  constexpr long double kFar = 0.7L, kNear = 0.1L;
  constexpr int kSteps = 200;
  const auto speed = [&](const Configuration& at) {
    return closure.consistent(at, Vector::Zero(support::at(closure.velocity_count())), {});
  };
  const long double fastest = closure.extent(speed(from));
  if (fastest * time > kFar) time = kFar / fastest;
  Configuration now = from;
  long double step = time;
  for (int i = 0; i < kSteps; ++i) {
    const long double left = from.t + time - now.t;
    if (!(left > kRankTolerance * time)) break;
    step = std::min(step, left);
    Configuration ahead = closure.displaced(now, speed(now) * step);
    ahead.t += step;
    const Configuration next = closure.assembled(ahead, {});
    const bool is_near = closure.is_closed(next) && closure.distance(ahead, next) <= kNear;
    if (is_near) now = next;
    step *= is_near ? 2.0L : 0.5L;
  }
  if (time > 0 && !(now.t > from.t)) return {};
  return now;
}

}  // namespace

std::vector<Configuration> walk(const NumericClosure& closure, const Configuration& start,
                                const model::Mechanism& mechanism, std::size_t count) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  support::Uniform uniform(6007);
  std::vector<Configuration> found = {start};
  for (std::size_t tries = 0; tries < 10 * count && found.size() < count; ++tries) {
    const Configuration& from = found[tries % found.size()];
    Vector direction(at(closure.velocity_count()));
    for (std::size_t k = 0; k < closure.velocity_count(); ++k)
      direction[at(k)] = closure.units().velocities[k] * uniform(-1, 1);
    direction = closure.consistent(from, direction, {}, RowsOf::kPositions) -
                closure.consistent(from, Vector::Zero(direction.size()), {}, RowsOf::kPositions);
    const long double length = closure.extent(direction);
    if (!(length > 0)) continue;
    const long double stride = uniform(0.1, 0.7), time = uniform(0, 1);
    Configuration next = closure.displaced(from, direction * (stride / length));
    next.t = start.t + time;
    if (length < kRankTolerance) {
      const std::optional<Configuration> later = driven(closure, from, time);
      if (!later) continue;
      next = *later;
    }
    next = closure.assembled(next, {});
    if (closure.is_closed(next) && in_range(next, mechanism, layout)) found.push_back(next);
  }
  return found;
}

}  // namespace jourdain::loops
