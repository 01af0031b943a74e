#include "loops/plan/scales.hpp"

#include <algorithm>
#include <cmath>

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

Matrix rows_of(const Matrix& G, const std::vector<std::size_t>& rows) {
  Matrix part(at(rows.size()), G.cols());
  for (std::size_t k = 0; k < rows.size(); ++k) part.row(at(k)) = G.row(at(rows[k]));
  return part;
}

/// Which rows are lengths that tell how much a row weighs. What rolls may bind light bodies and heavy ones: there each
/// row weighs what it weighs.
std::vector<bool> lengths_of(const model::Mechanism& mechanism) {
  std::vector<bool> is_length;
  const bool tells = !model::binds_velocities(mechanism);
  for (const model::Loop& loop : mechanism.loops)
    for (const model::LoopRow& row : model::loop_kind(loop.type).rows)
      is_length.push_back(tells && row.is_length);
  return is_length;
}

void set_row_lengths(const model::Mechanism& mechanism, const Vector& S, LoopPlan& plan) {
  const std::vector<bool> is_length = lengths_of(mechanism);
  long double largest = 0;
  for (std::size_t r = 0; r < is_length.size(); ++r)
    if (is_length[r]) largest = std::max(largest, S[at(r)]);
  if (!(largest > 0)) largest = S.maxCoeff();
  for (std::size_t r = 0; r < is_length.size(); ++r) {
    const bool scaled = !is_length[r] && S[at(r)] > kRankTolerance * largest;
    plan.row_length.push_back(scaled ? static_cast<double>(std::sqrt(largest / S[at(r)])) : 1);
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

void set_scales(const model::Mechanism& mechanism, const Configuration& start, const Matrix& G,
                bool is_regular, LoopPlan& plan) {
  if (is_regular)
    set_row_lengths(mechanism, schur_matrix(mechanism, start, G).diagonal(), plan);
  else
    plan.row_length.assign(static_cast<std::size_t>(G.rows()), 1);
}

void set_sharing_lengths(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                         const std::vector<Matrix>& jacobians, LoopPlan& plan) {
  Vector largest = Vector::Zero(at(plan.row_length.size()));
  for (std::size_t k = 0; k < configurations.size(); ++k)
    largest = largest.cwiseMax(schur_matrix(mechanism, configurations[k], jacobians[k]).diagonal());
  const std::vector<bool> is_length = lengths_of(mechanism);
  const long double size = plan.closing_regularisation / kLeast;
  for (const std::size_t r : plan.sharing)
    plan.row_length[r] = is_length[r] ? 1 : static_cast<double>(std::sqrt(size / largest[at(r)]));
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
