#include "validate/reference_check.hpp"

#include "dynamics/outputs.hpp"
#include "reference/minimal.hpp"

namespace jourdain::validate {

using ir::LeafKind;

namespace {

using ExactReference = reference::Reference<ScaledReal>;

std::vector<ScaledReal> entries(const ExactMatrix& M) { return {M.data(), M.data() + M.size()}; }

}  // namespace

void compare_with_reference(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                            const ir::LeafValues<ScaledReal>& leaves, const TreeOracle& symbolic,
                            Agreement& agreement) {
  const ExactReference reference(mechanism, leaves[LeafKind::kParameter]);
  const reference::State<ScaledReal> state = {
      leaves[LeafKind::kTime][0], to_exact(leaves[LeafKind::kPosition]),
      to_exact(leaves[LeafKind::kVelocity]), to_exact(leaves[LeafKind::kInput])};
  const ExactVector& u = state.u;
  const auto terms = reference.evaluate(state, u);
  const auto same = [&](const char* what, const std::vector<ScaledReal>& values,
                        const std::vector<ScaledReal>& expected) {
    agreement.same(what, kReference, values, expected);
  };
  same("M", entries(symbolic.M()), entries(terms.M));
  same("k_bar", to_list(symbolic.k_bar()), to_list(terms.k_bar));
  same("q_bar", to_list(symbolic.q_bar()), to_list(terms.q_bar));
  if (!equations.ydot.empty())
    same("Z z", symbolic.values(equations.ydot), to_list(reference.position_rate(state)));
  same("energies", symbolic.values({equations.kinetic_energy, equations.potential_energy}),
       {terms.kinetic_energy, terms.potential_energy});
  if (mechanism.loops.empty()) {
    const auto start = reference.initial_state();
    same("initial y", symbolic.values(equations.initial_position), to_list(start.y));
    same("initial z", symbolic.values(equations.initial_velocity), to_list(start.z));
  }
  const ExactVector given = to_exact(leaves[LeafKind::kAcceleration]);
  const ExactVector bias = mechanism.loops.empty() ? ExactVector(ExactVector::Zero(given.size())) : given;
  const auto kinematics = reference.kinematics(state, given, bias);
  for (std::size_t k = 0; k < kinematics.size(); ++k) {
    JD_CHECK(kinematics[k].size() == equations.kinematics[k].size(), "arrays of function {}", k);
    for (std::size_t a = 0; a < kinematics[k].size(); ++a)
      same(mechanism.kinematics[k].name.c_str(), symbolic.values(equations.kinematics[k][a].values),
           kinematics[k][a].second);
  }
  if (!equations.samples.empty())
    same("samples", symbolic.values(dynamics::sampled_values(equations)),
         to_list(reference.sampled_states(state, u, leaves[LeafKind::kStepLength][0])));
  if (mechanism.outputs.empty()) return;
  const ExactVector zdot =
      equations.outputs_take_leaves ? to_exact(leaves[LeafKind::kAcceleration]) : symbolic.zdot();
  std::vector<ScaledReal> expected;
  for (const auto& output : reference.outputs(state, u, zdot, zdot.cwiseAbs()))
    expected.insert(expected.end(), output.values.begin(), output.values.end());
  same("outputs", symbolic.values(dynamics::output_entries(equations)), expected);
}

}  // namespace jourdain::validate
