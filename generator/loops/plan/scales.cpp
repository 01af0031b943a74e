#include "loops/plan/scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "loops/plan/schur_solution.hpp"
#include "loops/rows/dense_solver.hpp"
#include "model/loop_kinds.hpp"
#include "reference/decompositions.hpp"
#include "reference/minimal.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;

/// Regularisation as a share of the largest entry of G M⁻¹ Gᵀ at the start, of rows with lengths: what
/// rounding allows, and what keeps multipliers bounded where singular configurations are passed again and again.
constexpr double kLeast = 1e-10, kBounding = 1e-7;

/// A row with a length that weighs less than this share of the heaviest one would lose what is seen.
constexpr long double kLight = 1e-3;

/// Regularisation as a share of the smallest singular value of G M⁻¹ Gᵀ, rows scaled, where it is largest.
constexpr double kHolding = 1e-4;

/// Smallest singular value, as a share of the largest entry, that the rounding of double leaves six digits of.
constexpr long double kDiscerned = 1e-10;

Matrix rows_of(const Matrix& G, const std::vector<std::size_t>& rows) {
  Matrix part(at(rows.size()), G.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) part.row(at(k)) = G.row(at(rows[k]));
  return part;
}

/// Which rows are lengths that tell how much a row weighs. What rolls may bind light bodies and heavy ones: there each
/// row weighs what it weighs.
std::vector<bool> telling_rows(const model::Mechanism& mechanism) {
  std::vector<bool> rows = length_rows(mechanism);
  if (model::binds_velocities(mechanism)) rows.assign(rows.size(), false);
  return rows;
}

/// How much a row that is next to nothing at the start, or holds bodies far heavier than others do, weighs at most; 0
/// where it is next to nothing wherever the mechanism was seen, because others hold what it would.
Vector greatest_weights(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                        const std::vector<Matrix>& jacobians) {
  Vector weights = Vector::Zero(jacobians.front().rows()), lengths = weights;
  for (std::size_t k = 0; k < configurations.size(); ++k) {
    weights = weights.cwiseMax(schur_matrix(mechanism, configurations[k], jacobians[k]).diagonal());
    lengths = lengths.cwiseMax(jacobians[k].rowwise().norm());
  }
  for (Eigen::Index r = 0; r < weights.size(); ++r)
    if (!(lengths[r] > kRankTolerance * lengths.maxCoeff())) weights[r] = 0;
  return weights;
}

void set_row_lengths(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                     const std::vector<Matrix>& jacobians, LoopPlan& plan) {
  const Vector S = schur_matrix(mechanism, configurations.front(), jacobians.front()).diagonal();
  const std::vector<bool> is_length = telling_rows(mechanism);
  long double largest = 0;
  for (std::size_t r = 0; r < is_length.size(); ++r)
    if (is_length[r]) largest = std::max(largest, S[at(r)]);
  if (!(largest > 0)) largest = S.maxCoeff();
  std::optional<Vector> anywhere;
  for (std::size_t r = 0; r < is_length.size(); ++r) {
    const long double light = (is_length[r] ? kLight : kRankTolerance) * largest;
    long double weight = S[at(r)];
    if (weight < light) {
      if (!anywhere) anywhere = greatest_weights(mechanism, configurations, jacobians);
      weight = (*anywhere)[at(r)];
    }
    const bool scaled = weight > 0 && (!is_length[r] || weight < light);
    plan.row_length.push_back(scaled ? static_cast<double>(std::sqrt(largest / weight)) : 1);
  }
  const bool bounds =
      plan.is_named && plan.redundant.empty();  // rows that are chosen may be weak where others hold
  plan.regularisation = (bounds ? kBounding : kLeast) * static_cast<double>(largest);
  plan.closing_regularisation = kLeast * static_cast<double>(largest);
  plan.corrections = bounds ? 2 : 1;
}

}  // namespace

Matrix schur_matrix(const model::Mechanism& mechanism, const Configuration& at_state, const Matrix& G) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  reference::State<long double> state{at_state.t, at_state.y, Vector::Zero(at(layout.velocity_count()))};
  const auto terms =
      reference::Reference<long double>(mechanism).evaluate(state, Vector::Zero(at(layout.input_count())));
  return G * reference::solved_by_ldlt<long double>(terms.M, Matrix(G.transpose()));
}

