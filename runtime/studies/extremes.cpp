#include "studies/extremes.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/angular_entries.hpp"
#include "model/coordinates.hpp"
#include "studies/linearisation.hpp"
#include "studies/loaded_model.hpp"
#include "studies/sensitivity.hpp"
#include "studies/tangent_space.hpp"

namespace jourdain::studies {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kStates = 5;  ///< of the trajectory
constexpr int kDecades = 6;         ///< of a factor, up and down
constexpr int kAngleDecades = 9;

double norm(const std::vector<LongReal>& v) {
  double sum = 0;
  for (const LongReal& entry : v) sum = std::hypot(sum, static_cast<double>(entry));
  return sum;
}

std::vector<LongReal> difference(const std::vector<LongReal>& a, const std::vector<LongReal>& b) {
  std::vector<LongReal> result;
  for (std::size_t i = 0; i < a.size(); ++i) result.push_back(a[i] - b[i]);
  return result;
}

class Comparison {
 public:
  Comparison(const model::Tangent& tangent, const Flow<double>& flow, const Flow<LongReal>& long_flow)
      : flow_(flow), long_flow_(long_flow), tangent_(tangent) {}

  /// Takes the errors at a state into `point`.
  void widen(ExtremePoint& point, double t, std::vector<double> x) const {
    if (flow_.table().unit_roundoff > 1e-10)
      for (double& entry : x) entry = static_cast<double>(static_cast<float>(entry));
    const auto first = static_cast<std::ptrdiff_t>(flow_.position_count());
    const std::vector<double> working = flow_.rates(t, x);
    point.finite = point.finite &&
                   std::all_of(working.begin(), working.end(), [](double r) { return std::isfinite(r); });
    if (!point.finite) return;
    const std::vector<LongReal> exact_x(x.begin(), x.end()), zdot(working.begin() + first, working.end());
    const std::vector<LongReal> rates = long_flow_.rates(LongReal(t), exact_x),
                                exact(rates.begin() + first, rates.end());
    const double unit = flow_.table().unit_roundoff;
    if (norm(exact) > 0) take(point.forward, norm(difference(zdot, exact)) / norm(exact) / unit);
    if (keeps_all_coordinates(flow_, tangent_)) {
      point.backward = NAN;
      return;
    }
    const Residual residual(long_flow_, t, exact_x);
    const VectorXd row_errors = as_vector(difference(residual.at(zdot), residual.at(exact))).cwiseAbs();
    const VectorXd scale = row_scales(residual.mass_matrix(), as_vector(exact), t, x);
    // Rows that are zero by symmetry hold what rounding leaves of it in all digits: nothing to compare with.
    constexpr double kNothing = 1e-30;  // of the largest row
    const double least = scale.size() > 0 ? kNothing * scale.maxCoeff() : 0;
    for (Eigen::Index i = 0; i < scale.size(); ++i)
      if (scale[i] > least) take(point.backward, row_errors[i] / scale[i] / unit);
  }

 private:
  /// M ż − k̄ + q̄ at zero inputs.
  class Residual {
   public:
    Residual(const Flow<LongReal>& flow, double t, const std::vector<LongReal>& x)
        : table_(flow.table()),
          t_(t),
          y_(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(flow.position_count())),
          z_(x.begin() + static_cast<std::ptrdiff_t>(flow.position_count()), x.end()) {}

    std::vector<LongReal> at(const std::vector<LongReal>& zdot) const {
      return inverse_dynamics(table_, t_, y_, z_, zdot);
    }

    MatrixXd mass_matrix() const {
      std::vector<LongReal> zdot(z_.size(), LongReal(0.0));
      const std::vector<LongReal> rest = at(zdot);
      const auto n = static_cast<Eigen::Index>(z_.size());
      MatrixXd M(n, n);
      for (std::size_t j = 0; j < z_.size(); ++j) {
        zdot[j] = LongReal(1.0);
        M.col(static_cast<Eigen::Index>(j)) = as_vector(difference(at(zdot), rest));
        zdot[j] = LongReal(0.0);
      }
      return M;
    }

   private:
    const jourdain_model_table& table_;
    LongReal t_;
    std::vector<LongReal> y_, z_;
  };

  static VectorXd as_vector(const std::vector<LongReal>& v) {
    VectorXd result(static_cast<Eigen::Index>(v.size()));
    for (std::size_t i = 0; i < v.size(); ++i)
      result[static_cast<Eigen::Index>(i)] = static_cast<double>(v[i]);
    return result;
  }

  /// Σ_j |M_ij| |ż_j| + Σ_k |∂r_i/∂x_k| |x_k|: what rounding the accelerations and the state once would change
  /// in a row; the time too.
  VectorXd row_scales(const MatrixXd& M, const VectorXd& zdot, double t, const std::vector<double>& x) const {
    const auto n = static_cast<Eigen::Index>(flow_.table().velocity_count);
    if (flow_.has_loops()) return M.cwiseAbs() * zdot.cwiseAbs() + by_entries(M, t, x);
    const MatrixXd A = linearisation(flow_, {t, x}, tangent_);
    VectorXd sizes = VectorXd::Zero(2 * n);
    for (const model::Tangent::Scalar& s : tangent_.scalars)
      sizes[static_cast<Eigen::Index>(s.velocity)] = std::fabs(x[s.position]);
    for (const model::Tangent::Scalar& s : tangent_.quaternions)
      sizes.segment<3>(static_cast<Eigen::Index>(s.velocity)).setOnes();
    for (Eigen::Index i = 0; i < n; ++i)
      sizes[n + i] = std::fabs(x[flow_.position_count() + static_cast<std::size_t>(i)]);
    return M.cwiseAbs() * zdot.cwiseAbs() + (M * A.bottomRows(n)).cwiseAbs() * sizes +
           (M * by_time(t, x)).cwiseAbs();
  }

