#include "loops/intervals/branch.hpp"

#include <algorithm>
#include <cmath>

#include "ir/compose.hpp"
#include "ir/jacobian.hpp"
#include "passes/rewrite.hpp"
#include "reference/decompositions.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ir::LeafKind;

namespace {

using support::at;

constexpr int kNewtonSteps = 12;
/// Of a unit of x: Newton's last step in double precision.
constexpr double kConverged = 1e-9;
constexpr int kInflations = 4;
/// A set that is larger than its image needs is mapped into itself more easily.
constexpr double kInflation = 1.25;
/// So that the branch is well inside of X: of a unit of x, and of how far x moves over the box.
constexpr double kLeastWidth = 1e-15, kLeastShare = 1e-3;

Intervals point(const VectorXd& x) {
  Intervals result;
  for (const double value : x) result.push_back(Interval::point(value));
  return result;
}

}  // namespace

double magnitude(Interval a) { return std::max(std::fabs(a.low), std::fabs(a.high)); }

bool is_inside(const Intervals& inner, const Intervals& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i)
    if (!(outer[i].low < inner[i].low && inner[i].high < outer[i].high)) return false;
  return true;
}

IntervalMatrix product(const MatrixXd& C, const IntervalMatrix& A) {
  const auto rows = static_cast<std::size_t>(C.rows());
  IntervalMatrix result(rows, A.columns);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < A.columns; ++j)
      for (std::size_t k = 0; k < A.rows; ++k)
        if (C(at(i), at(k)) != 0 && A(k, j) != Interval{})
          result(i, j) = result(i, j) + Interval::point(C(at(i), at(k))) * A(k, j);
  return result;
}

IntervalMatrix rest(const MatrixXd& C, const IntervalMatrix& A) {
  IntervalMatrix result = product(C, A);
  for (std::size_t i = 0; i < result.rows; ++i)
    for (std::size_t j = 0; j < result.columns; ++j)
      result(i, j) = Interval::point(i == j ? 1 : 0) - result(i, j);
  return result;
}

BranchEquations::BranchEquations(const ir::Program& g, std::vector<Variable> unknowns,
                                 std::vector<Variable> free, ir::LeafValues<double> fixed, Evaluator evaluate)
    : unknowns_(std::move(unknowns)),
      free_(std::move(free)),
      fixed_(std::move(fixed)),
      evaluate_(std::move(evaluate)) {
  JD_CHECK(g.outputs.size() == unknowns_.size(), "{} rows for {} unknowns", g.outputs.size(), size());
  for (std::size_t kind = 0; kind < ir::kLeafKinds; ++kind)
    for (const double value : fixed_.of[kind]) fixed_intervals_.of[kind].push_back(Interval::point(value));
  SummedAngles summed = with_summed_angles(g, first_sum());
  values_ = std::move(summed.program);
  sums_ = std::move(summed.sums);
  ir::Builder builder;
  std::vector<ir::Seed> seeds;
  std::size_t column = 0;
  for (const auto* list : {&unknowns_, &free_})
    for (const Variable& v : *list) {
      seeds.push_back({builder.leaf(v.kind, v.index), column, builder.literal(1)});
      for (std::size_t s = 0; s < sums_.size() && v.kind == LeafKind::kPosition; ++s)
        for (const auto& [position, factor] : sums_[s].terms)
          if (position == v.index)
            seeds.push_back(
                {builder.leaf(LeafKind::kPosition, first_sum() + s), column, builder.literal(factor)});
      ++column;
    }
  for (const auto& [where, value] : ir::differentiate(builder, ir::insert(builder, values_), seeds, {}))
    builder.output("slope", static_cast<int>(where.first), static_cast<int>(where.second), value);
  slopes_ = passes::remove_dead_code(builder.finish("slopes"));
}

ir::LeafValues<double> BranchEquations::leaves(const VectorXd& x, const VectorXd& p) const {
  ir::LeafValues<double> leaves = fixed_;
  for (std::size_t i = 0; i < size(); ++i) leaves[unknowns_[i].kind][unknowns_[i].index] = x[at(i)];
  for (std::size_t i = 0; i < free_.size(); ++i) leaves[free_[i].kind][free_[i].index] = p[at(i)];
  std::vector<double>& y = leaves[LeafKind::kPosition];
  for (const AngleSum& sum : sums_) {
    double value = sum.offset;
    for (const auto& [position, factor] : sum.terms) value += factor * y[position];
    y.push_back(value);
  }
  return leaves;
}

