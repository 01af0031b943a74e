#include "reference/massless.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jourdain::reference {

namespace {

constexpr int kStates = 4;

/// What rounding in long double leaves of a pivot that vanishes, of its row's term sum.
constexpr long double kRounding = 1e-18L;

/// State number `number`, at rest; the golden ratio's multiples keep the coordinates off symmetric positions.
State<long double> scattered_state(const model::CoordinateLayout& layout, int number) {
  State<long double> state{.t = 0,
                           .y = VectorX<long double>(Eigen::Index(layout.position_count())),
                           .z = VectorX<long double>::Zero(Eigen::Index(layout.velocity_count()))};
  for (Eigen::Index i = 0; i < state.y.size(); ++i) {
    const long double step = 0.6180339887498948482L * static_cast<long double>((i + 1) * (number + 1));
    state.y[i] = 6 * (step - std::floor(step)) - 3;
  }
  for (const std::size_t q : layout.quaternions) state.y.segment<4>(Eigen::Index(q)).normalize();
  return state;
}

/// For each coordinate whether its pivot in `M` is at most `limit`. A pivot that is at most `least` has its
/// row left out of the elimination.
std::vector<bool> pivots_below(const MatrixX<long double>& M, const VectorX<long double>& limit,
                               const VectorX<long double>& least) {
  MatrixX<long double> A = M;
  std::vector<bool> below(std::size_t(A.rows()), false);
  for (Eigen::Index k = A.rows() - 1; k >= 0; --k) {
    below[std::size_t(k)] = A(k, k) <= limit[k];
    if (A(k, k) <= least[k]) continue;
    const VectorX<long double> column = A.col(k).head(k);
    A.topLeftCorner(k, k) -= column * column.transpose() / A(k, k);
  }
  return below;
}

std::vector<bool> vanishing_pivots(const MatrixX<long double>& M, const VectorX<long double>& least) {
  return pivots_below(M, least, least);
}

/// Terms of the equations at a scattered state, without inputs.
Terms<long double> scattered_terms(const model::Mechanism& mechanism, int number) {
  const Reference<long double> reference(mechanism);
  return reference.evaluate(scattered_state(model::lay_out_coordinates(mechanism), number),
                            VectorX<long double>::Zero(Eigen::Index(reference.input_count())));
}

/// Joints with a marked velocity, in the order of the coordinates.
std::vector<model::JointIndex> joints_of(const model::Mechanism& mechanism, const std::vector<bool>& marked) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<model::JointIndex> found;
  for (const model::JointIndex index : model::moving_joints(mechanism)) {
    const model::JointEntries& entries = layout.joints[index.value];
    const auto first = marked.begin() + std::ptrdiff_t(entries.first_velocity);
    if (std::any_of(first, first + std::ptrdiff_t(entries.velocity_count), [](bool m) { return m; }))
      found.push_back(index);
  }
  return found;
}

}  // namespace

std::vector<model::JointIndex> massless_joints(const model::Mechanism& mechanism) {
  std::vector<bool> massless(model::lay_out_coordinates(mechanism).velocity_count(), true);
  for (int number = 0; number < kStates; ++number) {
    const Terms<long double> terms = scattered_terms(mechanism, number);
    const std::vector<bool> vanishing = vanishing_pivots(terms.M, kMasslessPivot * terms.M_scale.diagonal());
    for (std::size_t i = 0; i < massless.size(); ++i) massless[i] = massless[i] && vanishing[i];
  }
  return joints_of(mechanism, massless);
}

std::vector<model::JointIndex> negative_joints(const model::Mechanism& mechanism) {
  std::vector<bool> negative(model::lay_out_coordinates(mechanism).velocity_count(), false);
  for (int number = 0; number < kStates; ++number) {
    const Terms<long double> terms = scattered_terms(mechanism, number);
    const VectorX<long double> rounding = kMasslessPivot * terms.M_scale.diagonal();
    const std::vector<bool> below =
        pivots_below(terms.M, -rounding.array() - std::numeric_limits<long double>::min(), rounding);
    for (std::size_t i = 0; i < negative.size(); ++i) negative[i] = negative[i] || below[i];
  }
  return joints_of(mechanism, negative);
}

std::vector<model::JointIndex> singular_joints(const model::Mechanism& mechanism,
                                               const State<long double>& state) {
  const Reference<long double> reference(mechanism);
  const auto terms =
      reference.evaluate(state, VectorX<long double>::Zero(Eigen::Index(reference.input_count())));
  const VectorX<long double> size = terms.M_scale.diagonal();
  VectorX<long double> least = kRounding * size;
  // Other states cost as much as this one; they matter where some entry is tiny.
  if (size.size() > 0 && size.minCoeff() <= kSingularPivot * size.maxCoeff())
    for (int number = 0; number < kStates; ++number)
      least = least.cwiseMax(kSingularPivot * scattered_terms(mechanism, number).M_scale.diagonal());
  return joints_of(mechanism, vanishing_pivots(terms.M, least));
}

}  // namespace jourdain::reference
