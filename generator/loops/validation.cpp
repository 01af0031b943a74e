#include "loops/validation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "kinematics/numbers.hpp"
#include "loops/closing_check.hpp"
#include "loops/derivative_check.hpp"
#include "loops/expected.hpp"
#include "loops/motion_at_state.hpp"
#include "loops/sharing_rows.hpp"
#include "model/checks.hpp"
#include "reference/minimal.hpp"

namespace jourdain::loops {

using dynamics::HighPrecision;
using dynamics::to_double;
using ir::LeafKind;
using validate::Verdict;

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Of derivatives against differences, which lose digits near singular configurations.
constexpr double kDerivativeTolerance = 1e-8;
constexpr std::size_t kStates = 8, kLarge = 24;  ///< velocities from which on two states must do

class Comparison {
 public:
  Comparison(const model::Mechanism& mechanism, const dynamics::Equations& equations,
             const dynamics::Equations& closures, const NumericClosure& closure, const ir::Module& module,
             const LoopPlan& plan, const Ray& ray, Verdict& verdict)
      : mechanism_(mechanism),
        equations_(equations),
        closure_(closure),
        module_(module),
        plan_(plan),
        ray_(ray),
        y_(ray.configuration.y.begin(), ray.configuration.y.end()),
        verdict_(verdict),
        layout_(model::lay_out_coordinates(mechanism)),
        parameters_(model::default_values(mechanism)),
        e_(motion_at_state(mechanism, equations, closures, plan, ray)) {}

  void run() {
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kParameter] = parameters_;
    leaves[LeafKind::kConstant] = ir::interpret(module_.constants, leaves);
    leaves[LeafKind::kPosition] = y_;
    leaves[LeafKind::kVelocity] = ray_.z;
    leaves[LeafKind::kAcceleration] = ray_.zdot;
    leaves[LeafKind::kInput] = ray_.u;
    leaves[LeafKind::kTime] = {static_cast<double>(ray_.configuration.t)};
    for (const ir::Program& program : module_.functions) compare(program, ir::interpret(program, leaves));
    verdict_.condition =
        std::max(verdict_.condition, static_cast<double>(reference::condition<long double>(mass_matrix())));
  }

 private:
  double leaf(kinematics::LeafKind kind, std::size_t i, const Vector& z) const {
    return leaf_value(parameters_, ray_, kind, i, z);
  }

  void record(const std::string& what, const Vector& value, const Vector& expected, long double scale,
              double& worst) {
    const auto error = static_cast<double>((value - expected).lpNorm<Eigen::Infinity>() / scale);
    if (!(error <= validate::kTolerance))
      verdict_.failures.push_back(fmt::format("{} is off by {:.2g} of its term sum", what, error));
    worst = std::max(worst, error);
  }

  void compare(const ir::Program& program, const std::vector<double>& values) {
    const Vector v = Eigen::Map<const Eigen::VectorXd>(values.data(), at(values.size())).cast<long double>();
    const auto entry = [&](const Vector& expected, long double scale) {
      record(program.name, v, expected, scale * e_.condition, verdict_.entry_error);
    };
    const long double load = e_.load.maxCoeff() * (e_.B.cols() == 0 ? 1 : e_.B.cwiseAbs().maxCoeff());
    const Vector force = e_.k - e_.q - e_.M * e_.beta;
    const std::string& name = program.name;
    if (name == "k_bar") return entry(e_.B.transpose() * (e_.k - e_.M * e_.beta), load);
    if (name == "q_bar") return entry(e_.B.transpose() * e_.q, load);
    if (name == "mass_matrix") return compare_mass_matrix(program, v);
    if (name == "forward_dynamics") return compare_motion(v);
    if (name == "kinetic_energy") return entry(Vector::Constant(1, e_.kinetic_energy), 1 + e_.kinetic_energy);
    if (name == "potential_energy")
      return entry(Vector::Constant(1, e_.potential_energy), 1 + std::fabs(e_.potential_energy) + load);
    if (name == "constraint_residual") {
      Vector expected(2 * e_.g.size());
      expected << e_.g, e_.rate;
      return entry(expected, 1 + e_.z.cwiseAbs().maxCoeff() * e_.G.cwiseAbs().maxCoeff());
    }
    const Vector zdot =
        Eigen::Map<const Eigen::VectorXd>(ray_.zdot.data(), at(ray_.zdot.size())).cast<long double>();
    if (name == "residual" && plan_.is_reduced())
      return entry(e_.B.transpose() * (e_.M * (e_.B * zdot) - force), load * (1 + zdot.lpNorm<1>()));
    if (name == "inverse_dynamics")
      return entry(e_.B.transpose() * inverse_dynamics(e_.B * zdot + e_.beta), load * (1 + zdot.lpNorm<1>()));
    if (name == "position_rate") return entry(position_rate(), 1 + e_.z.lpNorm<Eigen::Infinity>());
    if (name == "constraint_forces") return compare_constraint_forces(v);
    if (name == "close_loops" || name == "project") return compare_correction(program, v);
    if (name == "outputs") return compare_outputs(v);
    const double error = derivative_error(closure_, plan_, module_, parameters_, ray_, program, values);
    if (!(error <= kDerivativeTolerance))
      verdict_.failures.push_back(fmt::format("{} is off by {:.2g} of its terms", name, error));
  }

