#include "loops/rows/regular_rows.hpp"

#include <algorithm>
#include <limits>

#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;

/// An earlier row may be this much worse.
constexpr long double kPreference = 0.3L;

/// The rows of one Jacobian, and directions of those that were taken.
class Rows {
 public:
  explicit Rows(const Matrix& G) : G_(G), largest_(G.rows() == 0 ? 0 : G.rowwise().norm().maxCoeff()) {}

  /// What row r adds to those taken, over the largest row.
  long double rest(std::size_t r) const { return largest_ > 0 ? direction(r).norm() / largest_ : 0; }
  void take(std::size_t r) {
    const Vector d = direction(r);
    if (d.norm() > 0) basis_.push_back(d.normalized());
  }

  /// How many are independent.
  std::size_t rank(long double tolerance) const {
    Rows rows(G_);
    std::size_t count = 0;
    for (; count < static_cast<std::size_t>(G_.rows()); ++count) {
      std::size_t best = 0;
      for (std::size_t r = 0; r < static_cast<std::size_t>(G_.rows()); ++r)
        if (rows.rest(r) > rows.rest(best)) best = r;
      if (!(rows.rest(best) > tolerance)) break;
      rows.take(best);
    }
    return count;
  }

 private:
  Vector direction(std::size_t r) const {
    Vector rest = G_.row(at(r));
    for (int pass = 0; pass < 2; ++pass)  // the second makes good what cancels in the first
      for (const Vector& direction : basis_) rest -= direction.dot(rest) * direction;
    return rest;
  }

  Matrix G_;
  long double largest_ = 0;
  std::vector<Vector> basis_;  ///< orthonormal
};

/// What the row adds where it adds least. Where every row adds nothing somewhere, what it adds elsewhere tells.
long double merit(const std::vector<Rows>& configurations, std::size_t row) {
  constexpr long double kElsewhere = 1e-6L;
  long double least = std::numeric_limits<long double>::infinity(), most = 0;
  for (const Rows& rows : configurations) {
    const long double rest = rows.rest(row);
    least = std::min(least, rest);
    most = std::max(most, rest);
  }
  return least + kElsewhere * most;
}

std::size_t next_row(const std::vector<Rows>& configurations, std::size_t count) {
  std::vector<long double> merits;
  for (std::size_t r = 0; r < count; ++r) merits.push_back(merit(configurations, r));
  const long double best = *std::max_element(merits.begin(), merits.end());
  return static_cast<std::size_t>(
      std::find_if(merits.begin(), merits.end(), [&](long double m) { return m >= kPreference * best; }) -
      merits.begin());
}

}  // namespace

std::vector<std::size_t> regular_rows(const std::vector<Matrix>& jacobians, long double tolerance,
                                      const std::vector<std::size_t>& first) {
  std::size_t rank = 0;
  std::vector<std::size_t> ranks;
  for (const Matrix& G : jacobians) {
    ranks.push_back(Rows(G).rank(tolerance));
    rank = std::max(rank, ranks.back());
  }
  std::vector<Rows> configurations;
  for (std::size_t k = 0; k < jacobians.size(); ++k)
    if (ranks[k] == rank) configurations.emplace_back(jacobians[k]);
  std::vector<std::size_t> chosen;
  const auto count = static_cast<std::size_t>(jacobians.front().rows());
  const auto take = [&](std::size_t row) {
    chosen.push_back(row);
    for (Rows& rows : configurations) rows.take(row);
  };
  for (const std::size_t row : first) take(row);
  while (chosen.size() < rank) take(next_row(configurations, count));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

long double largest_rest(const Matrix& G, const std::vector<std::size_t>& regular,
                         const std::vector<std::size_t>& others) {
  Rows rows(G);
  for (const std::size_t r : regular) rows.take(r);
  long double largest = 0;
  for (const std::size_t r : others) largest = std::max(largest, rows.rest(r));
  return largest;
}

std::vector<std::size_t> all_but(const std::vector<std::size_t>& rows, std::size_t count) {
  std::vector<std::size_t> others;
  for (std::size_t r = 0; r < count; ++r)
    if (std::find(rows.begin(), rows.end(), r) == rows.end()) others.push_back(r);
  return others;
}

}  // namespace jourdain::loops
