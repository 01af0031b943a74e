#include "dynamics/factorisation.hpp"

#include <fmt/format.h>

#include "kinematics/link_tree.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;
using kinematics::kGround;

std::vector<Ex> solve_mass_matrix(const std::vector<std::vector<Ex>>& M, const std::vector<Ex>& b,
                                  const std::vector<std::size_t>& parent,
                                  kinematics::Statements& statements) {
  const std::size_t n = b.size();
  std::vector<std::vector<Ex>> H = M;  // remainder of M
  std::vector<std::vector<Ex>> L(n, std::vector<Ex>(n, 0));
  std::vector<Ex> inverse_D(n), x = b;
  for (std::size_t k = n; k-- > 0;) {
    inverse_D[k] = statements.bind(fmt::format("invD_{}", k), 1 / H[k][k]);
    for (std::size_t i = parent[k]; i != kGround; i = parent[i]) {
      if (H[k][i].is_zero()) continue;
      L[k][i] = statements.bind(fmt::format("L_{}_{}", k, i), H[k][i] * inverse_D[k]);
      for (std::size_t j = i; j != kGround; j = parent[j])
        H[i][j] = statements.bind(fmt::format("H{}_{}_{}", k, i, j), H[i][j] - L[k][i] * H[k][j]);
    }
    for (std::size_t i = parent[k]; i != kGround; i = parent[i])
      x[i] = statements.bind(fmt::format("x{}_{}", k, i), x[i] - L[k][i] * x[k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    Ex sum = statements.bind(fmt::format("y_{}", k), inverse_D[k] * x[k]);
    for (std::size_t i = parent[k]; i != kGround; i = parent[i]) sum = sum - L[k][i] * x[i];
    x[k] = statements.bind(fmt::format("zdot_{}", k), sum);
  }
  return x;
}

}  // namespace jourdain::dynamics
