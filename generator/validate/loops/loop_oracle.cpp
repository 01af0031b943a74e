#include "validate/loops/loop_oracle.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dynamics/kinematic_functions.hpp"
#include "loops/plan/schur_solution.hpp"
#include "loops/rows/regular_rows.hpp"
#include "model/kinematic_kinds.hpp"
#include "support/matrix_index.hpp"
#include "validate/kinematic_arrays.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

using ir::FunctionId;

using dynamics::OutputValues;
using ir::LeafKind;

namespace {

using support::at;

constexpr const char* kAccelerations = "the accelerations of the constrained system";

/// J_t, J_r, v̄, ω̄, ā, ζ̄ of the tree in terms of the independent velocities.
void reduce(std::vector<ExactMatrix>& jacobian, const ExactMotion& e) {
  for (std::size_t k : {0, 1}) {
    jacobian[2 + k] += jacobian[k] * e.b;
    jacobian[4 + k] += jacobian[k] * e.beta;
    jacobian[k] = ExactMatrix(jacobian[k] * e.B);
  }
}

ExactMatrix values_of(const OutputValues& member, const dynamics::HighPrecision& exact) {
  ExactMatrix values(member.rows, member.columns);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      values(i, j) = exact.value(member.values[static_cast<std::size_t>(i * values.cols() + j)]);
  return values;
}

}  // namespace

LoopOracle::LoopOracle(const LoopScene& scene, const Point& point)
    : scene_(scene), point_(point), e_(exact_motion(scene, point.exact)) {}

std::vector<Expected> LoopOracle::operator()(const ir::Program& program) const {
  if (const auto k = model::kinematic_function_named(scene_.mechanism, program.name))
    return kinematics(program, *k);
  switch (function_of(program)) {
    case FunctionId::kInitialState:
      return expecting("the assembled start", start(program));
    case FunctionId::kPositionRate:
      return expecting("Z z of the equations, z as the loops allow", position_rate());
    case FunctionId::kMassMatrix:
      return expecting("B^T M B", mass_entries(program));
    case FunctionId::kKBar:
      return expecting("B^T (k_bar - M beta)", to_list(e_.B.transpose() * (e_.k - e_.M * e_.beta)));
    case FunctionId::kQBar:
      return expecting("B^T q_bar", to_list(e_.B.transpose() * e_.q));
    case FunctionId::kForwardDynamics:
      return expecting(kAccelerations, to_list(accelerations()));
    case FunctionId::kResidual:
      return expecting("B^T (M zdot - k_bar + q_bar + G^T lambda)", to_list(residual()));
    case FunctionId::kInverseDynamics:
      return expecting(
          "B^T (M zdot - k_bar + q_bar) without inputs",
          to_list(e_.B.transpose() * (e_.M * of_tree(to_exact(point_.exact[LeafKind::kAcceleration])) - e_.k +
                                      e_.q_without_inputs)));
    case FunctionId::kKineticEnergy:
      return expecting("T of the equations", {e_.kinetic_energy});
    case FunctionId::kPotentialEnergy:
      return expecting("V of the equations", {e_.potential_energy});
    case FunctionId::kConstraintResidual: {
      std::vector<ScaledReal> rows = to_list(e_.g);
      rows.insert(rows.end(), e_.rate.data(), e_.rate.data() + e_.rate.size());
      return expecting("g and its rate, of the constraints", rows);
    }
    case FunctionId::kConstraintForces:
      return expecting("the multipliers of the constrained system",
                       to_list(multipliers(of_tree(accelerations()))));
    case FunctionId::kOutputs:
      return expecting("outputs of the constrained system", outputs());
    case FunctionId::kSample:
      return expecting("samples of the equations", samples());
    case FunctionId::kResidualDerivatives:
      return {{"B^T M B", mass_entries(program)},
              change_of(
                  "the residual", [](const LoopOracle& o) { return o.residual(); }, true)};
    case FunctionId::kForwardDynamicsDerivatives:
      return {{kAccelerations, to_list(accelerations())},
              change_of(
                  kAccelerations, [](const LoopOracle& o) { return o.accelerations(); }, false)};
    case FunctionId::kLinearize:
      return linearization();
    case FunctionId::kCloseLoops:
    case FunctionId::kProject:
      break;
  }
  JD_CHECK(false, "'{}' closes loops: see closing_expected", program.name);
  return {};
}