  /// τ of the tree at these accelerations.
  Vector inverse_dynamics(const Vector& a) const {
    const HighPrecision exact(equations_.statements, [&](kinematics::LeafKind kind, std::size_t i) {
      return kind == kinematics::LeafKind::kAcceleration ? static_cast<double>(a[at(i)])
                                                         : leaf(kind, i, e_.z);
    });
    Vector tau(a.size());
    for (Eigen::Index i = 0; i < a.size(); ++i)
      tau[i] = to_double(exact.value(equations_.tau[static_cast<std::size_t>(i)]));
    return tau;
  }

  Vector position_rate() const {
    const model::Tangent tangent = model::tangent_of(mechanism_, layout_);
    Vector rate = Vector::Zero(at(layout_.position_count()));
    for (const model::Tangent::Scalar& s : tangent.scalars) rate[at(s.position)] = e_.z[at(s.velocity)];
    for (const model::Tangent::Scalar& s : tangent.quaternions) {
      const auto q = [&](std::size_t k) { return static_cast<long double>(y_[s.position + k]); };
      const Eigen::Quaternion<long double> orientation(q(0), q(1), q(2), q(3)),
          spin(0, e_.z[at(s.velocity)], e_.z[at(s.velocity + 1)], e_.z[at(s.velocity + 2)]);
      const auto turned = orientation * spin;
      rate.segment<4>(at(s.position)) << turned.w() / 2, turned.x() / 2, turned.y() / 2, turned.z() / 2;
    }
    return rate;
  }

  /// Without rows that are left open.
  Matrix agreeing(Matrix G) const {
    for (const std::size_t r : plan_.disagreeing)
      if (std::find(plan_.sharing.begin(), plan_.sharing.end(), r) == plan_.sharing.end())
        G.row(at(r)).setZero();
    return G;
  }

  /// What rows that share and disagree may be off by, over the tolerance: each of them is left a little open.
  long double slack() const {
    return plan_.sharing.empty() ? 1 : 1 + 10 * plan_.disagreement / validate::kTolerance;
  }

  /// How the program solves for multipliers, in numbers.
  SchurSolution schur() const {
    const Matrix G = e_.G(plan_.solved_rows(), Eigen::all);
    return SchurSolution(plan_, G * e_.M.ldlt().solve(G.transpose()), plan_.regularisation);
  }

  /// Where rows are redundant those that are solved for may be weak, which makes multipliers larger than they need to be.
  struct Weakness {
    long double terms = 0;      ///< the largest of |G|ᵀ |λ|
    long double condition = 1;  ///< of what is inverted
  };
  Weakness weakness() const {
    if (plan_.redundant.empty()) return {};
    const std::vector<std::size_t> rows = plan_.solved_rows();
    const Matrix G = e_.G(rows, Eigen::all);
    const SchurSolution schur = this->schur();
    const Vector lambda = schur.solved(G * e_.M.ldlt().solve(e_.k - e_.q) + e_.gamma(rows));
    return {(G.cwiseAbs().transpose() * lambda.cwiseAbs()).maxCoeff(), schur.condition()};
  }

