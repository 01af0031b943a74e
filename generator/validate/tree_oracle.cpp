#include "validate/tree_oracle.hpp"

#include <algorithm>

#include "dynamics/kinematic_functions.hpp"
#include "dynamics/outputs.hpp"
#include "model/coordinates.hpp"
#include "model/kinematic_kinds.hpp"
#include "support/matrix_index.hpp"
#include "validate/kinematic_arrays.hpp"

namespace jourdain::validate {

using ir::FunctionId;

using dynamics::ExactDirection;
using dynamics::SlopePrecision;
using ir::LeafKind;
using kinematics::Ex;

namespace {

using support::at;

ExactVector evaluated(const dynamics::HighPrecision& exact, const std::vector<Ex>& expressions) {
  return to_exact(exact.values(expressions));
}

ExactVector rates(const SlopePrecision& moved, const std::vector<Ex>& expressions) {
  ExactVector list(at(expressions.size()));
  for (std::size_t i = 0; i < expressions.size(); ++i) list[at(i)] = moved.value(expressions[i]).first;
  return list;
}

}  // namespace

dynamics::LeafValue leaves_at(const ir::LeafValues<ScaledReal>& values) {
  return [&values](kinematics::LeafKind kind, std::size_t i) {
    const std::vector<ScaledReal>& list = values[kind];
    return i < list.size() ? list[i] : ScaledReal();  // multipliers: as if loops were open
  };
}

TreeOracle::TreeOracle(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                       const dynamics::Equations* load, const Point& point)
    : mechanism_(mechanism),
      equations_(equations),
      load_(load),
      point_(point),
      tangent_(model::lay_out_coordinates(mechanism).tangent),
      leaf_(leaves_at(point.exact)),
      exact_(equations.statements, leaf_),
      M_(at(equations.M.size()), at(equations.M.size())),
      k_(evaluated(exact_, equations.k_bar)),
      q_(evaluated(exact_, equations.q_bar)) {
  for (std::size_t i = 0; i < equations.M.size(); ++i)
    M_.row(at(i)) = evaluated(exact_, equations.M[i]).transpose();
  zdot_ = solved(M_, k_ - q_);
}

std::vector<Expected> TreeOracle::operator()(const ir::Program& program) const {
  if (const auto k = model::kinematic_function_named(mechanism_, program.name))
    return kinematics(program, *k);
  switch (function_of(program)) {
    case FunctionId::kInitialState:
      return {state(program)};
    case FunctionId::kPositionRate:
      return expecting("Z z of the equations", exact_.values(equations_.ydot));
    case FunctionId::kMassMatrix:
      return expecting("M of the equations", mass_entries(program, "M"));
    case FunctionId::kKBar:
      return expecting("k_bar of the equations", to_list(k_));
    case FunctionId::kQBar:
      return expecting("q_bar of the equations", to_list(q_));
    case FunctionId::kForwardDynamics:
      return expecting("M^-1 (k_bar - q_bar)", to_list(zdot_));
    case FunctionId::kResidual:
      return expecting("M zdot - k_bar + q_bar", to_list(M_ * given_accelerations() - k_ + q_));
    case FunctionId::kInverseDynamics:
      return expecting("M zdot - k_bar + q_bar without inputs",
                       to_list(M_ * given_accelerations() - k_ + forces_without_inputs()));
    case FunctionId::kKineticEnergy:
      return expecting("T of the equations", {exact_.value(equations_.kinetic_energy)});
    case FunctionId::kPotentialEnergy:
      return expecting("V of the equations", {exact_.value(equations_.potential_energy)});
    case FunctionId::kOutputs:
      return expecting("outputs of the equations", exact_.values(dynamics::output_entries(equations_)));
    case FunctionId::kSample:
      return expecting("samples of the equations", exact_.values(dynamics::sampled_values(equations_)));
    case FunctionId::kResidualDerivatives:
      return {{"M of the equations", mass_entries(program, "M")},
              {"the residual's derivative along a direction", to_list(residual_rate())}};
    case FunctionId::kForwardDynamicsDerivatives:
      return acceleration_derivatives();
    case FunctionId::kLinearize:
      return linearization();
    case FunctionId::kCloseLoops:
    case FunctionId::kProject:
    case FunctionId::kConstraintResidual:
    case FunctionId::kConstraintForces:
      break;
  }
  JD_CHECK(false, "'{}' is of loops", program.name);
  return {};
}

std::vector<Expected> TreeOracle::acceleration_derivatives() const {
  ExactDirection still = point_.direction;  // it has no columns of inputs and time
  std::fill(still.input.begin(), still.input.end(), ScaledReal());
  still.time = 0;
  return {{"M^-1 (k_bar - q_bar)", to_list(zdot_)},
          {"the accelerations' derivative along a direction", to_list(acceleration_rate(still))}};
}

std::vector<Expected> TreeOracle::linearization() const {
  std::vector<ScaledReal> rows = displacement_rate();
  const ExactVector change = acceleration_rate(point_.direction);
  rows.insert(rows.end(), change.data(), change.data() + change.size());
  return {{"the state's rate differentiated along a direction", rows},
          {"outputs differentiated along a direction", output_rate()}};
}

std::vector<Expected> TreeOracle::kinematics(const ir::Program& program, std::size_t k) const {
  KinematicArrays arrays = kinematic_arrays(equations_.kinematics[k], exact_);
  const auto J = arrays.find(dynamics::kOperationalJacobian);
  if (J != arrays.end())
    arrays["inverse_inertia"] = J->second * solved(M_, ExactMatrix(J->second.transpose()));
  return expecting("kinematics and momentum of the equations", entries_of(program, arrays));
}

ExactVector TreeOracle::given_accelerations() const {
  return to_exact(point_.exact[LeafKind::kAcceleration]);
}

ExactVector TreeOracle::forces_without_inputs() const {
  ir::LeafValues<ScaledReal> values = point_.exact;
  std::fill(values[LeafKind::kInput].begin(), values[LeafKind::kInput].end(), ScaledReal());
  return evaluated(dynamics::HighPrecision(equations_.statements, leaves_at(values)), equations_.q_bar);
}

Expected TreeOracle::state(const ir::Program& program) const {
  std::vector<ScaledReal> values;
  for (const ir::Output& output : program.outputs) {
    const auto i = static_cast<std::size_t>(output.row);
    values.push_back(
        exact_.value(output.name == "y" ? equations_.initial_position[i] : equations_.initial_velocity[i]));
  }
  return {"the description's start", values};
}

std::vector<ScaledReal> TreeOracle::mass_entries(const ir::Program& program, const std::string& array) const {
  std::vector<ScaledReal> values;
  for (const ir::Output& output : program.outputs)
    if (output.name == array) values.push_back(M_(output.row, output.column));
  return values;
}

SlopePrecision TreeOracle::moved(const dynamics::Equations& equations,
                                 const ExactDirection& direction) const {
  return dynamics::moved_along(direction, equations.statements, tangent_, leaf_);
}

ExactVector TreeOracle::residual_rate() const {
  if (load_) return rates(moved(*load_, point_.direction), load_->q_bar);
  const SlopePrecision there = moved(equations_, point_.direction);
  ExactVector sum = rates(there, equations_.q_bar) - rates(there, equations_.k_bar);
  const ExactVector a = given_accelerations();
  for (std::size_t i = 0; i < equations_.M.size(); ++i) sum[at(i)] += rates(there, equations_.M[i]).dot(a);
  return sum;
}

/// M δż = δk̄ − δq̄ − δM ż
ExactVector TreeOracle::acceleration_rate(const ExactDirection& direction) const {
  const SlopePrecision there = moved(equations_, direction);
  ExactVector right = rates(there, equations_.k_bar) - rates(there, equations_.q_bar);
  for (std::size_t i = 0; i < equations_.M.size(); ++i)
    right[at(i)] -= rates(there, equations_.M[i]).dot(zdot_);
  return solved(M_, right);
}

/// Of a coordinate the velocity's change; of a rotation δθ̇ = δω − ω × δθ.
std::vector<ScaledReal> TreeOracle::displacement_rate() const {
  const ExactDirection& d = point_.direction;
  std::vector<ScaledReal> rate = d.velocity;
  rate.resize(d.displacement.size());
  const std::vector<ScaledReal>& z = point_.exact[LeafKind::kVelocity];
  for (const model::Tangent::Scalar& s : tangent_.quaternions)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = s.velocity, j = i + (k + 1) % 3, l = i + (k + 2) % 3;
      rate[i + k] -= z[j] * d.displacement[l] - z[l] * d.displacement[j];
    }
  return rate;
}

std::vector<ScaledReal> TreeOracle::output_rate() const {
  return to_list(rates(moved(equations_, point_.direction), dynamics::output_entries(equations_)));
}

}  // namespace jourdain::validate
