#include "loops/motion_at_state.hpp"

#include <algorithm>

#include "dynamics/closure_motion.hpp"
#include "kinematics/numbers.hpp"
#include "model/checks.hpp"

namespace jourdain::loops {

using dynamics::HighPrecision;
using dynamics::to_double;

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

class Evaluation {
 public:
  Evaluation(const model::Mechanism& mechanism, const dynamics::Equations& equations,
             const dynamics::Equations& closures, const LoopPlan& plan, const Ray& ray)
      : mechanism_(mechanism),
        equations_(equations),
        closures_(closures),
        plan_(plan),
        ray_(ray),
        layout_(model::lay_out_coordinates(mechanism)),
        parameters_(model::default_values(mechanism)) {
    evaluate();
  }

  const MotionAtState& result() const { return e_; }

 private:
  dynamics::ClosureMotion closures_at(const Vector& z) const {
    return dynamics::closure_motion(
        closures_, model::tangent_of(mechanism_, layout_), layout_.velocity_count(),
        [&](kinematics::LeafKind kind, std::size_t i) { return leaf_value(parameters_, ray_, kind, i, z); });
  }

  void evaluate() {
    const std::size_t n = layout_.velocity_count();
    e_.z = Vector::Zero(at(n));
    e_.beta = e_.z;
    e_.B = Matrix::Identity(at(n), at(n));
    if (plan_.is_reduced())
      reduce();
    else
      for (std::size_t k = 0; k < n; ++k) e_.z[at(k)] = ray_.z[k];
    const dynamics::ClosureMotion motion = closures_at(e_.z);
    const std::size_t rows = motion.g.size();
    const auto vector = [](const std::vector<double>& v) {
      return Vector(Eigen::Map<const Eigen::VectorXd>(v.data(), at(v.size())).cast<long double>());
    };
    e_.g = vector(motion.g);
    e_.rate = vector(motion.rate);
    e_.gamma = vector(motion.gamma);
    e_.G.resize(at(rows), at(n));
    for (std::size_t r = 0; r < rows; ++r) e_.G.row(at(r)) = vector(motion.G[r]).transpose();
    if (plan_.is_reduced()) e_.beta = dependents(-e_.gamma, e_.beta);
    const HighPrecision exact(equations_.statements, [&](kinematics::LeafKind kind, std::size_t i) {
      return leaf_value(parameters_, ray_, kind, i, e_.z);
    });
    e_.M.resize(at(n), at(n));
    e_.k.resize(at(n));
    e_.q.resize(at(n));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) e_.M(at(i), at(j)) = to_double(exact.value(equations_.M[i][j]));
      e_.k[at(i)] = to_double(exact.value(equations_.k_bar[i]));
      e_.q[at(i)] = to_double(exact.value(equations_.q_bar[i]));
    }
    e_.kinetic_energy = to_double(exact.value(equations_.kinetic_energy));
    e_.potential_energy = to_double(exact.value(equations_.potential_energy));
    // Entries may be small differences: their scale is that of the tree's largest.
    e_.load = Vector::Constant(at(n), (e_.M.cwiseAbs() * e_.beta.cwiseAbs()).maxCoeff() +
                                          e_.k.cwiseAbs().maxCoeff() + e_.q.cwiseAbs().maxCoeff() +
                                          e_.M.cwiseAbs().maxCoeff());
  }

  /// Solves G x = right for the dependent entries.
  Vector dependents(const Vector& right, const Vector& known) const {
    Matrix D(at(plan_.rows.size()), at(dependent_.size()));
    Vector b(D.rows());
    for (std::size_t r = 0; r < plan_.rows.size(); ++r) {
      const Eigen::Index row = at(plan_.rows[r]);
      for (std::size_t c = 0; c < dependent_.size(); ++c) D(at(r), at(c)) = e_.G(row, at(dependent_[c]));
      b[at(r)] = right[row] - e_.G.row(row).dot(known);
    }
    const Vector solution = D.fullPivLu().solve(b);
    Vector x = known;
    for (std::size_t c = 0; c < dependent_.size(); ++c) x[at(dependent_[c])] = solution[at(c)];
    return x;
  }

  void reduce() {
    const std::size_t n = layout_.velocity_count();
    for (std::size_t k = 0; k < n; ++k)
      if (std::find(plan_.independent.begin(), plan_.independent.end(), k) == plan_.independent.end())
        dependent_.push_back(k);
    const dynamics::ClosureMotion motion = closures_at(e_.z);
    e_.G.resize(at(motion.g.size()), at(n));
    Vector g_t(at(motion.g.size()));
    for (std::size_t r = 0; r < motion.g.size(); ++r) {
      g_t[at(r)] = motion.g_t[r];
      for (std::size_t k = 0; k < n; ++k) e_.G(at(r), at(k)) = motion.G[r][k];
    }
    e_.B.resize(at(n), at(plan_.independent.size()));
    e_.z = dependents(-g_t, Vector::Zero(at(n)));
    for (std::size_t j = 0; j < plan_.independent.size(); ++j) {
      e_.B.col(at(j)) = dependents(Vector::Zero(g_t.size()), Vector::Unit(at(n), at(plan_.independent[j])));
      e_.z += e_.B.col(at(j)) * ray_.z[j];
    }
    e_.condition = dependent_condition();
  }

  /// Largest singular value of the rows used over the smallest of the dependent block.
  long double dependent_condition() const {
    if (plan_.rows.empty()) return 1;
    Matrix G(at(plan_.rows.size()), e_.G.cols());
    for (std::size_t r = 0; r < plan_.rows.size(); ++r) G.row(at(r)) = e_.G.row(at(plan_.rows[r]));
    const Matrix D = G(Eigen::all, dependent_);
    return Eigen::JacobiSVD<Matrix>(G).singularValues()[0] /
           Eigen::JacobiSVD<Matrix>(D).singularValues().tail(1)[0];
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations &equations_, &closures_;
  const LoopPlan& plan_;
  const Ray& ray_;
  model::CoordinateLayout layout_;
  std::vector<double> parameters_;
  std::vector<std::size_t> dependent_;
  MotionAtState e_;
};

}  // namespace

MotionAtState motion_at_state(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                              const dynamics::Equations& closures, const LoopPlan& plan, const Ray& ray) {
  return Evaluation(mechanism, equations, closures, plan, ray).result();
}

double leaf_value(const std::vector<double>& parameters, const Ray& ray, kinematics::LeafKind kind,
                  std::size_t i, const Vector& z) {
  switch (kind) {
    case kinematics::LeafKind::kParameter:
      return parameters[i];
    case kinematics::LeafKind::kPosition:
      return static_cast<double>(ray.configuration.y[i]);
    case kinematics::LeafKind::kVelocity:
      return static_cast<double>(z[at(i)]);
    case kinematics::LeafKind::kAcceleration:
    case kinematics::LeafKind::kMultiplier:
      return 0;
    case kinematics::LeafKind::kInput:
      return ray.u[i];
    case kinematics::LeafKind::kTime:
      return static_cast<double>(ray.configuration.t);
  }
  return 0;
}

}  // namespace jourdain::loops