  /// The same where positions depend on each other, by differences: through the loops each has the rounding of
  /// the largest.
  VectorXd by_entries(const MatrixXd& M, double t, const std::vector<double>& x) const {
    const auto ny = static_cast<Eigen::Index>(flow_.position_count());
    const MatrixXd J = jacobian(flow_, {t, x}, std::cbrt(2 * flow_.table().unit_roundoff));
    VectorXd sizes = Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())).cwiseAbs();
    sizes.head(ny).setConstant(sizes.head(ny).maxCoeff());
    return (M * J.bottomRows(M.rows())).cwiseAbs() * sizes + (M * by_time(t, x)).cwiseAbs();
  }

  /// t ∂ż/∂t by a difference.
  VectorXd by_time(double t, const std::vector<double>& x) const {
    constexpr double kShare = 1e-8;
    const std::vector<double> later = flow_.rates(t * (1 + kShare), x),
                              earlier = flow_.rates(t * (1 - kShare), x);
    const auto n = static_cast<Eigen::Index>(flow_.table().velocity_count);
    const auto tail = [n](const std::vector<double>& rates) {
      return Eigen::Map<const VectorXd>(rates.data() + rates.size() - static_cast<std::size_t>(n), n);
    };
    return (tail(later) - tail(earlier)) / (2 * kShare);
  }

  static void take(double& worst, double value) { worst = std::max(worst, value); }

  const Flow<double>& flow_;
  const Flow<LongReal>& long_flow_;
  const model::Tangent& tangent_;
};

/// Closes the loops at the parameters that the table has now; false where that cannot be done.
bool close(const Flow<double>& flow, double t, std::vector<double>& x) {
  constexpr double kOpen = 1e7;  // units of rounding
  const Point<double> point = flow.closed({t, x});
  x = point.x;
  return flow.residuals_of_closed_rows(point).position <= kOpen * flow.table().unit_roundoff;
}

}  // namespace

std::vector<ExtremeSweep> study_extremes(const model::Mechanism& mechanism, const model::Tangent& tangent,
                                         const std::vector<double>& parameters, const Flow<double>& flow,
                                         const Flow<LongReal>& long_flow, const ReferenceSolution& reference,
                                         const Progress& progress) {
  if (!flow.table().derivatives) return {};
  const Comparison comparison(tangent, flow, long_flow);
  std::vector<Point<double>> states;
  const std::size_t count = reference.points.size();
  for (std::size_t k = 0; k < kStates; ++k)
    states.push_back(reference.points[k * (count - 1) / (kStates - 1)]);
  std::vector<ExtremeSweep> sweeps;
  const auto sweep = [&](const std::string& quantity, int from, int to,
                         const std::function<void(double, std::vector<double>&)>& change) {
    progress("extremes", 0);
    ExtremeSweep result{quantity, {}};
    for (int decade = from; decade <= to; ++decade) {
      ExtremePoint& point = result.points.emplace_back();
      point.factor = std::pow(10.0, decade);
      for (const Point<double>& state : states) {
        std::vector<double> x = state.x;
        change(point.factor, x);
        point.closes = point.closes && (!flow.has_loops() || close(flow, state.t, x));
        if (!point.closes) break;
        comparison.widen(point, state.t, std::move(x));
      }
    }
    sweeps.push_back(std::move(result));
  };
  sweep("all velocities", -kDecades, kDecades, [&](double factor, std::vector<double>& x) {
    for (std::size_t i = flow.position_count(); i < x.size(); ++i) x[i] *= factor;
  });
  const std::vector<bool> angular = model::angular_positions(mechanism);
  if (!flow.has_loops() && std::find(angular.begin(), angular.end(), true) != angular.end())
    sweep("all angles", 0, kAngleDecades, [&](double added, std::vector<double>& x) {
      for (std::size_t i = 0; i < angular.size(); ++i)
        if (angular[i]) x[i] += added;
    });
  for (std::size_t p = 0; p < parameters.size(); ++p)
    sweep(mechanism.parameters[p].name, -kDecades, kDecades, [&](double factor, std::vector<double>&) {
      std::vector<double> values = parameters;
      values[p] *= factor;
      if (flow.table().unit_roundoff > 1e-10) values[p] = static_cast<double>(static_cast<float>(values[p]));
      for (const jourdain_model_table* table : {&flow.table(), &long_flow.table()})
        set_parameters(*table, values);
    });
  for (const jourdain_model_table* table : {&flow.table(), &long_flow.table()})
    set_parameters(*table, parameters);
  return sweeps;
}

}  // namespace jourdain::studies
