#include "loops/sharing_rows.hpp"

#include <algorithm>

#include "loops/regular_rows.hpp"

namespace jourdain::loops {

namespace {

using Rows = std::vector<std::size_t>;

/// What is held as well everywhere to this share needs no other rows.
constexpr long double kSteady = 0.9L;
/// How much better rows that share must do.
constexpr long double kBetter = 1.2L;
/// Of the least singular value that counts the next one may be so much, or numbers that disagree tell what is independent.
constexpr long double kClear = 1e-2L;

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

Rows without(Rows rows, std::size_t row) {
  std::erase(rows, row);
  return rows;
}

/// det(A Aᵀ)
long double volume(const Matrix& A) { return A.rows() == 0 ? 1 : (A * A.transpose()).determinant(); }

/// How much of what all rows hold some of them hold, at configurations where that is as much as anywhere.
class Shares {
 public:
  Shares(const std::vector<Matrix>& jacobians, std::size_t rank) {
    Vector largest = Vector::Zero(jacobians.front().rows());
    for (const Matrix& G : jacobians) largest = largest.cwiseMax(G.rowwise().norm());
    for (std::size_t r = 0; r < static_cast<std::size_t>(largest.size()); ++r)
      if (largest[at(r)] > kRowTolerance * largest.maxCoeff()) acting_.push_back(r);
    for (Matrix G : jacobians) {
      for (const std::size_t r : acting_) G.row(at(r)) /= largest[at(r)];
      const Vector sigma = Eigen::JacobiSVD<Matrix>(G(acting_, Eigen::all)).singularValues();
      if (at(rank) > sigma.size() || !(sigma[at(rank) - 1] > kRowTolerance * sigma[0])) continue;
      if (at(rank) < sigma.size() && !(kClear * sigma[at(rank) - 1] > sigma[at(rank)])) continue;
      jacobians_.push_back(G);
      whole_.push_back(sigma.head(at(rank)).array().square().prod());
    }
  }

  /// Rows that are not zero everywhere.
  const Rows& acting() const { return acting_; }

  /// The least share over the largest: of `sure` rows with each of `sharing`, together.
  long double steadiness(const Rows& sure, const Rows& sharing) const {
    long double least = 1, most = 0;
    for (std::size_t k = 0; k < jacobians_.size(); ++k) {
      long double share = 0;
      for (const std::size_t r : sharing) {
        Rows rows = sure;
        rows.push_back(r);
        share += volume(jacobians_[k](rows, Eigen::all)) / whole_[k];
      }
      least = std::min(least, share);
      most = std::max(most, share);
    }
    return most > 0 ? least / most : 0;
  }

 private:
  Rows acting_;
  std::vector<Matrix> jacobians_;   ///< rows divided by their largest norms
  std::vector<long double> whole_;  ///< squares of the singular values, multiplied
};

}  // namespace

std::vector<std::size_t> sharing_rows(const std::vector<Matrix>& jacobians, const Rows& rows) {
  if (rows.empty() || rows.size() == static_cast<std::size_t>(jacobians.front().rows())) return {};
  const Shares shares(jacobians, rows.size());
  Rows others, best;
  for (const std::size_t r : shares.acting())
    if (std::find(rows.begin(), rows.end(), r) == rows.end()) others.push_back(r);
  const long double alone = shares.steadiness(without(rows, rows.back()), {rows.back()});
  if (others.empty() || alone >= kSteady) return {};
  long double most = kBetter * alone;
  const auto consider = [&](std::size_t row, Rows sharing) {
    sharing.push_back(row);
    const long double found = shares.steadiness(without(rows, row), sharing);
    if (!(found > most)) return;
    most = found;
    best = sharing;
  };
  for (const std::size_t row : rows) {
    for (const std::size_t other : others) consider(row, {other});
    if (others.size() > 1) consider(row, others);
  }
  std::sort(best.begin(), best.end());
  return best;
}

SchurSolution::SchurSolution(const LoopPlan& plan, const Matrix& S, double size) {
  const Rows rows = plan.solved_rows();
  Vector weights(at(plan.sharing.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool shares = std::find(plan.sharing.begin(), plan.sharing.end(), rows[k]) != plan.sharing.end();
    if (shares) weights[at(sharing_.size())] = plan.row_length[rows[k]] * plan.row_length[rows[k]];
    (shares ? sharing_ : sure_).push_back(at(k));
  }
  Matrix A = S(sure_, sure_);
  for (std::size_t k = 0; k < sure_.size(); ++k) {
    const double length = plan.row_length[rows[static_cast<std::size_t>(sure_[k])]];
    A(at(k), at(k)) += (sharing_.empty() ? 1 : kBesideSharing) * size / (length * length);
  }
  factors_ = A.ldlt();
  determinant_ = A.determinant();
  const Vector sigma = Eigen::JacobiSVD<Matrix>(A).singularValues();
  if (sigma.size() > 0) condition_ = sigma[0] / sigma[sigma.size() - 1];
  if (sharing_.empty()) return;
  coupling_ = S(sharing_, sure_);
  Matrix R = S(sharing_, sharing_);
  if (!sure_.empty()) R -= coupling_ * factors_.solve(coupling_.transpose());
  const long double trace = weights.dot(R.diagonal());
  kept_ = R * weights.asDiagonal() / trace;
  inverse_ = weights.asDiagonal() * R * weights.asDiagonal();
  inverse_ /= trace * (trace + size) + static_cast<long double>(size) * size;
  determinant_ *= trace + size;
  condition_ *= std::max(1.0L, weights.dot(S.diagonal()(sharing_)) / (trace + size));
}

Vector SchurSolution::solved(const Vector& c) const {
  Vector x(c.size()), first = c(sure_);
  if (!sure_.empty()) first = factors_.solve(first);
  if (!sharing_.empty()) {
    Vector rest = c(sharing_);
    if (!sure_.empty()) rest -= coupling_ * first;
    const Vector last = inverse_ * rest;
    x(sharing_) = last;
    if (!sure_.empty()) first -= factors_.solve(coupling_.transpose() * last);
  }
  x(sure_) = first;
  return x;
}

Vector SchurSolution::kept(Vector c) const {
  if (!sharing_.empty()) c(sharing_) = kept_ * Vector(c(sharing_));
  return c;
}

long double SchurSolution::determinant() const { return determinant_; }

long double SchurSolution::condition() const { return condition_; }

}  // namespace jourdain::loops