std::vector<Expected> LoopOracle::linearization() const {
  const auto with_kinematics = [rates = displacement_rate()](Expected below) {
    below.values.insert(below.values.begin(), rates.begin(), rates.end());
    return below;
  };
  Expected rows = with_kinematics(change_of(
      "the constrained system", [](const LoopOracle& o) { return o.accelerations(); }, true));
  if (rows.otherwise)
    rows.otherwise = [with_kinematics, other = rows.otherwise] { return with_kinematics(other()); };
  return {rows, change_of(
                    "the outputs of the constrained system",
                    [](const LoopOracle& o) { return to_exact(o.outputs()); }, true)};
}

template <class Numbers>
Expected LoopOracle::change_of(const char* what, const Numbers& numbers, bool with_inputs_and_time) const {
  Expected expected{fmt::format("differences of {}", what), change(numbers, with_inputs_and_time), true};
  if (scene_.plan.is_reduced()) return expected;
  expected.otherwise = [this, what, numbers, with_inputs_and_time] {
    const std::vector<std::size_t> rows = scene_.plan.solved_rows();
    const Beside beside{schur(rows), constrained(rows).lambda};
    return Expected{fmt::format("differences of {}, multipliers by the equations that they solve", what),
                    change(numbers, with_inputs_and_time, &beside), true};
  };
  return expected;
}

std::vector<Expected> LoopOracle::kinematics(const ir::Program& program, std::size_t k) const {
  const auto at_accelerations = [&](const ExactVector& zdot) {
    ir::LeafValues<ScaledReal> tree = point_.exact;
    tree[LeafKind::kVelocity] = to_list(e_.z);
    tree[LeafKind::kAcceleration] = to_list(zdot);
    return kinematic_arrays(scene_.equations.kinematics[k],
                            dynamics::HighPrecision(scene_.equations.statements, leaves_at(tree)));
  };
  KinematicArrays arrays = at_accelerations(of_tree(to_exact(point_.exact[LeafKind::kAcceleration])));
  for (auto& [name, values] : at_accelerations(e_.beta))
    if (name.starts_with("bias")) arrays[name] = values;
  const std::pair<const char*, const char*> jacobians[] = {
      {"J", "drift"}, {"J_com", "drift_com"}, {"A", "drift_momentum"}};
  for (const auto& [matrix, drift] : jacobians) {
    const auto J = arrays.find(matrix);
    if (J == arrays.end()) continue;
    arrays[drift] += J->second * e_.b;
    J->second = ExactMatrix(J->second * e_.B);
  }
  if (const auto tau = arrays.find("tau_gravity"); tau != arrays.end())
    tau->second = ExactMatrix(e_.B.transpose() * tau->second);
  if (const auto J = arrays.find(dynamics::kOperationalJacobian); J != arrays.end())
    arrays["inverse_inertia"] = inverse_inertia(J->second);
  return expecting("kinematics and momentum, velocities as the loops allow", entries_of(program, arrays));
}

