#include "studies/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "studies/cvode.hpp"
#include "studies/spectra.hpp"
#include "studies/tangent_space.hpp"

namespace jourdain::studies {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigen::Map<const VectorXd> as_vector(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

Point<double> displaced(const Point<double>& point, const VectorXd& direction) {
  Point<double> result = point;
  for (std::size_t i = 0; i < result.x.size(); ++i) result.x[i] += direction[Eigen::Index(i)];
  return result;
}

/// The Jacobian with the separation that serves a single central difference best.
MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point) {
  return jacobian(flow, point, std::cbrt(2 * flow.table().unit_roundoff));
}

/// Rates of the state and of X at one stage.
struct Stage {
  VectorXd f;
  MatrixXd F;
};

constexpr double kResolved = 0.5;  ///< largest substep times the Jacobian's norm
constexpr int kMostSubsteps = 64;

/// The variational equation and the motion, by the classical Runge-Kutta method.
MatrixXd resolved_transition(const Flow<double>& flow, const Point<double>& start, double interval,
                             int substeps) {
  const auto n = static_cast<Eigen::Index>(flow.size());
  Point<double> point = start;
  MatrixXd X = MatrixXd::Identity(n, n);
  const double h = interval / substeps;
  const auto stage = [&](double share, const Stage& before) {
    Point<double> at = displaced(point, share * h * before.f);
    at.t = point.t + share * h;
    const std::vector<double> f = flow.rates(at.t, at.x);
    return Stage{as_vector(f), jacobian(flow, at) * (X + share * h * before.F)};
  };
  for (int i = 0; i < substeps; ++i) {
    const Stage none{VectorXd::Zero(n), MatrixXd::Zero(n, n)};
    const Stage k1 = stage(0, none), k2 = stage(0.5, k1), k3 = stage(0.5, k2), k4 = stage(1, k3);
    X += h / 6 * (k1.F + 2 * (k2.F + k3.F) + k4.F);
    point = displaced(point, h / 6 * (k1.f + 2 * (k2.f + k3.f) + k4.f));
    point.t += h;
  }
  return X;
}

/// Exponentials of the Jacobians midway of substeps, between the two points as a straight line goes.
MatrixXd stiff_transition(const Flow<double>& flow, const Point<double>& start, const Point<double>& end) {
  constexpr int kSubsteps = 8;
  const auto n = static_cast<Eigen::Index>(flow.size());
  MatrixXd X = MatrixXd::Identity(n, n);
  const VectorXd way = as_vector(end.x) - as_vector(start.x);
  const double interval = end.t - start.t;
  for (int i = 0; i < kSubsteps; ++i) {
    const double share = (i + 0.5) / kSubsteps;
    Point<double> middle = displaced(start, share * way);
    middle.t = start.t + share * interval;
    X = exponential(interval / kSubsteps * jacobian(flow, middle)) * X;
  }
  return X;
}

/// Transition matrix between two points of a motion.
MatrixXd transition(const Flow<double>& flow, const Point<double>& start, const Point<double>& end) {
  const double norm = std::max(jacobian(flow, start).norm(), jacobian(flow, end).norm());
  const double substeps = std::ceil((end.t - start.t) * norm / kResolved);
  if (!(substeps <= kMostSubsteps)) return stiff_transition(flow, start, end);
  return resolved_transition(flow, start, end.t - start.t, std::max(1, static_cast<int>(substeps)));
}

}  // namespace

MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point, double separation) {
  std::vector<double> changes;
  for (const double entry : point.x) changes.push_back(separation * (1 + std::fabs(entry)));
  return jacobian(flow, point, changes);
}

MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point, const std::vector<double>& changes) {
  const auto n = static_cast<Eigen::Index>(flow.size());
  MatrixXd result(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double entry = point.x[std::size_t(i)], delta = changes[std::size_t(i)];
    std::vector<double> above = point.x, below = point.x;
    above[std::size_t(i)] = entry + delta;
    below[std::size_t(i)] = entry - delta;
    const std::vector<double> high = flow.rates(point.t, above), low = flow.rates(point.t, below);
    result.col(i) = (as_vector(high) - as_vector(low)) / (above[std::size_t(i)] - below[std::size_t(i)]);
  }
  return result;
}

Divergence measure_divergence(const Flow<double>& flow, const std::vector<Point<double>>& reference,
                              double interval, double rate) {
  constexpr int kDirections = 4;
  const double tolerance = 1e3 * flow.table().unit_roundoff, length = std::sqrt(tolerance);
  const auto n = static_cast<Eigen::Index>(flow.size()),
             positions = static_cast<Eigen::Index>(flow.position_count());
  VectorXd weights = VectorXd::Ones(n);
  weights.tail(n - positions).setConstant(rate);
  std::mt19937_64 random(20261121);
  const auto uniform = [&random] { return 2 * std::ldexp(static_cast<double>(random()), -64) - 1; };
  const auto size = [&](const VectorXd& separation) { return separation.cwiseQuotient(weights).norm(); };
  std::vector<VectorXd> separations;
  std::vector<double> logarithms(kDirections, 0.0);
  for (int d = 0; d < kDirections; ++d)
    separations.push_back(VectorXd::NullaryExpr(n, uniform).cwiseProduct(weights));
  Divergence result{interval, {1.0}, 0};
  const auto stride = static_cast<std::size_t>(std::lround(interval / (reference[1].t - reference[0].t)));
  for (std::size_t k = stride; k < reference.size(); k += stride) {
    double growth = 0;
    const auto base = solved_by_cvode(flow, reference[k - stride], interval, 1, tolerance);
    if (!base) return result;
    for (std::size_t d = 0; d < separations.size(); ++d) {
      const double scale = 1 + as_vector(reference[k - stride].x).lpNorm<Eigen::Infinity>();
      const VectorXd wanted = separations[d] * (scale * length / size(separations[d]));
      const Point<double> near = flow.closed(displaced(reference[k - stride], wanted));
      const double before = size(as_vector(near.x) - as_vector(reference[k - stride].x));
      const auto end = solved_by_cvode(flow, near, interval, 1, tolerance);
      if (!end) return result;
      separations[d] = as_vector(end->back().x) - as_vector(base->back().x);
      const double after = size(separations[d]);
      if (!std::isfinite(after) || after == 0) return result;
      growth = std::max(growth, logarithms[d] + std::log(separations[d].head(positions).norm() / before));
      logarithms[d] += std::log(after / before);
    }
    constexpr double kMostShown = 600;
    result.growth.push_back(std::exp(std::min(growth, kMostShown)));
    result.exponent = growth / (reference[k].t - reference.front().t);
  }
  return result;
}

std::vector<MatrixXd> transition_matrices(const Flow<double>& flow,
                                          const std::vector<Point<double>>& points) {
  std::vector<MatrixXd> result;
  for (std::size_t k = 1; k < points.size(); ++k)
    result.push_back(correction_jacobian(flow, points[k]) * transition(flow, points[k - 1], points[k]));
  return result;
}

}  // namespace jourdain::studies
