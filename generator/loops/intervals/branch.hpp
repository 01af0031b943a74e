// One branch of the solutions of g(x, p) = 0 over a box of p, enclosed by interval arithmetic.
#pragma once

#include <Eigen/Dense>

#include <functional>
#include <optional>
#include <vector>

#include "ir/program_intervals.hpp"
#include "loops/intervals/angle_sums.hpp"
#include "loops/intervals/variable.hpp"

namespace jourdain::loops {

using support::Interval;
using Intervals = std::vector<Interval>;
/// Encloses the outputs of a program: ir::interpret_interval. Tests put wrong ones in its place.
using Evaluator = std::function<ir::IntervalResults(const ir::Program&, const ir::LeafValues<Interval>&)>;

/// Entries by row.
struct IntervalMatrix {
  std::size_t rows = 0, columns = 0;
  Intervals entries;

  IntervalMatrix(std::size_t r, std::size_t c) : rows(r), columns(c), entries(r * c) {}
  Interval& operator()(std::size_t r, std::size_t c) { return entries[r * columns + c]; }
  Interval operator()(std::size_t r, std::size_t c) const { return entries[r * columns + c]; }
};

/// C A; `C` is exact.
IntervalMatrix product(const Eigen::MatrixXd& C, const IntervalMatrix& A);

/// 1 − C A of a square A.
IntervalMatrix rest(const Eigen::MatrixXd& C, const IntervalMatrix& A);

/// Largest absolute value.
double magnitude(Interval a);

bool is_inside(const Intervals& inner, const Intervals& outer);

/// A branch x(p) over a box P of the free variables: for every p in P there is exactly one solution in x + S
/// (p − centre) + U. It depends continuously on p, and ∂g/∂x is regular all over that set.
struct Branch {
  Intervals P;
  Eigen::VectorXd centre, x;  ///< the middle of P; a point near the branch there
  Eigen::MatrixXd C, S;       ///< near (∂g/∂x)⁻¹ there, and the slope dx/dp
  Intervals U;

  /// Near x(p) at a point of P; not proven.
  Eigen::VectorXd guess(const Eigen::VectorXd& p) const { return x + S * (p - centre); }
  /// Where it is over a part of P.
  Intervals over(const Intervals& part) const;
};

/// g and its derivatives by the unknowns x and the free variables p. Other leaves have fixed values.
class BranchEquations {
 public:
  /// As many outputs of `g` as unknowns.
  BranchEquations(const ir::Program& g, std::vector<Variable> unknowns, std::vector<Variable> free,
                  ir::LeafValues<double> fixed, Evaluator evaluate);

  std::size_t size() const { return unknowns_.size(); }
  std::size_t free_count() const { return free_.size(); }

  /// (∂g/∂x, ∂g/∂p) at a point.
  Eigen::MatrixXd slopes(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;
  /// Over all of a branch's set. Nothing where it may not exist.
  std::optional<IntervalMatrix> slopes(const Branch& branch) const;
  /// g at a point, with what rounding does to it.
  std::optional<Intervals> value(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;
  /// The solution near x, by Newton's method in double precision; not proven. Nothing where that fails.
  std::optional<Eigen::VectorXd> solution(Eigen::VectorXd x, const Eigen::VectorXd& p) const;

  /// g, of positions and sums of positions as `with_summed_angles` has them.
  const ir::Program& rows() const { return values_; }
  const std::vector<AngleSum>& sums() const { return sums_; }
  std::size_t first_sum() const { return fixed_[ir::LeafKind::kPosition].size(); }
  /// All leaves of such programs at a point, and over a branch's set with unknowns off by as much as `around` more.
  ir::LeafValues<double> leaves(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;
  ir::LeafValues<Interval> leaves(const Branch& branch, const std::vector<double>& around) const;
  ir::IntervalResults evaluated(const ir::Program& program, const ir::LeafValues<Interval>& leaves) const {
    return evaluate_(program, leaves);
  }

 private:
  Interval along(const AngleSum& sum, const Branch& branch, const std::vector<double>& around) const;

  std::vector<Variable> unknowns_, free_;
  ir::LeafValues<double> fixed_;
  std::vector<AngleSum> sums_;
  ir::LeafValues<Interval> fixed_intervals_;
  ir::Program values_, slopes_;
  Evaluator evaluate_;
};

/// Encloses the branch that Newton's method finds from `guess` over the box P: the operator of Krawczyk (1969)
/// on the deviation from its tangent. With A enclosing the derivatives over x + S (P − c) + U,
///
///   K(U) = −C g(x, c) − C (A_p + A_x S) (P − c) + (1 − C A_x) U
///
/// maps solutions in U to themselves; where K(U) is inside U there is one for every p, and A_x is regular
/// (Neumaier 1990, theorem 5.1.8). Nothing where the box is too large for that, or no branch is there.
std::optional<Branch> enclose_branch(const BranchEquations& equations, const Intervals& P,
                                     const Eigen::VectorXd& guess);

}  // namespace jourdain::loops
