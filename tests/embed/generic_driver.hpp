// One driver for every emitted model: a template over Model that finds the functions by argument-dependent lookup and
// leaves out what a scene does not have.
#pragma once

namespace jourdain::tests {

/// Everything that a model can tell about one state.
template <class Model>
struct Results {
  using Real = typename Model::Scalar;
  static constexpr int ny = Model::position_count, nz = Model::velocity_count;

  Real M[nz > 0 ? nz : 1][nz > 0 ? nz : 1] = {};
  Real k[nz > 0 ? nz : 1] = {}, q[nz > 0 ? nz : 1] = {}, zdot[nz > 0 ? nz : 1] = {},
                       tau[nz > 0 ? nz : 1] = {};
  Real ydot[ny > 0 ? ny : 1] = {};
  Real kinetic{}, potential{};
};

/// Calls `visit(name, call)` with each function of the model, `call` being the call of it that fills `results`; inverse
/// dynamics come after forward dynamics and take their accelerations.
template <class Model, class Visit>
void visit_functions(const Model& model, const typename Model::State& state,
                     const typename Model::Input& input, Results<Model>& results, Visit&& visit) {
  visit("initial_state", [&] { initial_state(model); });
  if constexpr (Model::velocity_count > 0) {
    visit("mass_matrix", [&] { mass_matrix(model, state, results.M); });
    visit("k_bar", [&] {
      if constexpr (requires { k_bar(model, state, results.k); })
        k_bar(model, state, results.k);
      else  // prescribed accelerations depend on inputs
        k_bar(model, state, input, results.k);
    });
    visit("q_bar", [&] { q_bar(model, state, input, results.q); });
    visit("forward_dynamics", [&] { forward_dynamics(model, state, input, results.zdot); });
    visit("inverse_dynamics", [&] {
      if constexpr (requires { inverse_dynamics(model, state, results.zdot, results.tau); })
        inverse_dynamics(model, state, results.zdot, results.tau);
      else
        inverse_dynamics(model, state, input, results.zdot, results.tau);
    });
  }
  if constexpr (Model::position_count != Model::velocity_count)
    visit("position_rate", [&] { position_rate(model, state, results.ydot); });
  if constexpr (Model::output_count > 0)
    visit("outputs", [&] {
      typename Model::Outputs values;
      outputs(model, state, input, values);
    });
  visit("kinetic_energy", [&] { results.kinetic = kinetic_energy(model, state); });
  visit("potential_energy", [&] { results.potential = potential_energy(model, state); });
}

/// `y` of a state, or nothing where there is none.
template <class State, class Visit>
void for_positions(State& state, Visit&& visit) {
  if constexpr (requires { state.y; })
    for (auto& position : state.y) visit(position);
}

}  // namespace jourdain::tests
