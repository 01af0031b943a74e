// What holds of dependent blocks all along a branch: how regular they are, from how far away Newton iterations
// come back.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "loops/intervals/branch.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

/// What the iterations solve: rows and dependent velocities, block after block.
struct NewtonProblem {
  std::vector<Block> blocks;  ///< rows as the branch's equations count them
  model::Tangent tangent;
  std::size_t positions = 0;  ///< entries of y; position leaves after them are free variables
  std::size_t velocities = 0;
  std::vector<bool> slides;          ///< by velocity: a length
  std::vector<bool> slide_unknowns;  ///< by unknown of the branch
  int iterations = 2;
};

/// Takes a branch box by box. The margin of a block A is the least |det A| over the product of the largest
/// norms of its rows, columns divided by their norms at the start. With C near A⁻¹ and e_ij bounds of |1 − C
/// A|, |det A| ≥ Π (1 − Σ_j e_ij) / |det C| (Ostrowski 1937).
///
/// Displacements d lead from the dependents to the branch; slides count in units of `length`. In one block
/// with e = max |d| Newton's iteration leaves e⁺ ≤ κ ω/2 e², ω a bound of |G⁻¹ ∂²g/∂d²| (the affine invariant
/// form of the theorem of Newton and Kantorovich: Deuflhard 2004, theorem 2.3), κ = 2 where there are
/// quaternions, whose displacements do not add up. That rows do not depend on later blocks is seen at the
/// middle of each box, not proven.
class BlockBounds {
 public:
  BlockBounds(NewtonProblem problem, const BranchEquations& equations, const Eigen::VectorXd& start_x,
              const Eigen::VectorXd& start_p);

  /// Makes the bounds so small that they hold on this box too. False, and nothing changed, where the box is
  /// too large to tell or the margin not proven to be above `least`.
  bool include(const Branch& branch, double least);

  /// The smallest of all blocks.
  double margin() const;
  /// |det| at a point over the norms so far, the smallest of all blocks; not proven.
  double margin_near(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;

  /// Dependents off by this or less come back; rad, or units of `length`.
  double radius() const { return radius_; }
  /// Nowhere else within this of the branch do the rows vanish. With 1 − C G of norm θ or less there, a first
  /// correction c belongs to dependents off by |c| (1 + θ)/(1 − θ) or less.
  double isolation() const { return isolation_; }
  /// So do those within `isolation` whose first correction, the root of the sum of the squares of all blocks',
  /// is at most this; rad, m.
  double first_correction() const;
  /// Distance from the branch after the iterations, in exact arithmetic.
  double ends_within() const;
  double length() const { return length_; }

 private:
  struct Bounds {
    double contraction = 0;           ///< of 1 − C G
    double omega = 0;                 ///< of G⁻¹ ∂²g/∂d²
    double amplification = 1;         ///< of what each block is off by
    std::vector<double> determinant;  ///< by block: a lower bound
    std::vector<double> row_norm;     ///< by row: an upper bound
  };
  struct Tensors {
    std::vector<std::vector<Interval>> G, H;  ///< by row; then by velocity, by velocity and velocity
  };

  void scale(const Eigen::VectorXd& x, const Eigen::VectorXd& p);
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& p) const;
  /// At dependents within `reach` of the branch; G at all displacements of up to `span` from them.
  std::optional<Tensors> tensors(const Branch& branch, double reach, double span) const;
  std::optional<Bounds> bounds(const Branch& branch, double reach, double span = 0) const;
  bool is_isolated(const Branch& branch, double reach) const;
  bool add_block(const Block& block, const Eigen::MatrixXd& middle, const Tensors& over, Bounds& result,
                 std::vector<double>& off) const;
  double determinant_of(const Block& block, const Eigen::MatrixXd& C, const IntervalMatrix& E) const;
  double margin(const std::vector<double>& determinant, const std::vector<double>& row_norm) const;
  double radius_within(double omega) const;
  bool narrow(const Branch& branch);
  void isolate(const Branch& branch);

  NewtonProblem problem_;
  const BranchEquations& equations_;
  ir::Program G_, H_;
  std::vector<double> size_;         ///< by velocity: 1 rad, or `length`
  std::vector<double> column_norm_;  ///< by velocity, at the start
  std::vector<double> row_scale_;
  std::vector<double> determinant_, row_norm_;  ///< by block, by row; columns divided
  double radius_ = 0.1, isolation_ = 0.5, omega_ = 0, amplification_ = 1, length_ = 1;
};

}  // namespace jourdain::loops
