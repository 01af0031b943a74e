#include "studies/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "studies/tangent_space.hpp"

namespace jourdain::studies {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Initial separation, over 1 + |x|: rounding is small beside it, the square too.
double separation_of(const Flow<double>& flow) { return 6 * std::sqrt(flow.table().unit_roundoff); }

constexpr int kDirections = 4;

Eigen::Map<const VectorXd> as_vector(const std::vector<double>& x) {
  return {x.data(), static_cast<Eigen::Index>(x.size())};
}

VectorXd scale_of(const std::vector<double>& x) { return as_vector(x).cwiseAbs().array() + 1; }

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

/// Transition matrix from `start` over `interval`.
MatrixXd transition(const Flow<double>& flow, const Point<double>& start, double interval) {
  constexpr double kResolved = 0.5;  // largest substep times the Jacobian's norm
  constexpr int kMostSubsteps = 64;
  const auto n = static_cast<Eigen::Index>(flow.size());
  Point<double> point = start;
  MatrixXd X = MatrixXd::Identity(n, n);
  const double norm = std::sqrt(jacobian(flow, start).squaredNorm());
  const int substeps =
      static_cast<int>(std::clamp(std::ceil(interval * norm / kResolved), 1.0, 1.0 * kMostSubsteps));
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

}  // namespace

MatrixXd jacobian(const Flow<double>& flow, const Point<double>& point, double separation) {
  const auto n = static_cast<Eigen::Index>(flow.size());
  MatrixXd result(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double entry = point.x[std::size_t(i)], delta = separation * (1 + std::fabs(entry));
    std::vector<double> above = point.x, below = point.x;
    above[std::size_t(i)] = entry + delta;
    below[std::size_t(i)] = entry - delta;
    const std::vector<double> high = flow.rates(point.t, above), low = flow.rates(point.t, below);
    result.col(i) = (as_vector(high) - as_vector(low)) / (above[std::size_t(i)] - below[std::size_t(i)]);
  }
  return result;
}

Divergence measure_divergence(const Flow<double>& flow, const jourdain_method& method, double h,
                              double interval, long count) {
  std::mt19937_64 random(20261121);
  const auto uniform = [&random] { return 2 * std::ldexp(static_cast<double>(random()), -64) - 1; };
  Point<double> base = flow.start();
  const auto length = [&] { return separation_of(flow) * scale_of(base.x).maxCoeff(); };
  std::vector<VectorXd> separations;
  std::vector<double> logarithms(kDirections, 0.0);
  for (int d = 0; d < kDirections; ++d) {
    VectorXd direction = VectorXd::NullaryExpr(static_cast<Eigen::Index>(flow.size()), uniform);
    direction = direction.cwiseProduct(scale_of(base.x));
    separations.push_back(length() * direction / direction.norm());
  }
  Divergence result{interval, {1.0}, 0};
  const long steps = std::lround(interval / h);
  for (long k = 0; k < count; ++k) {
    std::vector<Point<double>> near;
    for (VectorXd& separation : separations) {
      near.push_back(flow.closed(displaced(base, separation)));
      if (flow.has_loops()) separation = as_vector(near.back().x) - as_vector(base.x);
    }
    Memory memory = flow.fresh_memory(method);
    flow.step(method, base, h, steps, memory);
    double growth = 0;
    for (std::size_t d = 0; d < near.size(); ++d) {
      memory = flow.fresh_memory(method);
      flow.step(method, near[d], h, steps, memory);
      const VectorXd separation = as_vector(near[d].x) - as_vector(base.x);
      const double norm = separation.norm();
      if (!std::isfinite(norm) || norm == 0) return result;
      logarithms[d] += std::log(norm / separations[d].norm());
      separations[d] = length() * separation / norm;
      growth = std::max(growth, std::exp(std::min(logarithms[d], 600.0)));
    }
    result.growth.push_back(growth);
    result.exponent = std::log(growth) / (static_cast<double>(k + 1) * interval);
  }
  return result;
}

long intervals_until(const Divergence& divergence, double factor) {
  const auto found = std::find_if(divergence.growth.begin(), divergence.growth.end(),
                                  [factor](double growth) { return growth > factor; });
  return std::max(0L, static_cast<long>(found - divergence.growth.begin()) - 1);
}

std::vector<MatrixXd> transition_matrices(const Flow<double>& flow,
                                          const std::vector<Point<double>>& points) {
  std::vector<MatrixXd> result;
  for (std::size_t k = 1; k < points.size(); ++k)
    result.push_back(correction_jacobian(flow, points[k]) *
                     transition(flow, points[k - 1], points[k].t - points[k - 1].t));
  return result;
}

}  // namespace jourdain::studies
