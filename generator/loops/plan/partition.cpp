#include "loops/plan/partition.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "loops/rows/regular_rows.hpp"
#include "reference/decompositions.hpp"
#include "support/check.hpp"
#include "support/matrix_index.hpp"
#include "support/uniform.hpp"

namespace jourdain::loops {

namespace {

using support::at;

/// A preferred partition may be conditioned this much worse.
constexpr double kPreference = 4;

/// Columns, then rows, divided by the largest entry that they have anywhere: units no longer matter.
std::vector<Matrix> equilibrated(std::vector<Matrix> jacobians) {
  const Matrix& first = jacobians.front();
  Matrix largest = Matrix::Zero(first.rows(), first.cols());
  for (const Matrix& G : jacobians) largest = largest.cwiseMax(G.cwiseAbs());
  for (Eigen::Index k = 0; k < first.cols(); ++k) {
    const long double size = largest.col(k).size() == 0 ? 0 : largest.col(k).maxCoeff();
    if (!(size > 0)) continue;
    for (Matrix& G : jacobians) G.col(k) /= size;
    largest.col(k) /= size;
  }
  for (Eigen::Index r = 0; r < largest.rows(); ++r)
    for (Matrix& G : jacobians) G.row(r) /= largest.row(r).maxCoeff();
  return jacobians;
}

/// How well dependent velocities follow from the others at given configurations.
class Conditioning {
 public:
  explicit Conditioning(const std::vector<Matrix>& jacobians) {
    for (const Matrix& G : equilibrated(jacobians)) {
      jacobians_.push_back(G.cast<double>());
      largest_.push_back(G.size() == 0 ? 0 : reference::singular_values<double>(jacobians_.back())[0]);
    }
  }

  /// Smallest singular value of the dependent columns over the largest of all columns, the worst of all; G
  /// equilibrated. All columns count: otherwise a single dependent coordinate would never be conditioned
  /// badly. 0 where the determinant changes its sign: between such configurations the block is singular. Stops
  /// below `enough`.
  double operator()(const std::vector<std::size_t>& dependents, double enough = 0) {
    double worst = 1;
    std::optional<bool> sign;
    for (std::size_t k = 0; k < jacobians_.size(); ++k) {
      const Dense block = jacobians_[k](Eigen::all, dependents);
      if (block.size() == 0) continue;
      work_ += std::pow(static_cast<double>(block.rows()), 3);
      const bool positive = reference::determinant<double>(block) > 0;
      if (!sign) sign = positive;
      if (*sign != positive) return 0;
      const double smallest = reference::singular_values<double>(block).tail(1)[0];
      worst = std::min(worst, largest_[k] > 0 ? smallest / largest_[k] : 0);
      if (worst < enough) return worst;
    }
    return worst;
  }

  /// Has a search taken all the effort that it may? Counted in operations, so that the result is the same everywhere.
  bool is_exhausted() const { return work_ > kMostWork; }

 private:
  using Dense = Eigen::MatrixXd;
  static constexpr double kMostWork = 2e8;

  std::vector<Dense> jacobians_;
  std::vector<double> largest_;
  double work_ = 0;
};

/// The columns that pivoting takes at the first configuration: where there are many choices one that is not bad.
std::vector<std::size_t> pivots(const Matrix& G) {
  if (G.rows() == 0) return {};
  const std::vector<Eigen::Index> order = reference::pivoted_columns<long double>(G);
  std::vector<std::size_t> columns(order.begin(), order.begin() + G.rows());
  std::sort(columns.begin(), columns.end());
  return columns;
}

/// Strongly connected components of a directed graph (Tarjan), in an order in which edges lead to earlier ones.
class Components {
 public:
  explicit Components(const std::vector<std::vector<std::size_t>>& edges)
      : edges_(edges), index_(edges.size(), 0), low_(edges.size(), 0), open_(edges.size(), false) {
    for (std::size_t v = 0; v < edges.size(); ++v)
      if (index_[v] == 0) visit(v);
  }
  const std::vector<std::vector<std::size_t>>& list() const { return list_; }

 private:
  void visit(std::size_t v) {
    index_[v] = low_[v] = ++count_;
    stack_.push_back(v);
    open_[v] = true;
    for (const std::size_t w : edges_[v]) {
      if (index_[w] == 0) visit(w);
      if (open_[w]) low_[v] = std::min(low_[v], low_[w]);
    }
    if (low_[v] != index_[v]) return;
    std::vector<std::size_t>& component = list_.emplace_back();
    while (open_[v]) {
      component.push_back(stack_.back());
      open_[stack_.back()] = false;
      stack_.pop_back();
    }
    std::sort(component.begin(), component.end());
  }