/// Accelerations of the frame by unit forces on it.
ExactMatrix LoopOracle::inverse_inertia(const ExactMatrix& J) const {
  if (scene_.plan.is_reduced()) {
    const ExactMatrix reduced = J * e_.B;
    if (reduced.cols() == 0) return ExactMatrix::Zero(J.rows(), J.rows());
    return reduced * solved(e_.B.transpose() * e_.M * e_.B, ExactMatrix(reduced.transpose()));
  }
  const std::vector<std::size_t> rows = scene_.plan.solved_rows();
  const ExactMatrix G = e_.G(rows, Eigen::all), back = solved(e_.M, ExactMatrix(G.transpose()));
  const loops::SchurSolution schur(scene_.plan, rows, G * back, scene_.plan.regularisation);
  ExactMatrix moved = solved(e_.M, ExactMatrix(J.transpose()));
  for (Eigen::Index a = 0; a < moved.cols(); ++a) {
    const ExactVector free = moved.col(a);
    moved.col(a) -= back * schur.corrected(G * free, scene_.plan.corrections);
  }
  return J * moved;
}

LoopOracle::Constrained LoopOracle::constrained(const std::vector<std::size_t>& rows) const {
  constexpr double kRedundant = 1e3;
  const loops::LoopPlan& plan = scene_.plan;
  const bool all = rows.size() != plan.solved_rows().size();
  const double size = all ? kRedundant * plan.closing_regularisation : plan.regularisation;
  const int corrections = all ? 2 : plan.corrections;
  const Schur here = schur(rows);
  ExactVector lambda;
  if (beside_ && !all) {
    const ExactVector missing =
        here.c - here.S * beside_->lambda - (beside_->schur.c - beside_->schur.S * beside_->lambda);
    lambda = beside_->lambda +
             loops::SchurSolution(plan, rows, beside_->schur.S, size).corrected(missing, corrections);
  } else {
    lambda = loops::SchurSolution(plan, rows, here.S, size).corrected(here.c, corrections);
  }
  return {here.free - here.back * lambda, lambda};
}

LoopOracle::Schur LoopOracle::schur(const std::vector<std::size_t>& rows) const {
  const loops::LoopPlan& plan = scene_.plan;
  const ExactMatrix G = e_.G(rows, Eigen::all);
  ExactMatrix right(e_.M.rows(), G.rows() + 1);
  right << G.transpose(), e_.k - e_.q;
  const ExactMatrix solution = solved(e_.M, right);
  Schur result;
  result.back = solution.leftCols(G.rows());
  result.free = solution.rightCols(1);
  result.S = G * result.back;
  const ScaledReal s = plan.stabilisation, twice = 2 * plan.stabilisation,
                   square = plan.stabilisation * plan.stabilisation;
  result.c = G * result.free + e_.gamma(rows) + twice * e_.rate(rows) + square * e_.g(rows);
  return result;
}

ExactVector LoopOracle::accelerations() const {
  if (!scene_.plan.is_reduced()) return constrained(scene_.plan.solved_rows()).zdot;
  if (e_.B.cols() == 0) return ExactVector(0);
  return solved(e_.B.transpose() * e_.M * e_.B, e_.B.transpose() * (e_.k - e_.q - e_.M * e_.beta));
}

ExactVector LoopOracle::multipliers(const ExactVector& zdot) const {
  ExactVector lambda = ExactVector::Zero(e_.G.rows());
  const loops::LoopPlan& plan = scene_.plan;
  if (plan.is_reduced()) {
    const auto& columns = scene_.closure.dependents();
    if (columns.empty()) return lambda;
    const ExactVector missing = e_.k - e_.q - e_.M * zdot;
    const ExactMatrix D = e_.G(plan.rows, columns);
    const ExactVector solution = solved(D.transpose(), ExactVector(missing(columns)));
    lambda(plan.rows) = solution;
    return lambda;
  }
  const std::vector<std::size_t> rows =
      plan.sharing.empty() ? loops::all_but(plan.disagreeing, static_cast<std::size_t>(e_.G.rows()))
                           : plan.solved_rows();
  const ExactVector found = constrained(rows).lambda;
  lambda(rows) = found;
  return lambda;
}

ExactVector LoopOracle::residual() const {
  const ExactVector given = to_exact(point_.exact[LeafKind::kAcceleration]);
  ExactVector r = e_.B.transpose() * (e_.M * of_tree(given) - e_.k + e_.q);
  if (scene_.plan.is_reduced()) return r;
  const std::vector<std::size_t> rows = scene_.plan.solved_rows();
  return r + e_.G(rows, Eigen::all).transpose() * constrained(rows).lambda;
}