ir::LeafValues<Interval> BranchEquations::leaves(const Branch& branch,
                                                 const std::vector<double>& around) const {
  ir::LeafValues<Interval> leaves = fixed_intervals_;
  const Intervals X = branch.over(branch.P);
  for (std::size_t i = 0; i < size(); ++i)
    leaves[unknowns_[i].kind][unknowns_[i].index] = X[i] + Interval{-around[i], around[i]};
  for (std::size_t i = 0; i < free_.size(); ++i) leaves[free_[i].kind][free_[i].index] = branch.P[i];
  for (const AngleSum& sum : sums_) leaves[LeafKind::kPosition].push_back(along(sum, branch, around));
  return leaves;
}

/// Σ factor y with y = x + S (P − c) + U and y = c + (P − c): terms of one p are added up before its interval comes in.
Interval BranchEquations::along(const AngleSum& sum, const Branch& branch,
                                const std::vector<double>& around) const {
  Interval value = Interval::point(sum.offset);
  Intervals slope(free_.size());
  for (const auto& [position, factor] : sum.terms) {
    const Interval f = Interval::point(factor);
    const Variable variable = {LeafKind::kPosition, position};
    const auto unknown = std::find(unknowns_.begin(), unknowns_.end(), variable);
    const auto free = std::find(free_.begin(), free_.end(), variable);
    if (unknown != unknowns_.end()) {
      const auto i = static_cast<std::size_t>(unknown - unknowns_.begin());
      value = value + f * (Interval::point(branch.x[at(i)]) + branch.U[i] + Interval{-around[i], around[i]});
      for (std::size_t k = 0; k < slope.size(); ++k)
        slope[k] = slope[k] + f * Interval::point(branch.S(at(i), at(k)));
    } else if (free != free_.end()) {
      const auto k = static_cast<std::size_t>(free - free_.begin());
      value = value + f * Interval::point(branch.centre[at(k)]);
      slope[k] = slope[k] + f;
    } else {
      value = value + f * Interval::point(fixed_[LeafKind::kPosition][position]);
    }
  }
  for (std::size_t k = 0; k < slope.size(); ++k)
    value = value + slope[k] * (branch.P[k] - Interval::point(branch.centre[at(k)]));
  return value;
}