void set_scales(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                const std::vector<Matrix>& jacobians, bool is_regular, LoopPlan& plan) {
  if (is_regular)
    set_row_lengths(mechanism, configurations, jacobians, plan);
  else
    plan.row_length.assign(static_cast<std::size_t>(jacobians.front().rows()), 1);
}

namespace {

bool limit_regularisation(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                          const std::vector<Matrix>& jacobians, LoopPlan& plan,
                          support::Diagnostics& diagnostics) {
  const std::vector<std::size_t> rows = plan.solved_rows();
  if (rows.empty() || !(plan.closing_regularisation > 0)) return true;
  Vector lengths(at(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) lengths[at(k)] = plan.row_length[rows[k]];
  long double smallest = 0;
  for (std::size_t k = 0; k < configurations.size(); ++k) {
    const Matrix S = schur_matrix(mechanism, configurations[k], rows_of(jacobians[k], rows));
    if (!S.allFinite()) continue;
    const Vector values =
        reference::singular_values<long double>(Matrix(lengths.asDiagonal() * S * lengths.asDiagonal()));
    smallest = std::max(smallest, values.minCoeff());
  }
  const long double largest = plan.closing_regularisation / kLeast;
  plan.weakest = static_cast<double>(smallest / largest);
  if (smallest < kDiscerned * largest) {
    diagnostics.error(
        mechanism.loop_options.where,
        fmt::format(
            "multipliers cannot hold these constraints: in double they do not tell the weakest from nothing "
            "({:.1g} of the strongest, by G M^-1 G^T); masses, units or directions are too far apart{}",
            plan.weakest, plan.reason.empty() ? "" : fmt::format("; no other treatment: {}", plan.reason)),
        "leave out what weighs next to nothing, or constraints that others nearly fulfil");
    return false;
  }
  const double least = kHolding * static_cast<double>(smallest);
  plan.regularisation = std::min(plan.regularisation, least);
  plan.closing_regularisation = std::min(plan.closing_regularisation, least);
  return true;
}

void set_sharing_lengths(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                         const std::vector<Matrix>& jacobians, LoopPlan& plan) {
  const Vector largest = greatest_weights(mechanism, configurations, jacobians);
  const std::vector<bool> is_length = telling_rows(mechanism);
  const long double size = plan.closing_regularisation / kLeast;
  for (const std::size_t r : plan.sharing) {
    const bool scaled = largest[at(r)] > 0 && (!is_length[r] || largest[at(r)] < kLight * size);
    plan.row_length[r] = scaled ? static_cast<double>(std::sqrt(size / largest[at(r)])) : 1;
  }
}

}  // namespace

bool set_scales_of_multipliers(const model::Mechanism& mechanism,
                               const std::vector<Configuration>& configurations,
                               const std::vector<Matrix>& jacobians, LoopPlan& plan,
                               support::Diagnostics& diagnostics) {
  if (plan.sharing.empty())
    return limit_regularisation(mechanism, configurations, jacobians, plan, diagnostics);
  set_sharing_lengths(mechanism, configurations, jacobians, plan);
  return true;
}

namespace {

/// What SchurFactors::determinant is without regularisation.
long double multiplier_determinant(const LoopPlan& plan, const Matrix& S) {
  const ExactMatrix exact = S.cast<double>().cast<ScaledReal>();
  return static_cast<long double>(SchurSolution(plan, plan.solved_rows(), exact, 0).determinant());
}

}  // namespace

void set_determinant(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                     const std::vector<Matrix>& jacobians, LoopPlan& plan) {
  long double largest = 0;
  for (std::size_t k = 0; k < jacobians.size(); ++k) {
    const long double determinant =
        plan.is_reduced()
            ? block_determinant(plan, jacobians[k])
            : multiplier_determinant(plan, schur_matrix(mechanism, configurations[k],
                                                        rows_of(jacobians[k], plan.solved_rows())));
    largest = std::max(largest, std::abs(determinant));
  }
  const bool negative = plan.is_reduced() && block_determinant(plan, jacobians.front()) < 0;
  plan.determinant = static_cast<double>(negative ? -largest : largest);
}

long double block_determinant(const LoopPlan& plan, const Matrix& G) {
  long double product = 1;
  for (const Block& block : plan.blocks) {
    const Matrix D = rows_of(G, block.rows)(Eigen::all, block.dependents);
    const auto determinant = reference::determinant<long double>(D);
    product *=
        block.rows.size() <= DenseSolver::kLargestByCofactors ? determinant : determinant * determinant;
  }
  return product;
}

}  // namespace jourdain::loops
