#include "loops/branch.hpp"

#include <algorithm>
#include <cmath>

#include "ir/compose.hpp"
#include "ir/jacobian.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ir::LeafKind;

namespace {

constexpr int kNewtonSteps = 12;
/// Of a unit of x: Newton's last step in double precision.
constexpr double kConverged = 1e-9;
constexpr int kInflations = 4;
/// A set that is larger than its image needs is mapped into itself more easily.
constexpr double kInflation = 1.25;
/// So that the branch is well inside of X: of a unit of x, and of how far x moves over the box.
constexpr double kLeastWidth = 1e-15, kLeastShare = 1e-3;

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

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
      values_(g),
      evaluate_(std::move(evaluate)) {
  JD_CHECK(g.outputs.size() == unknowns_.size(), "{} rows for {} unknowns", g.outputs.size(), size());
  for (std::size_t kind = 0; kind < ir::kLeafKinds; ++kind)
    for (const double value : fixed_.of[kind]) fixed_intervals_.of[kind].push_back(Interval::point(value));
  ir::Builder builder;
  std::vector<ir::Seed> seeds;
  for (const auto* list : {&unknowns_, &free_})
    for (const Variable& v : *list)
      seeds.push_back({builder.leaf(v.kind, v.index), seeds.size(), builder.literal(1)});
  for (const auto& [where, value] : ir::differentiate(builder, ir::insert(builder, g), seeds, {}))
    builder.output("slope", static_cast<int>(where.first), static_cast<int>(where.second), value);
  slopes_ = passes::remove_dead_code(builder.finish("slopes"));
}

ir::LeafValues<Interval> BranchEquations::leaves(const Intervals& x, const Intervals& p) const {
  ir::LeafValues<Interval> leaves = fixed_intervals_;
  for (std::size_t i = 0; i < x.size(); ++i) leaves[unknowns_[i].kind][unknowns_[i].index] = x[i];
  for (std::size_t i = 0; i < p.size(); ++i) leaves[free_[i].kind][free_[i].index] = p[i];
  return leaves;
}

ir::LeafValues<double> BranchEquations::leaves(const VectorXd& x, const VectorXd& p) const {
  ir::LeafValues<double> leaves = fixed_;
  for (std::size_t i = 0; i < size(); ++i) leaves[unknowns_[i].kind][unknowns_[i].index] = x[at(i)];
  for (std::size_t i = 0; i < free_.size(); ++i) leaves[free_[i].kind][free_[i].index] = p[at(i)];
  return leaves;
}

MatrixXd BranchEquations::slopes(const VectorXd& x, const VectorXd& p) const {
  const std::vector<double> values = ir::interpret(slopes_, leaves(x, p));
  MatrixXd result = MatrixXd::Zero(at(size()), at(size() + free_.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    result(slopes_.outputs[i].row, slopes_.outputs[i].column) = values[i];
  return result;
}

std::optional<IntervalMatrix> BranchEquations::slopes(const Intervals& x, const Intervals& p) const {
  const ir::IntervalResults found = evaluate_(slopes_, leaves(x, p));
  IntervalMatrix result(size(), size() + free_.size());
  for (std::size_t i = 0; i < found.values.size(); ++i) {
    if (found.maybe_undefined[i]) return {};
    result(static_cast<std::size_t>(slopes_.outputs[i].row),
           static_cast<std::size_t>(slopes_.outputs[i].column)) = found.values[i];
  }
  return result;
}

std::optional<Intervals> BranchEquations::value(const VectorXd& x, const VectorXd& p) const {
  const ir::IntervalResults found = evaluate_(values_, leaves(point(x), point(p)));
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
    const VectorXd step = slopes(x, p).leftCols(x.size()).partialPivLu().solve(middle);
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
    branch_.X = branch_.over(branch_.P);
    const std::optional<IntervalMatrix> A = equations_.slopes(branch_.X, branch_.P);
    if (!A) return {};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) branch_.jacobian(i, j) = (*A)(i, j);
    const IntervalMatrix E = rest(branch_.C, branch_.jacobian), drift = product(branch_.C, along_tangent(*A));
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
  const MatrixXd C = slopes.leftCols(x->size()).inverse();
  if (!g || !C.allFinite()) return {};
  const MatrixXd S = -C * slopes.rightCols(centre.size());
  Branch branch{P, centre, *x, C, S, {}, {}, IntervalMatrix(equations.size(), equations.size())};
  return Krawczyk(equations, std::move(branch), *g).run();
}

}  // namespace jourdain::loops
