#include "loops/plan/sharing_rows.hpp"

#include <algorithm>

#include "loops/rows/regular_rows.hpp"
#include "reference/decompositions.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;
using Rows = std::vector<std::size_t>;

/// What is held as well everywhere to this share needs no other rows.
constexpr long double kSteady = 0.9L;
/// How much better rows that share must do.
constexpr long double kBetter = 1.2L;
/// Of the least singular value that counts the next one may be so much, or numbers that disagree tell what is
/// independent.
constexpr long double kClear = 1e-2L;

Rows without(Rows rows, std::size_t row) {
  std::erase(rows, row);
  return rows;
}

/// det(A Aᵀ)
long double volume(const Matrix& A) { return reference::determinant<long double>(A * A.transpose()); }

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
      const Vector sigma = reference::singular_values<long double>(G(acting_, Eigen::all));
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

}  // namespace jourdain::loops
