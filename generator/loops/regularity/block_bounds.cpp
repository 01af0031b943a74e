#include "loops/regularity/block_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "ir/compose.hpp"
#include "ir/jacobian.hpp"
#include "loops/rows/loop_system.hpp"
#include "passes/rewrite.hpp"
#include "reference/decompositions.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using ir::LeafKind;

namespace {

using support::at;
using support::subscript;

/// What each block may be off by after its iterations, and the share of the radius that blocks before it may
/// move it by.
constexpr double kEnd = 1e-10, kMoved = 0.01;
constexpr double kLeastRadius = 1e-8;
/// Bounds hold within this many radii.
constexpr double kReach = 4;
/// Of 1 − C G: beyond it bounds by it say little. Of a box by itself, so that some is left for what is near.
constexpr double kContraction = 0.75, kSmall = 0.65;
/// Of a row: what is left of entries that are zero everywhere. Analytic ones that vanish at many points are.
constexpr double kCancelled = 1e-12;
/// Makes good the rounding of sums of bounds.
constexpr double kOutward = 1 + 1e-9;

/// By elimination, pivots chosen in double precision.
Interval determinant(const MatrixXd& A) {
  const auto n = static_cast<std::size_t>(A.rows());
  IntervalMatrix U(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) U(i, j) = Interval::point(A(at(i), at(j)));
  Interval result = Interval::point(1);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; ++i)
      if (std::fabs(U(i, k).middle()) > std::fabs(U(pivot, k).middle())) pivot = i;
    for (std::size_t j = k; j < n; ++j)
      std::swap(U(k, j), U(pivot, j));  // turns the sign, which is not asked for
    result = result * U(k, k);
    if (U(k, k).contains(0)) return Interval::line();
    const double inverse = 1 / U(k, k).middle();
    for (std::size_t i = k + 1; i < n; ++i) {
      const Interval factor = Interval::point(U(i, k).middle() * inverse);
      for (std::size_t j = k; j < n; ++j) U(i, j) = U(i, j) - factor * U(k, j);
    }
  }
  return result;
}

}  // namespace

BlockBounds::BlockBounds(NewtonProblem problem, const BranchEquations& equations, const VectorXd& start_x,
                         const VectorXd& start_p)
    : problem_(std::move(problem)), equations_(equations) {
  ir::Builder builder;
  Column y, d(problem_.velocities, builder.literal(0));
  for (std::size_t i = 0; i < problem_.positions; ++i) y.push_back(builder.leaf(LeafKind::kPosition, i));
  std::vector<ir::Seed> seeds;
  for (const Block& block : problem_.blocks)
    for (const std::size_t k : block.dependents) {
      d[k] = builder.leaf(LeafKind::kVelocity, k);
      seeds.push_back({d[k], k, builder.literal(1)});
    }
  Column move(y.size(), builder.literal(0));
  for (const model::Tangent::Scalar& s : problem_.tangent.scalars) move[s.position] = d[s.velocity];
  const Column moved = displaced(builder, problem_.tangent, y, d);
  const auto leaf = [&](LeafKind kind, std::size_t i) -> std::optional<ir::Signed> {
    if (kind != LeafKind::kPosition) return {};
    if (i < y.size()) return moved[i];
    if (i < equations_.first_sum()) return {};
    ir::Signed sum = builder.leaf(kind, i);
    for (const auto& [position, factor] : equations_.sums()[i - equations_.first_sum()].terms)
      if (position < y.size())
        sum = builder.add(sum, builder.multiply(builder.literal(factor), move[position]));
    return sum;
  };
  const Column g = ir::insert(builder, equations_.rows(), leaf);
  const ir::JacobianEntries first = ir::differentiate(builder, g, seeds, {});
  ir::Builder second = builder;
  Column slopes;
  for (const auto& [where, value] : first) {
    slopes.push_back(value);
    builder.output("G", static_cast<int>(where.first), static_cast<int>(where.second), value);
  }
  G_ = passes::remove_dead_code(builder.finish("G"));
  for (const auto& [where, value] : ir::differentiate(second, slopes, seeds, {})) {
    const auto [row, column] = std::next(first.begin(), static_cast<std::ptrdiff_t>(where.first))->first;
    second.output("H", static_cast<int>(row), static_cast<int>(column * problem_.velocities + where.second),
                  value);
  }
  H_ = passes::remove_dead_code(second.finish("H"));
  scale(start_x, start_p);
}