MatrixXd BranchEquations::slopes(const VectorXd& x, const VectorXd& p) const {
  const std::vector<double> values = ir::interpret(slopes_, leaves(x, p));
  MatrixXd result = MatrixXd::Zero(at(size()), at(size() + free_.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    result(slopes_.outputs[i].row, slopes_.outputs[i].column) = values[i];
  return result;
}

std::optional<IntervalMatrix> BranchEquations::slopes(const Branch& branch) const {
  const ir::IntervalResults found = evaluate_(slopes_, leaves(branch, std::vector<double>(size(), 0)));
  IntervalMatrix result(size(), size() + free_.size());
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    if (found.maybe_undefined[i]) return {};
    result(static_cast<std::size_t>(slopes_.outputs[i].row),
           static_cast<std::size_t>(slopes_.outputs[i].column)) = found.values[i];
  }
  return result;
}

std::optional<Intervals> BranchEquations::value(const VectorXd& x, const VectorXd& p) const {
  const Branch here = {point(p), p, x, {}, MatrixXd::Zero(x.size(), p.size()), Intervals(size())};
  const ir::IntervalResults found = evaluate_(values_, leaves(here, std::vector<double>(size(), 0)));
  for (const bool undefined : found.maybe_undefined)
    if (undefined) return {};
  return found.values;
}

std::optional<VectorXd> BranchEquations::solution(VectorXd x, const VectorXd& p) const {
  for (int i = 0; i < kNewtonSteps; ++i) {
    const auto g = value(x, p);
    if (!g) return {};
    VectorXd middle(x.size());
    for (std::size_t k = 0; k < size(); ++k) middle[at(k)] = (*g)[k].middle();
    const VectorXd step = reference::solved_by_lu<double>(slopes(x, p).leftCols(x.size()), middle);
    if (!step.allFinite()) return {};
    x -= step;
    if (step.cwiseAbs().maxCoeff() <= kConverged) return x;
  }
  return {};
}

Intervals Branch::over(const Intervals& part) const {
  Intervals result;
  for (std::size_t i = 0; i < U.size(); ++i) {
    Interval value = Interval::point(x[at(i)]) + U[i];
    for (std::size_t k = 0; k < part.size(); ++k)
      value = value + Interval::point(S(at(i), at(k))) * (part[k] - Interval::point(centre[at(k)]));
    result.push_back(value);
  }
  return result;
}

namespace {

/// One box under proof.
class Krawczyk {
 public:
  Krawczyk(const BranchEquations& equations, Branch branch, const Intervals& g)
      : equations_(equations), branch_(std::move(branch)) {
    for (std::size_t k = 0; k < branch_.P.size(); ++k)
      shift_.push_back(branch_.P[k] - Interval::point(branch_.centre[at(k)]));
    IntervalMatrix column(g.size(), 1);
    column.entries = g;
    offset_ = product(branch_.C, column).entries;
    for (std::size_t i = 0; i < g.size(); ++i) {
      double change = 0;
      for (std::size_t k = 0; k < shift_.size(); ++k)
        change += std::fabs(branch_.S(at(i), at(k))) * shift_[k].high;
      least_.push_back(kLeastWidth + kLeastShare * change);
    }
  }

  std::optional<Branch> run() {
    Intervals U(equations_.size());
    for (int i = 0; i <= kInflations; ++i) {
      for (std::size_t k = 0; k < U.size(); ++k) {
        const double radius = kInflation * magnitude(U[k]) + least_[k];
        U[k] = {-radius, radius};
      }
      const std::optional<Intervals> image = map(U, i > 0);
      if (!image) return {};
      if (is_inside(*image, U)) return branch_;
      U = *image;
    }
    return {};
  }

 private:
  /// K(U). Nothing where no multiple of U can do better; the first U has no shape yet.
  std::optional<Intervals> map(const Intervals& U, bool has_shape) {
    const std::size_t n = equations_.size();
    branch_.U = U;
    const std::optional<IntervalMatrix> A = equations_.slopes(branch_);
    if (!A) return {};
    IntervalMatrix jacobian(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) jacobian(i, j) = (*A)(i, j);
    const IntervalMatrix E = rest(branch_.C, jacobian), drift = product(branch_.C, along_tangent(*A));
    Intervals image;
    for (std::size_t i = 0; i < n; ++i) {
      Interval value = Interval{} - offset_[i];
      for (std::size_t k = 0; k < shift_.size(); ++k) value = value - drift(i, k) * shift_[k];
      Interval size;
      for (std::size_t j = 0; j < n; ++j) {
        value = value + E(i, j) * U[j];
        size = size + Interval::point(magnitude(E(i, j))) * U[j];
      }
      if (has_shape && !(size.high < U[i].high)) return {};
      image.push_back(value);
    }
    return image;
  }

  Interval slope(std::size_t i, std::size_t k) const { return Interval::point(branch_.S(at(i), at(k))); }

  /// A_p + A_x S
  IntervalMatrix along_tangent(const IntervalMatrix& A) const {
    const std::size_t n = equations_.size();
    IntervalMatrix result(n, shift_.size());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < shift_.size(); ++k) {
        result(i, k) = A(i, n + k);
        for (std::size_t j = 0; j < n; ++j) result(i, k) = result(i, k) + A(i, j) * slope(j, k);
      }
    return result;
  }

  const BranchEquations& equations_;
  Branch branch_;
  Intervals shift_, offset_;   ///< P − c; C g(x, c)
  std::vector<double> least_;  ///< of the radius of U
};

}  // namespace

std::optional<Branch> enclose_branch(const BranchEquations& equations, const Intervals& P,
                                     const VectorXd& guess) {
  VectorXd centre(at(P.size()));
  for (std::size_t k = 0; k < P.size(); ++k) centre[at(k)] = P[k].middle();
  const std::optional<VectorXd> x = equations.solution(guess, centre);
  if (!x) return {};
  const auto g = equations.value(*x, centre);
  const MatrixXd slopes = equations.slopes(*x, centre);
  const MatrixXd C = reference::inverse<double>(slopes.leftCols(x->size()));
  if (!g || !C.allFinite()) return {};
  const MatrixXd S = -C * slopes.rightCols(centre.size());
  Branch branch{P, centre, *x, C, S, {}};
  return Krawczyk(equations, std::move(branch), *g).run();
}

}  // namespace jourdain::loops
