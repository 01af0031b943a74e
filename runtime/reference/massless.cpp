#include "reference/massless.hpp"

#include <algorithm>
#include <cmath>

#include "reference/minimal.hpp"

namespace jourdain::reference {

namespace {

constexpr int kStates = 4;

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

/// For each coordinate whether its pivot vanishes. A vanished pivot's row is left out of the elimination.
std::vector<bool> vanishing_pivots(const Terms<long double>& terms) {
  MatrixX<long double> A = terms.M;
  std::vector<bool> vanishing(std::size_t(A.rows()), false);
  for (Eigen::Index k = A.rows() - 1; k >= 0; --k) {
    vanishing[std::size_t(k)] = A(k, k) <= kMasslessPivot * terms.M_scale(k, k);
    if (vanishing[std::size_t(k)]) continue;
    const VectorX<long double> column = A.col(k).head(k);
    A.topLeftCorner(k, k) -= column * column.transpose() / A(k, k);
  }
  return vanishing;
}

}  // namespace

std::vector<model::JointIndex> massless_joints(const model::Mechanism& mechanism) {
  const Reference<long double> reference(mechanism);
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const VectorX<long double> no_input = VectorX<long double>::Zero(Eigen::Index(reference.input_count()));
  std::vector<bool> massless(layout.velocity_count(), true);
  for (int number = 0; number < kStates; ++number) {
    const std::vector<bool> vanishing =
        vanishing_pivots(reference.evaluate(scattered_state(layout, number), no_input));
    for (std::size_t i = 0; i < massless.size(); ++i) massless[i] = massless[i] && vanishing[i];
  }
  std::vector<model::JointIndex> found;
  for (const model::JointIndex index : model::moving_joints(mechanism)) {
    const model::JointEntries& entries = layout.joints[index.value];
    const auto first = massless.begin() + std::ptrdiff_t(entries.first_velocity);
    if (std::any_of(first, first + std::ptrdiff_t(entries.velocity_count), [](bool m) { return m; }))
      found.push_back(index);
  }
  return found;
}

}  // namespace jourdain::reference