/// A slide counts as the angle that moves the rows as far, by the longest columns; rows are measured so too.
void BlockBounds::scale(const VectorXd& x, const VectorXd& p) {
  const MatrixXd G = jacobian(x, p);
  double angle = 0, slide = 0;
  for (const Block& block : problem_.blocks)
    for (const std::size_t k : block.dependents) {
      double& longest = problem_.slides[k] ? slide : angle;
      longest = std::max(longest, G.col(at(k)).norm());
    }
  if (angle > 0 && slide > 0) length_ = angle / slide;
  for (const bool is_slide : problem_.slides) size_.push_back(is_slide ? length_ : 1);
  for (const double norm : G.colwise().norm()) column_norm_.push_back(norm > 0 ? norm : 1);
  determinant_.assign(problem_.blocks.size(), INFINITY);
  row_norm_.assign(equations_.rows().outputs.size(), 0);
  row_scale_.assign(equations_.rows().outputs.size(), 0);
  for (const Block& block : problem_.blocks)
    for (const std::size_t r : block.rows)
      for (const std::size_t k : block.dependents) {
        row_scale_[r] = std::hypot(row_scale_[r], G(at(r), at(k)) * size_[k]);
        row_norm_[r] = std::hypot(row_norm_[r], G(at(r), at(k)) / column_norm_[k]);
      }
}

MatrixXd BlockBounds::jacobian(const VectorXd& x, const VectorXd& p) const {
  ir::LeafValues<double> leaves = equations_.leaves(x, p);
  leaves[LeafKind::kVelocity].assign(problem_.velocities, 0);
  const std::vector<double> values = ir::interpret(G_, leaves);
  MatrixXd G = MatrixXd::Zero(at(equations_.rows().outputs.size()), at(problem_.velocities));
  for (std::size_t i = 0; i < values.size(); ++i) G(G_.outputs[i].row, G_.outputs[i].column) = values[i];
  return G;
}

/// A displacement d moves entries of a quaternion by |d|/2 at most.
std::optional<BlockBounds::Tensors> BlockBounds::tensors(const Branch& branch, double reach,
                                                         double span) const {
  std::vector<double> around;
  for (const bool is_slide : problem_.slide_unknowns) around.push_back(reach * (is_slide ? length_ : 1));
  ir::LeafValues<Interval> leaves = equations_.leaves(branch, around);
  const auto displace = [&](double by) {
    leaves[LeafKind::kVelocity].clear();
    for (const double size : size_) leaves[LeafKind::kVelocity].push_back({-by * size, by * size});
  };
  displace(span);
  const std::size_t rows = equations_.rows().outputs.size(), n = problem_.velocities;
  Tensors result{std::vector(rows, std::vector<Interval>(n)),
                 std::vector(rows, std::vector<Interval>(n * n))};
  const auto place = [](const ir::Program& program, const ir::IntervalResults& found, auto& tensor) {
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      if (found.maybe_undefined[i]) return false;
      tensor[subscript(program.outputs[i].row)][subscript(program.outputs[i].column)] = found.values[i];
    }
    return true;
  };
  if (!place(G_, equations_.evaluated(G_, leaves), result.G)) return {};
  displace(reach);
  if (!place(H_, equations_.evaluated(H_, leaves), result.H)) return {};
  return result;
}

