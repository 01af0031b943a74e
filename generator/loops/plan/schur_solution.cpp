#include "loops/plan/schur_solution.hpp"

#include <algorithm>

#include "loops/plan/sharing_rows.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;

}  // namespace

SchurSolution::SchurSolution(const LoopPlan& plan, const std::vector<std::size_t>& rows, const ExactMatrix& S,
                             double size)
    : delta_(at(rows.size())) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool shares = std::find(plan.sharing.begin(), plan.sharing.end(), rows[k]) != plan.sharing.end();
    const double part = plan.sharing.empty() || shares ? 1 : kBesideSharing;
    delta_[at(k)] = part * size / (plan.row_length[rows[k]] * plan.row_length[rows[k]]);
    (shares ? sharing_ : sure_).push_back(at(k));
  }
  regular_ = S(sure_, sure_);
  for (std::size_t k = 0; k < sure_.size(); ++k) regular_(at(k), at(k)) += delta_[sure_[k]];
  determinant_ = reference::determinant(regular_);
  if (!sharing_.empty()) share(plan, rows, S, size);
}

/// R⁺ = W R W / (t² + t δ + δ²) with t = tr(W R), R what is left of S over the rows that share.
void SchurSolution::share(const LoopPlan& plan, const std::vector<std::size_t>& rows, const ExactMatrix& S,
                          double size) {
  ExactVector weights(at(sharing_.size()));
  for (std::size_t k = 0; k < sharing_.size(); ++k) {
    const double length = plan.row_length[rows[static_cast<std::size_t>(sharing_[k])]];
    weights[at(k)] = length * length;
  }
  coupling_ = S(sharing_, sure_);
  ExactMatrix R = S(sharing_, sharing_);
  if (!sure_.empty()) R -= coupling_ * reference::solved(regular_, coupling_.transpose());
  const ScaledReal trace = weights.dot(R.diagonal()), delta = size;
  inverse_ = weights.asDiagonal() * R * weights.asDiagonal();
  inverse_ /= trace * (trace + delta) + delta * delta;
  determinant_ *= trace + delta;
}

ExactVector SchurSolution::solved(const ExactVector& c) const {
  ExactVector x(c.size()), first = c(sure_);
  if (!sure_.empty()) first = reference::solved(regular_, first);
  if (!sharing_.empty()) {
    ExactVector rest = c(sharing_);
    if (!sure_.empty()) rest -= coupling_ * first;
    const ExactVector last = inverse_ * rest;
    x(sharing_) = last;
    if (!sure_.empty()) first -= ExactVector(reference::solved(regular_, coupling_.transpose() * last));
  }
  x(sure_) = first;
  return x;
}

ExactVector SchurSolution::corrected(const ExactVector& c, int corrections) const {
  ExactVector x = solved(c), last = x;
  for (int i = 0; i < corrections; ++i) {
    last = solved(delta_.cwiseProduct(last));
    x += last;
  }
  return x;
}

}  // namespace jourdain::loops