  /// What of G ż + γ must be zero.
  Vector held(Vector opening) const {
    const Vector solved = opening(plan_.solved_rows());
    for (const std::size_t r : plan_.disagreeing) opening[at(r)] = 0;
    if (!plan_.disagreeing.empty()) opening(plan_.solved_rows()) = schur().kept(solved);
    return opening;
  }

  TreeMotion motion_of_tree() const {
    Vector b = e_.z;
    for (std::size_t j = 0; plan_.is_reduced() && j < plan_.independent.size(); ++j)
      b -= e_.B.col(at(j)) * ray_.z[j];
    return tree_motion(plan_, e_.M, agreeing(e_.G), e_.k - e_.q, e_.gamma, {e_.B, b, e_.beta, {}, {}});
  }

  /// Of multipliers; reduced treatments need none.
  Spread spread() const { return plan_.is_reduced() ? Spread{1, 1} : spread_of(plan_, agreeing(e_.G), e_.M); }

  /// Gᵀ λ: λ itself is not unique where rows are redundant.
  void compare_constraint_forces(const Vector& lambda) {
    const Spread spread = this->spread();
    if (spread.is_singular) return;
    const TreeMotion motion = motion_of_tree();
    const long double scale = e_.load.maxCoeff() + (e_.M.cwiseAbs() * motion.zdot.cwiseAbs()).maxCoeff() +
                              e_.G.cwiseAbs().maxCoeff() * motion.lambda.lpNorm<Eigen::Infinity>();
    const long double sensitivity = plan_.is_reduced()
                                        ? e_.condition
                                        : std::max(spread.largest / spread.smallest, weakness().condition) +
                                              spread.lost_share / validate::kTolerance;
    record("constraint_forces", e_.G.transpose() * lambda, e_.G.transpose() * motion.lambda,
           scale * sensitivity, verdict_.entry_error);
  }