/// Of one block, in the norm max |d| / size. `off`: by velocity what earlier blocks are off by, units of kEnd.
bool BlockBounds::add_block(const Block& block, const MatrixXd& middle, const Tensors& over, Bounds& result,
                            std::vector<double>& off) const {
  const std::size_t n = block.dependents.size(), nz = problem_.velocities;
  MatrixXd J(at(n), at(n));
  IntervalMatrix G(n, n), H(n, n * n), earlier(n, nz);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t row = block.rows[i], column = block.dependents[j];
      J(at(i), at(j)) = middle(at(row), at(column));
      G(i, j) = over.G[row][column];
      for (std::size_t k = 0; k < n; ++k) H(i, j * n + k) = over.H[row][column * nz + block.dependents[k]];
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < nz; ++k) {
      const bool own =
          std::find(block.dependents.begin(), block.dependents.end(), k) != block.dependents.end();
      const double entry = std::fabs(middle(at(block.rows[i]), at(k)));
      if (off[k] > 0)
        earlier(i, k) = over.G[block.rows[i]][k];
      else if (!own && entry > kCancelled * row_scale_[block.rows[i]])
        return false;  // a later block moves this one
    }
  const MatrixXd C = reference::inverse<double>(J);
  if (!C.allFinite()) return false;
  const IntervalMatrix E = rest(C, G), CH = product(C, H), drift = product(C, earlier);
  double contraction = 0, omega = 0, moved = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double size = size_[block.dependents[i]];
    double sums[3] = {0, 0, 0};
    for (std::size_t j = 0; j < n; ++j) {
      const double size_j = size_[block.dependents[j]];
      sums[0] += magnitude(E(i, j)) * size_j / size;
      for (std::size_t k = 0; k < n; ++k)
        sums[1] += magnitude(CH(i, j * n + k)) * size_j * size_[block.dependents[k]] / size;
    }
    for (std::size_t k = 0; k < nz; ++k) sums[2] += magnitude(drift(i, k)) * off[k] * size_[k] / size;
    contraction = std::max(contraction, sums[0]);
    omega = std::max(omega, sums[1]);
    moved = std::max(moved, sums[2]);
  }
  if (!(contraction < kContraction)) return false;
  result.contraction = std::max(result.contraction, contraction);
  result.determinant.push_back(determinant_of(block, C, E));
  for (std::size_t i = 0; i < n; ++i) {
    double square = 0;
    for (std::size_t j = 0; j < n; ++j)
      square += std::pow(magnitude(G(i, j)) / column_norm_[block.dependents[j]], 2);
    result.row_norm[block.rows[i]] = std::sqrt(square) * kOutward;
  }
  const double factor = kOutward / (1 - contraction * kOutward);
  const double kappa = problem_.tangent.quaternions.empty() ? 1 : 2;
  result.omega = std::max(result.omega, kappa * factor * omega);
  for (const std::size_t k : block.dependents) off[k] = 1 + factor * moved;
  result.amplification = std::max(result.amplification, 1 + factor * moved);
  return true;
}

/// `E` is 1 − C G over a box, `C` exact.
double BlockBounds::determinant_of(const Block& block, const MatrixXd& C, const IntervalMatrix& E) const {
  double result = 1 / (magnitude(determinant(C)) * kOutward);
  for (std::size_t i = 0; i < E.rows; ++i) {
    double off = 0;
    for (std::size_t j = 0; j < E.columns; ++j)
      off += magnitude(E(i, j)) * size_[block.dependents[j]] / size_[block.dependents[i]];
    result *= (1 - off * kOutward) / (column_norm_[block.dependents[i]] * kOutward);
  }
  return result;
}

double BlockBounds::margin(const std::vector<double>& determinant,
                           const std::vector<double>& row_norm) const {
  double margin = 1;
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    double share = determinant[b];
    for (const std::size_t r : problem_.blocks[b].rows) share /= std::max(row_norm[r], row_norm_[r]);
    margin = std::min(margin, share);
  }
  return margin;
}

double BlockBounds::margin() const { return margin(determinant_, row_norm_); }

