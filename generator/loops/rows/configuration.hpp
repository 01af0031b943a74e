// The constraints at given configurations, in numbers: assembling, counting degrees of freedom.
#pragma once

#include <Eigen/Dense>

#include <cstddef>
#include <vector>

#include "loops/rows/constraints.hpp"
#include "loops/rows/size_units.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

using Vector = Eigen::VectorX<long double>;
using Matrix = Eigen::MatrixX<long double>;

/// Generalized coordinates of the tree at a time (s); at the parameters' values.
struct Configuration {
  long double t = 0;
  Vector y;
  Vector states = {};  ///< beside the mechanism, where motions follow them; none: where they start
};

/// Residuals below this count as closed, in the rows' units (see Units).
inline constexpr long double kClosed = 1e-14L;

/// Which rows count: all, or those that hold positions.
enum class RowsOf { kAll, kPositions };

/// The constraints of one mechanism at fixed values of the parameters. Evaluations are const.
class NumericClosure {
 public:
  NumericClosure(const model::Mechanism& mechanism, const ConstraintPrograms& programs,
                 std::vector<double> parameters);

  std::size_t row_count() const { return rows_; }
  std::size_t velocity_count() const { return velocities_; }
  const Units& units() const { return units_; }
  const model::Tangent& tangent() const { return tangent_; }
  bool binds_velocities() const { return !without_position_.empty(); }

  /// Rows that follow from others, but for numbers that disagree: assembling and walking leave them open, by
  /// no more than `limit` (m, products of unit vectors) on the branch that is meant.
  void disregard(const std::vector<std::size_t>& rows, long double limit);
  /// Whether the rows that are regarded are closed; lengths to a hundredth of a femtometre at least.
  bool closes(const Configuration& at) const;
  /// The same, and the others nearly so.
  bool is_closed(const Configuration& at) const;
  /// max |g| of the other rows, in their units.
  long double open(const Configuration& at) const { return counted(value(at)).lpNorm<Eigen::Infinity>(); }
  /// ġ at these velocities, zero for rows that are disregarded.
  Vector opening_rate(const Configuration& at, const Vector& z) const;

  Vector value(const Configuration& at) const;      ///< g
  Matrix jacobian(const Configuration& at) const;   ///< G, rows × nz
  Vector time_rate(const Configuration& at) const;  ///< g_t
  /// What of γ no accelerations undo, of these rows in their units: where they are independent elsewhere it is beyond
  /// rounding only where the mechanism is singular and moves in a way in which it cannot go on.
  struct Bend {
    Vector left;
    long double largest = 0;  ///< max |γ|
  };
  Bend bend(const Configuration& at, const Vector& z, const std::vector<std::size_t>& rows) const;
  /// γ = g̈ − G ż
  Vector bias(const Configuration& at, const Vector& z) const;
  /// By how much points that are looked for in the rows may be missed there, m, and whose loop it is: where most.
  struct Miss {
    long double length = 0;  ///< infinite where it is found, but others are nearer
    std::size_t loop = 0;
  };
  Miss missed(const Configuration& at) const;
  /// Loops that are closed with axes against each other.
  std::vector<std::size_t> reversed(const Configuration& at) const;

  /// G between displacements and rows in units: what a row weighs beside others, of which some are lengths.
  Matrix in_units(const Matrix& G) const;
  std::vector<Matrix> in_units(const std::vector<Matrix>& jacobians) const;
  /// What a displacement or velocity amounts to, in the units of its entries.
  long double extent(const Vector& displacement) const;
  /// How far they are from each other, in units.
  long double distance(const Configuration& from, const Configuration& to) const;
  /// y moved by the displacement; quaternions keep unit length.
  Configuration displaced(const Configuration& from, const Vector& displacement) const;

  /// The nearest closed configuration, by damped Gauss-Newton steps of least norm over the velocities listed
  /// in `moving` (empty: all). Check `value` of the result: where it is not closed, g is as small as these
  /// steps can make it.
  Configuration assembled(Configuration start, const std::vector<bool>& moving) const;

  /// The nearest velocities that meet G z + g_t = 0, of those in `moving`; where there are none, those that
  /// come nearest to that.
  Vector consistent(const Configuration& at, const Vector& z, const std::vector<bool>& moving,
                    RowsOf rows = RowsOf::kAll) const;
  /// G with zeros in the rows that do not count.
  Matrix jacobian(const Configuration& at, RowsOf rows) const;

 private:
  /// Without the rows that are disregarded.
  Vector regarded(Vector g) const;
  Matrix regarded(Matrix G) const;
  /// The same in units.
  Vector counted(const Vector& g) const;
  /// The displacement d of those in `moving`, least in units, with G d = −g, of which g is in units.
  Vector closing(const Matrix& G, const Vector& g, const std::vector<bool>& moving) const;
  ir::LeafValues<long double> leaves(const Configuration& at, const Vector& z) const;

  const ConstraintPrograms& programs_;
  std::vector<std::size_t> without_position_;  ///< rows that bind velocities alone
  model::Tangent tangent_;
  std::vector<double> parameters_;
  std::vector<long double> states_;  ///< at the start
  std::size_t rows_ = 0, velocities_ = 0, inputs_ = 0;
  Units units_;
  Vector row_units_, velocity_units_;  ///< those of `units_`
  std::vector<std::size_t> disregarded_;
  long double limit_ = 0;
};

/// Pivots below this share of the largest count as zero.
inline constexpr long double kRankTolerance = 1e-9L;

/// A⁺ b, the least-squares solution of least norm.
Vector least_norm(const Matrix& A, const Vector& b);

/// Whether all coordinates are within the ranges that they declare.
bool in_range(const Configuration& config, const model::Mechanism& mechanism,
              const model::CoordinateLayout& layout);

/// Closed configurations from seeded random walks on the constraint manifold, the first is `start`. Where no
/// freedom is left they are those of times to come; without prescribed motion all are the start.
std::vector<Configuration> walk(const NumericClosure& closure, const Configuration& start,
                                const model::Mechanism& mechanism, std::size_t count);

}  // namespace jourdain::loops