std::vector<ScaledReal> LoopOracle::position_rate() const {
  const model::Tangent& tangent = scene_.closure.tangent();
  const std::vector<ScaledReal>& y = point_.exact[LeafKind::kPosition];
  std::vector<ScaledReal> rate(y.size());
  for (const model::Tangent::Scalar& s : tangent.scalars) rate[s.position] = e_.z[at(s.velocity)];
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    const ScaledReal* q = &y[s.position];
    const ExactVector omega = e_.z.segment(at(s.velocity), 3) / ScaledReal(2);
    rate[s.position] = -(q[1] * omega[0] + q[2] * omega[1] + q[3] * omega[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      rate[s.position + 1 + k] = q[0] * omega[at(k)] + q[1 + l] * omega[at(m)] - q[1 + m] * omega[at(l)];
    }
  }
  return rate;
}

std::vector<ScaledReal> LoopOracle::outputs() const {
  ir::LeafValues<ScaledReal> tree = point_.exact;
  const ExactVector zdot = of_tree(accelerations());
  tree[LeafKind::kVelocity] = to_list(e_.z);
  tree[LeafKind::kAcceleration] = to_list(zdot);
  tree[LeafKind::kMultiplier] = to_list(multipliers(zdot));
  const dynamics::HighPrecision exact(scene_.equations.statements, leaves_at(tree));
  std::vector<ScaledReal> numbers;
  for (std::size_t k = 0; k < scene_.mechanism.outputs.size(); ++k) {
    std::vector<ExactMatrix> members;
    for (const OutputValues& member : scene_.equations.outputs[k])
      members.push_back(values_of(member, exact));
    if (scene_.plan.is_reduced() && scene_.mechanism.outputs[k].kind == model::OutputKind::kJacobian)
      reduce(members, e_);
    for (const ExactMatrix& member : members)
      for (Eigen::Index i = 0; i < member.rows(); ++i)
        for (Eigen::Index j = 0; j < member.cols(); ++j) numbers.push_back(member(i, j));
  }
  return numbers;
}

std::vector<ScaledReal> LoopOracle::samples() const {
  ir::LeafValues<ScaledReal> tree = point_.exact;
  tree[LeafKind::kVelocity] = to_list(e_.z);
  return dynamics::HighPrecision(scene_.equations.statements, leaves_at(tree))
      .values(dynamics::sampled_values(scene_.equations));
}

std::vector<ScaledReal> LoopOracle::mass_entries(const ir::Program& program) const {
  const ExactMatrix M = e_.B.transpose() * e_.M * e_.B;
  std::vector<ScaledReal> values;
  for (const ir::Output& output : program.outputs)
    if (output.name == "M") values.push_back(M(output.row, output.column));
  return values;
}

std::vector<ScaledReal> LoopOracle::start(const ir::Program& program) const {
  const loops::LoopPlan& plan = scene_.plan;
  const dynamics::Equations& tree = scene_.equations;
  const dynamics::HighPrecision at(tree.statements, leaves_at(point_.exact));
  std::vector<ScaledReal> values;
  for (const ir::Output& output : program.outputs) {
    const auto i = static_cast<std::size_t>(output.row);
    const bool is_position = output.name == "y";
    const std::size_t k = plan.is_reduced() && !is_position ? plan.independent[i] : i;
    const kinematics::Ex& given = is_position ? tree.initial_position[k] : tree.initial_velocity[k];
    const bool follows = is_position ? plan.kept_y[k] : plan.kept_z[k];
    values.push_back(follows && !kinematics::is_number(given)
                         ? at.value(given)
                         : ScaledReal(is_position ? plan.y[k] : plan.z[k]));
  }
  return values;
}