  const std::vector<std::vector<std::size_t>>& edges_;
  std::vector<std::size_t> index_, low_, stack_;
  std::vector<bool> open_;
  std::vector<std::vector<std::size_t>> list_;
  std::size_t count_ = 0;
};

}  // namespace

Groups velocity_groups(const model::Mechanism& mechanism) {
  const model::Tangent tangent = model::lay_out_coordinates(mechanism).tangent;
  Groups groups;
  for (const model::Tangent::Scalar& s : tangent.scalars) groups.push_back({s.velocity});
  for (const model::Tangent::Scalar& s : tangent.quaternions)
    groups.push_back({s.velocity, s.velocity + 1, s.velocity + 2});
  std::sort(groups.begin(), groups.end());
  return groups;
}

std::vector<Block> triangular_blocks(const std::vector<Matrix>& jacobians,
                                     const std::vector<std::size_t>& dependents) {
  const std::size_t n = dependents.size();
  std::vector<std::vector<std::size_t>> columns_of(n);  // of each row, positions in `dependents`
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c)
      if (std::any_of(jacobians.begin(), jacobians.end(),
                      [&](const Matrix& G) { return G(at(r), at(dependents[c])) != 0; }))
        columns_of[r].push_back(c);
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> row_of(n, kNone);  // a perfect matching, by augmenting paths
  for (std::size_t r = 0; r < n; ++r) {
    std::vector<bool> seen(n, false);
    const std::function<bool(std::size_t)> augment = [&](std::size_t row) {
      for (const std::size_t c : columns_of[row]) {
        if (seen[c]) continue;
        seen[c] = true;
        if (row_of[c] != kNone && !augment(row_of[c])) continue;
        row_of[c] = row;
        return true;
      }
      return false;
    };
    if (!augment(r)) return {};
  }
  std::vector<std::size_t> column_of(n);
  for (std::size_t c = 0; c < n; ++c) column_of[row_of[c]] = c;
  std::vector<std::vector<std::size_t>> needs(n);  // rows that determine the other columns of a row
  for (std::size_t r = 0; r < n; ++r)
    for (const std::size_t c : columns_of[r])
      if (c != column_of[r]) needs[r].push_back(row_of[c]);
  std::vector<Block> blocks;
  const Components components(needs);
  for (const std::vector<std::size_t>& component : components.list()) {
    Block& block = blocks.emplace_back();
    block.rows = component;
    for (const std::size_t r : component) block.dependents.push_back(dependents[column_of[r]]);
    std::sort(block.dependents.begin(), block.dependents.end());
  }
  return blocks;
}

std::vector<Matrix> open_rows(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                              const std::vector<Configuration>& configurations,
                              const std::vector<std::size_t>& rows) {
  constexpr double kOff = 0.1;
  constexpr std::size_t kSeen = 4;
  support::Uniform uniform(29);
  std::vector<double> parameters = model::default_values(mechanism);
  for (double& value : parameters) value += kOff * uniform(-1, 1) * (1 + std::fabs(value));
  const NumericClosure closure(mechanism, constraints, parameters);
  std::vector<Matrix> jacobians;
  for (std::size_t k = 0; k < std::min(kSeen, configurations.size()); ++k) {
    Vector off(at(closure.velocity_count()));
    for (long double& entry : off) entry = kOff * uniform(-1, 1);
    jacobians.push_back(closure.jacobian(closure.displaced(configurations[k], off))(rows, Eigen::all));
  }
  return jacobians;
}

std::optional<Partition> given_partition(const std::vector<Matrix>& jacobians,
                                         const std::vector<Matrix>& structure,
                                         const std::vector<std::size_t>& independent) {
  const Matrix& G = jacobians.front();
  const std::vector<std::size_t> dependents = all_but(independent, static_cast<std::size_t>(G.cols()));
  if (at(dependents.size()) != G.rows()) return {};
  Partition partition{independent, triangular_blocks(structure, dependents),
                      Conditioning(jacobians)(dependents)};
  std::sort(partition.independent.begin(), partition.independent.end());
  if (partition.blocks.empty() && !dependents.empty()) partition.conditioning = 0;
  return partition;
}

bool is_dead(const Matrix& G, const std::vector<Block>& blocks) {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) {
    const Vector sigma = reference::singular_values<long double>(G(block.rows, block.dependents));
    return !(sigma.minCoeff() > kRankTolerance * sigma.maxCoeff());
  });
}

namespace {

/// Does the choice take all velocities of a group or none?
bool is_whole(const std::vector<std::size_t>& chosen, const Groups& groups) {
  return std::all_of(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& group) {
    const auto count = std::count_if(group.begin(), group.end(), [&](std::size_t k) {
      return std::find(chosen.begin(), chosen.end(), k) != chosen.end();
    });
    return count == 0 || count == static_cast<std::ptrdiff_t>(group.size());
  });
}

}  // namespace

std::optional<Partition> choose_partition(const std::vector<Matrix>& jacobians,
                                          const std::vector<Matrix>& structure, const Groups& groups,
                                          const std::vector<bool>& preferred) {
  const auto columns = static_cast<std::size_t>(jacobians.front().cols());
  const auto freedom = columns - static_cast<std::size_t>(jacobians.front().rows());
  Conditioning conditioning(jacobians);
  std::vector<std::size_t> best, chosen;
  double best_score = 0, best_conditioning = 0;
  const auto consider = [&](const std::vector<std::size_t>& independent) {
    std::size_t liked = 0;
    for (const std::size_t k : independent) liked += preferred[k];
    const double weight = liked == freedom ? kPreference : 1;
    const double found = conditioning(all_but(independent, columns), best_score / weight);
    if (!(found * weight > best_score)) return;
    best = independent;
    best_score = found * weight;
    best_conditioning = found;
  };
  const std::vector<std::size_t> pivoted = all_but(pivots(equilibrated(jacobians).front()), columns);
  if (is_whole(pivoted, groups)) consider(pivoted);
  const std::function<void(std::size_t)> choose = [&](std::size_t group) {
    if (conditioning.is_exhausted()) return;
    if (chosen.size() == freedom) return consider(chosen);
    const bool too_few =
        group == groups.size() || chosen.size() + (columns - groups[group].front()) < freedom;
    if (too_few) return;
    if (chosen.size() + groups[group].size() <= freedom) {
      chosen.insert(chosen.end(), groups[group].begin(), groups[group].end());
      choose(group + 1);
      chosen.resize(chosen.size() - groups[group].size());
    }
    choose(group + 1);
  };
  choose(0);
  if (!(best_conditioning > 0)) return {};
  return given_partition(jacobians, structure, best);
}

}  // namespace jourdain::loops