  void compare_outputs(const Vector& v) {
    const Spread spread = this->spread();
    if (spread.is_singular) return;
    const TreeMotion motion = motion_of_tree();
    const std::vector<Vector> expected =
        expected_outputs(mechanism_, equations_, plan_, motion,
                         [&](kinematics::LeafKind kind, std::size_t i) { return leaf(kind, i, e_.z); });
    // What rounding does to accelerations and multipliers passes on.
    const long double sensitivity = e_.condition * reference::condition<long double>(mass_matrix()) +
                                    (plan_.is_reduced() ? 0 : spread.lost_share / validate::kTolerance);
    Eigen::Index next = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const long double scale = 1 + expected[k].lpNorm<Eigen::Infinity>() +
                                motion.zdot.lpNorm<Eigen::Infinity>() +
                                motion.lambda.lpNorm<Eigen::Infinity>() + e_.load.maxCoeff();
      record(fmt::format("output {}", equations_.output_names[k]), v.segment(next, expected[k].size()),
             expected[k], scale * sensitivity, verdict_.entry_error);
      next += expected[k].size();
    }
  }

  /// Of the independent coordinates.
  Matrix mass_matrix() const { return e_.B.transpose() * e_.M * e_.B; }

  void compare_mass_matrix(const ir::Program& program, const Vector& v) {
    const Matrix M = mass_matrix();
    Vector expected(v.size());
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      const ir::Output& output = program.outputs[static_cast<std::size_t>(k)];
      expected[k] = M(output.row, output.column);
    }
    record(program.name, v, expected, e_.M.cwiseAbs().maxCoeff() * e_.B.cwiseAbs().maxCoeff() * e_.condition,
           verdict_.entry_error);
  }

  /// As a backward error.
  void compare_motion(const Vector& zdot) {
    if (plan_.is_reduced()) {
      const Vector r = e_.B.transpose() * (e_.M * (e_.B * zdot + e_.beta) - e_.k + e_.q);
      const long double scale =
          e_.load.maxCoeff() + (e_.M.cwiseAbs() * (e_.B.cwiseAbs() * zdot.cwiseAbs())).maxCoeff();
      return record("M zdot = k_bar - q_bar with the program's zdot", r, Vector::Zero(r.size()),
                    scale * e_.B.cwiseAbs().maxCoeff() * e_.condition, verdict_.backward_error);
    }
    // M ż + Gᵀ λ = k̄ − q̄ for some λ, and G ż + γ = 0 (with the stabilisation) where constraints are regular.
    const Vector missing = e_.k - e_.q - e_.M * zdot;
    const Matrix G = agreeing(e_.G);
    const Vector lambda = least_norm(G.transpose(), missing);
    const Weakness weakness = this->weakness();
    const long double scale =
        e_.load.maxCoeff() + (e_.M.cwiseAbs() * zdot.cwiseAbs()).maxCoeff() + weakness.terms;
    record("M zdot + G^T lambda = k_bar - q_bar with the program's zdot", missing, G.transpose() * lambda,
           scale * slack(), verdict_.backward_error);
    const Spread spread = this->spread();
    if (spread.is_singular) return;
    const Matrix S = G * e_.M.ldlt().solve(G.transpose());
    const long double s = plan_.stabilisation;
    const Vector opening = e_.G * zdot + e_.gamma + 2 * s * e_.rate + s * s * e_.g;
    const long double apart =
        1 + 10 * std::pow(static_cast<long double>(plan_.disagreement), 2) / validate::kTolerance;
    const long double terms = (e_.G.cwiseAbs() * zdot.cwiseAbs() + e_.gamma.cwiseAbs()).maxCoeff() +
                              2 * s * (e_.G.cwiseAbs() * e_.z.cwiseAbs()).maxCoeff();
    record("G zdot + gamma = 0 with the program's zdot", held(opening), Vector::Zero(opening.size()),
           apart * (terms + S.cwiseAbs().maxCoeff() * lambda.lpNorm<Eigen::Infinity>() *
                                (spread.lost_share / validate::kTolerance +
                                 std::max(spread.largest / spread.smallest, weakness.condition))),
           verdict_.backward_error);
  }

  /// Off the loops, and on them: a closed state stays where it is.
  void compare_correction(const ir::Program& program, const Vector& v) {
    const double off = closing_error(mechanism_, closure_, plan_, module_, parameters_, ray_, program);
    if (!(off <= validate::kTolerance))
      verdict_.failures.push_back(
          fmt::format("{} is off by {:.2g} where the loops are open", program.name, off));
    verdict_.entry_error = std::max(verdict_.entry_error, off);
    Vector expected = v;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      const ir::Output& output = program.outputs[static_cast<std::size_t>(k)];
      const auto i = static_cast<std::size_t>(output.row);
      if (output.name == "y") expected[k] = y_[i];
      if (output.name == "z") expected[k] = ray_.z[i];
      if (output.name == "opening") expected[k] = 0;
    }
    // A state is closed to kClosed, no better; rows that were chosen from redundant ones may be weak.
    const long double weak = plan_.is_reduced() ? 1 : std::sqrt(weakness().condition);
    record(program.name, v, expected,
           1e3L * (1 + expected.lpNorm<Eigen::Infinity>()) * e_.condition * slack() * weak,
           verdict_.entry_error);
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
  const NumericClosure& closure_;
  const ir::Module& module_;
  const LoopPlan& plan_;
  const Ray& ray_;
  std::vector<double> y_;
  Verdict& verdict_;
  model::CoordinateLayout layout_;
  std::vector<double> parameters_;
  MotionAtState e_;
};

}  // namespace

Verdict validate_closed(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                        const ir::Module& module, const LoopPlan& plan) {
  const std::size_t states = plan.z.size() >= kLarge ? 2 : kStates;
  ir::Module nothing;
  Verdict verdict = validate::validate_translation(mechanism, equations, nothing, states);
  dynamics::DerivationOptions options;
  options.closures_only = true;
  const dynamics::Equations closures = dynamics::derive_equations(mechanism, options);
  const ConstraintPrograms programs = constraint_programs(mechanism, closures).front();
  NumericClosure closure(mechanism, programs, model::default_values(mechanism));
  constexpr long double kBranch = 100;  // times what was seen: further open there is another branch
  closure.disregard(plan.disagreeing, kBranch * plan.disagreement);
  verdict.states = 0;
  verdict.condition = 0;  // that of the tree off the loops is nobody's
  for (const Ray& ray : draw_rays(closure, plan, mechanism, states)) {
    Comparison(mechanism, equations, closures, closure, module, plan, ray, verdict).run();
    ++verdict.states;
  }
  return verdict;
}

}  // namespace jourdain::loops