/// Of a coordinate the velocity's change; of a rotation δθ̇ = δω − ω × δθ.
std::vector<ScaledReal> LoopOracle::displacement_rate() const {
  const dynamics::ExactDirection& d = point_.direction;
  const std::vector<std::size_t>& carried = scene_.closure.carried();
  std::vector<ScaledReal> rate = d.velocity;
  const std::size_t moving = d.displacement.size() - carried.size();
  rate.resize(moving);
  if (!carried.empty())
    for (const ScaledReal& entry :
         change([&](const LoopOracle& o) { return ExactVector(o.e_.z(carried)); }, true))
      rate.push_back(entry);
  const std::vector<std::size_t>& independent = scene_.plan.independent;
  const auto place = [&](std::size_t velocity) {
    if (!scene_.plan.is_reduced()) return velocity;
    return static_cast<std::size_t>(std::find(independent.begin(), independent.end(), velocity) -
                                    independent.begin());
  };
  for (const model::Tangent::Scalar& s : scene_.closure.tangent().quaternions) {
    const std::size_t first = place(s.velocity);
    for (std::size_t k = 0; k < 3 && first < moving; ++k) {
      const std::size_t j = (k + 1) % 3, l = (k + 2) % 3;
      rate[first + k] -= e_.z[at(s.velocity + j)] * d.displacement[first + l] -
                         e_.z[at(s.velocity + l)] * d.displacement[first + j];
    }
  }
  return rate;
}

template <class Numbers>
std::vector<ScaledReal> LoopOracle::change(const Numbers& numbers, bool with_inputs_and_time,
                                           const Beside* beside) const {
  const ScaledReal h(cln::expt(cln::cl_RA(2), -84));  // (2^-84)^2 and 2^-256 / 2^-84 are both far below 1e-40
  constexpr long double kTruncated = 1e-9L;           // 40 (2^-84)^2 / 1e-40
  const auto moved = [&](const ScaledReal& step) {
    const dynamics::ExactDirection& d = point_.direction;
    Point there = point_;
    ExactVector displacement = ExactVector::Zero(at(scene_.closure.velocity_count()));
    const std::vector<std::size_t>& carried = scene_.closure.carried();
    const std::size_t moving = d.displacement.size() - carried.size();
    for (std::size_t c = 0; c < carried.size(); ++c)
      displacement[at(carried[c])] = step * d.displacement[moving + c];
    const auto entry = [&](std::size_t j) {
      return at(scene_.plan.is_reduced() ? scene_.plan.independent[j] : j);
    };
    for (std::size_t j = 0; j < d.velocity.size(); ++j) {
      if (j < moving) displacement[entry(j)] = step * d.displacement[j];
      there.exact[LeafKind::kVelocity][j] += step * d.velocity[j];
    }
    std::vector<ScaledReal>& y = there.exact[LeafKind::kPosition];
    y = scene_.closure.displaced(y, displacement);
    for (std::size_t j = 0; with_inputs_and_time && j < d.input.size(); ++j)
      there.exact[LeafKind::kInput][j] += step * d.input[j];
    if (with_inputs_and_time) there.exact[LeafKind::kTime][0] += step * d.time;
    there.exact = scene_.closure.holding(point_.exact, scene_.closure.closed(std::move(there.exact)));
    LoopOracle oracle(scene_, there);
    oracle.beside_ = beside;
    return to_list(numbers(oracle));
  };
  const std::vector<ScaledReal> above = moved(h), below = moved(-h);
  std::vector<ScaledReal> rates;
  for (std::size_t i = 0; i < above.size(); ++i)
    rates.push_back(((above[i] - below[i]) / (h + h)).forgetting().with_scale(above[i].scale()));
  long double largest = 0;
  for (const ScaledReal& rate : rates) largest = std::max(largest, rate.scale());
  // What changes with the square of the step has next to no scale, and is off by h² like all others.
  for (ScaledReal& rate : rates) rate = rate.with_scale(kTruncated * largest);
  return rates;
}

}  // namespace jourdain::validate
