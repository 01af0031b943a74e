#include "support/matrix_index.hpp"
#include "validate/loops/loop_oracle.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

using ir::LeafKind;

namespace {

using support::at;

class Evaluation {
 public:
  Evaluation(const LoopScene& scene, const ir::LeafValues<ScaledReal>& state)
      : scene_(scene), state_(state), n_(scene.closure.velocity_count()) {
    const dynamics::ClosureJacobian jacobian = scene.closure.jacobian(state);
    e_.G = to_exact(jacobian.G, n_);
    if (scene.plan.is_reduced())
      reduce(to_exact(jacobian.g_t));
    else
      take_all();
    const dynamics::ClosureMotion motion = scene.closure.motion(state, to_list(e_.z));
    e_.g = to_exact(motion.g);
    e_.rate = to_exact(motion.rate);
    e_.gamma = to_exact(motion.gamma);
    e_.beta = ExactVector::Zero(at(n_));
    if (scene.plan.is_reduced()) e_.beta = dependents(-e_.gamma, e_.beta);
    evaluate_tree();
  }

  ExactMotion result() && { return std::move(e_); }

 private:
  void take_all() {
    e_.z = to_exact(state_[LeafKind::kVelocity]);
    e_.B = ExactMatrix::Identity(at(n_), at(n_));
    e_.b = ExactVector::Zero(at(n_));
  }

  /// Solves G x = right for the dependent entries.
  ExactVector dependents(const ExactVector& right, ExactVector known) const {
    const auto& columns = scene_.closure.dependents();
    if (columns.empty()) return known;
    const ExactVector rest = right - e_.G * known;
    const ExactVector solution = solved(e_.G(scene_.plan.rows, columns), ExactVector(rest(scene_.plan.rows)));
    known(columns) = solution;
    return known;
  }

  void reduce(const ExactVector& g_t) {
    const std::vector<std::size_t>& independent = scene_.plan.independent;
    const ExactVector nothing = ExactVector::Zero(e_.G.rows());
    e_.b = dependents(-g_t, ExactVector::Zero(at(n_)));
    e_.B.resize(at(n_), at(independent.size()));
    for (std::size_t j = 0; j < independent.size(); ++j)
      e_.B.col(at(j)) = dependents(nothing, ExactVector::Unit(at(n_), at(independent[j])));
    e_.z = e_.B * to_exact(state_[LeafKind::kVelocity]) + e_.b;
  }

  void evaluate_tree() {
    const dynamics::Equations& equations = scene_.equations;
    ir::LeafValues<ScaledReal> tree = state_;
    tree[LeafKind::kVelocity] = to_list(e_.z);
    const dynamics::HighPrecision exact(equations.statements, leaves_at(tree));
    e_.M.resize(at(n_), at(n_));
    for (std::size_t i = 0; i < n_; ++i) e_.M.row(at(i)) = to_exact(exact.values(equations.M[i])).transpose();
    e_.k = to_exact(exact.values(equations.k_bar));
    e_.q = to_exact(exact.values(equations.q_bar));
    e_.kinetic_energy = exact.value(equations.kinetic_energy);
    e_.potential_energy = exact.value(equations.potential_energy);
    for (ScaledReal& u : tree[LeafKind::kInput]) u = 0;
    e_.q_without_inputs =
        to_exact(dynamics::HighPrecision(equations.statements, leaves_at(tree)).values(equations.q_bar));
  }

  const LoopScene& scene_;
  const ir::LeafValues<ScaledReal>& state_;
  std::size_t n_;
  ExactMotion e_;
};

}  // namespace

ExactMotion exact_motion(const LoopScene& scene, const ir::LeafValues<ScaledReal>& state) {
  return Evaluation(scene, state).result();
}

}  // namespace jourdain::validate
