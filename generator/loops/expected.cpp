#include "loops/expected.hpp"

#include <cmath>

namespace jourdain::loops {

using dynamics::OutputValues;
using kinematics::LeafKind;

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

Vector lengths_of(const LoopPlan& plan) {
  return Eigen::Map<const Eigen::VectorXd>(plan.row_length.data(), at(plan.row_length.size()))
      .cast<long double>();
}

Matrix values_of(const OutputValues& member, const dynamics::HighPrecision& exact) {
  Matrix values(member.rows, member.columns);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      values(i, j) =
          dynamics::to_double(exact.value(member.values[static_cast<std::size_t>(i * values.cols() + j)]));
  return values;
}

/// J_t, J_r, v̄, ω̄, ā, ζ̄ of the tree in terms of the independent velocities.
void reduce(std::vector<Matrix>& jacobian, const TreeMotion& motion) {
  for (std::size_t k : {0, 1}) {
    jacobian[2 + k] += jacobian[k] * motion.b;
    jacobian[4 + k] += jacobian[k] * motion.beta;
    jacobian[k] = jacobian[k] * motion.B;
  }
}

}  // namespace

Spread spread_of(const LoopPlan& plan, const Matrix& G, const Matrix& M) {
  const Matrix scaled = lengths_of(plan).asDiagonal() * G;
  const Vector sigma = Eigen::JacobiSVD<Matrix>(scaled * M.ldlt().solve(scaled.transpose())).singularValues();
  Spread spread{sigma[0], sigma[0]};
  for (const long double s : sigma)
    if (s > kRankTolerance * sigma[0]) spread.smallest = std::min(spread.smallest, s);
  spread.is_singular = spread.smallest < 1e3L * plan.regularisation;
  spread.lost_share = std::pow(plan.regularisation / spread.smallest, plan.corrections + 1);
  return spread;
}

TreeMotion tree_motion(const LoopPlan& plan, const Matrix& M, const Matrix& G, const Vector& forces,
                       const Vector& gamma, TreeMotion known) {
  if (plan.is_reduced()) {
    const Matrix& B = known.B;
    known.zdot = known.beta;
    if (B.cols() > 0)
      known.zdot += B * (B.transpose() * M * B).ldlt().solve(B.transpose() * (forces - M * known.beta));
    Matrix regular(at(plan.rows.size()), G.cols());
    for (std::size_t r = 0; r < plan.rows.size(); ++r) regular.row(at(r)) = G.row(at(plan.rows[r]));
    const Vector lambda = least_norm(regular.transpose(), forces - M * known.zdot);
    known.lambda = Vector::Zero(G.rows());
    for (std::size_t r = 0; r < plan.rows.size(); ++r) known.lambda[at(plan.rows[r])] = lambda[at(r)];
    return known;
  }
  const Vector length = lengths_of(plan);
  const Matrix scaled = length.asDiagonal() * G;
  const auto factors = M.ldlt();
  const Vector free = factors.solve(forces);
  known.lambda = length.cwiseProduct(
      least_norm(scaled * factors.solve(scaled.transpose()), scaled * free + length.cwiseProduct(gamma)));
  known.zdot = free - factors.solve(G.transpose() * known.lambda);
  return known;
}

std::vector<Vector> expected_outputs(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                                     const LoopPlan& plan, const TreeMotion& motion,
                                     const dynamics::LeafValue& leaf) {
  const dynamics::HighPrecision exact(equations.statements, [&](LeafKind kind, std::size_t i) {
    if (kind == LeafKind::kAcceleration) return static_cast<double>(motion.zdot[at(i)]);
    if (kind == LeafKind::kMultiplier) return static_cast<double>(motion.lambda[at(i)]);
    return leaf(kind, i);
  });
  std::vector<Vector> outputs;
  for (std::size_t k = 0; k < mechanism.outputs.size(); ++k) {
    std::vector<Matrix> members;
    for (const OutputValues& member : equations.outputs[k]) members.push_back(values_of(member, exact));
    if (plan.is_reduced() && mechanism.outputs[k].kind == model::OutputKind::kJacobian)
      reduce(members, motion);
    Eigen::Index size = 0;
    for (const Matrix& member : members) size += member.size();
    Vector& numbers = outputs.emplace_back(size);
    Eigen::Index next = 0;
    for (const Matrix& member : members)
      for (Eigen::Index i = 0; i < member.rows(); ++i)
        for (Eigen::Index j = 0; j < member.cols(); ++j) numbers[next++] = member(i, j);
  }
  return outputs;
}

}  // namespace jourdain::loops