double BlockBounds::margin_near(const VectorXd& x, const VectorXd& p) const {
  const MatrixXd G = jacobian(x, p);
  std::vector<double> determinants, norms(row_norm_.size(), 0);
  for (const Block& block : problem_.blocks) {
    MatrixXd A(at(block.rows.size()), at(block.rows.size()));
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      for (std::size_t j = 0; j < block.rows.size(); ++j)
        A(at(i), at(j)) = G(at(block.rows[i]), at(block.dependents[j])) / column_norm_[block.dependents[j]];
    determinants.push_back(std::fabs(reference::determinant<double>(A)));
    for (std::size_t i = 0; i < block.rows.size(); ++i) norms[block.rows[i]] = A.row(at(i)).norm();
  }
  return margin(determinants, norms);
}

std::optional<BlockBounds::Bounds> BlockBounds::bounds(const Branch& branch, double reach,
                                                       double span) const {
  const std::optional<Tensors> over = tensors(branch, reach, span);
  if (!over) return {};
  const MatrixXd middle = jacobian(branch.x, branch.centre);
  Bounds result;
  result.row_norm.assign(row_norm_.size(), 0);
  std::vector<double> off(problem_.velocities, 0);
  for (const Block& block : problem_.blocks)
    if (!add_block(block, middle, *over, result, off)) return {};
  return result;
}

/// e with (ω/2) e raised to 2^iterations equal to (ω/2) kEnd.
double BlockBounds::radius_within(double omega) const {
  if (!(omega > 0)) return INFINITY;
  return (1 - kMoved) * (2 / omega) * std::pow(omega / 2 * kEnd, std::ldexp(1.0, -problem_.iterations));
}

bool BlockBounds::include(const Branch& branch, double least) {
  const std::optional<Bounds> on = bounds(branch, 0);
  if (!on || on->contraction > kSmall || !(margin(on->determinant, on->row_norm) > least)) return false;
  if (!narrow(branch)) return false;
  for (std::size_t b = 0; b < determinant_.size(); ++b)
    determinant_[b] = std::min(determinant_[b], on->determinant[b]);
  for (std::size_t r = 0; r < row_norm_.size(); ++r) row_norm_[r] = std::max(row_norm_[r], on->row_norm[r]);
  isolate(branch);
  return true;
}

/// To the radius that holds on this box too.
bool BlockBounds::narrow(const Branch& branch) {
  for (double radius = radius_; radius >= kLeastRadius;) {
    const std::optional<Bounds> found = bounds(branch, kReach * radius);
    const double within = found ? radius_within(found->omega) : 0;
    if (within >= radius) {
      if (found->amplification * kEnd > kMoved * radius) return false;
      radius_ = radius;
      omega_ = std::max(omega_, found->omega);
      amplification_ = std::max(amplification_, found->amplification);
      return true;
    }
    radius = std::max(within, radius / (found ? 4 : 2));
  }
  return false;
}

/// At displacements of up to `reach` and on the way there; displacements of quaternions do not add up.
bool BlockBounds::is_isolated(const Branch& branch, double reach) const {
  return bounds(branch, reach) && (problem_.tangent.quaternions.empty() || bounds(branch, 0, reach));
}

void BlockBounds::isolate(const Branch& branch) {
  while (isolation_ > kReach * radius_ && !is_isolated(branch, isolation_)) isolation_ /= 2;
  isolation_ = std::max(isolation_, kReach * radius_);
}

/// A correction c of one block: e ≤ |c| (1 + θ)/(1 − θ) brings e within kReach radii, there e − |c| ≤ ω/2 e².
double BlockBounds::first_correction() const {
  constexpr double kFarthest = (1 - kContraction) / (1 + kContraction);
  const double curved = 1 - omega_ / 2 * kReach * radius_;
  const double share = std::max(kFarthest, std::min(kReach * kFarthest, curved));
  return (1 - 2 * kMoved) * share * radius_ * std::min(1.0, length_);
}

double BlockBounds::ends_within() const { return amplification_ * kEnd; }

}  // namespace jourdain::loops
