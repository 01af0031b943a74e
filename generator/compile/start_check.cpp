#include "compile/start_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/joint_kinds.hpp"
#include "reference/massless.hpp"

namespace jourdain {

namespace {

using Vector = reference::VectorX<double>;

bool is_finite(const std::vector<reference::OutputValue<double>>& outputs) {
  for (const auto& output : outputs)
    for (const double value : output.values)
      if (!std::isfinite(value)) return false;
  return true;
}

/// Whether no acceleration is surely beyond double: of M ż = f some |ż_j| is at least |f_i| / Σ_j |M_ij|.
bool has_accelerations(const Eigen::MatrixXd& M, const Vector& f) {
  for (Eigen::Index i = 0; i < f.size(); ++i)
    if (const double row = M.row(i).cwiseAbs().sum(); row > 0 && !std::isfinite(f[i] / row)) return false;
  return true;
}

/// Everything that the equations consist of, at the initial state.
bool starts(const model::Mechanism& mechanism) {
  const reference::Reference<double> reference(mechanism);
  const auto state = reference.initial_state();
  const Vector u = Vector::Zero(Eigen::Index(reference.input_count()));
  const auto terms = reference.evaluate(state, u);
  constexpr double kStep = 1;  // of any length: at t = 0 all memories are sampled
  const Vector none = Vector::Zero(Eigen::Index(reference.coordinate_count()));
  return std::isfinite(terms.kinetic_energy + terms.potential_energy) && terms.M.allFinite() &&
         terms.k_bar.allFinite() && terms.q_bar.allFinite() &&
         has_accelerations(terms.M, terms.k_bar - terms.q_bar) &&
         reference.sampled_states(state, u, kStep).allFinite() &&
         is_finite(reference.outputs(state, u, none, none));
}

/// The mechanism without forces and outputs. What expressions have numbers of stays: actuators, whose inputs are zero,
/// and states, which stand still.
model::Mechanism bare(const model::Mechanism& mechanism) {
  model::Mechanism rest = mechanism;
  for_each_force_list(rest, [](auto& list) { list.clear(); });
  rest.actuators = mechanism.actuators;
  rest.states = mechanism.states;
  for (model::StateVariable& state : rest.states) {
    state.rate = 0.0;
    state.sampled.reset();
  }
  rest.outputs.clear();
  return rest;
}

/// Of a mechanism that has no finite values even without forces and outputs: the body without whose mass and inertia it
/// has them, else a joint that follows a curve or a motion, else the first joint.
support::SourceRange suspect(const model::Mechanism& mechanism) {
  for (const model::Body& body : mechanism.bodies) {
    model::Mechanism light = bare(mechanism);
    model::Body& lighter = light.bodies[std::size_t(&body - mechanism.bodies.data())];
    lighter.mass = 0.0;
    lighter.inertia = {};
    if (starts(light)) return body.mass_where.line > 0 ? body.mass_where : body.where;
  }
  for (const model::Joint& joint : mechanism.joints)
    for (const model::Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion || model::joint_kind(joint).has(model::MotionKind::kCurve)) return joint.where;
  return mechanism.joints.front().where;
}

template <class Element>
void put(const model::Mechanism&, const Element& element, std::vector<Element>& list) {
  list = {element};
}

void put(const model::Mechanism& mechanism, const model::StateVariable& state,
         std::vector<model::StateVariable>& list) {
  list[std::size_t(&state - mechanism.states.data())] = state;
}

/// Tries an element alone, put into the `list` of its kind, and reports it if it has no value.
template <class Element, class List>
void report(const model::Mechanism& mechanism, const Element& element, const List& list,
            std::string_view kind, support::Diagnostics& diagnostics) {
  model::Mechanism alone = bare(mechanism);
  put(mechanism, element, list(alone));
  if (starts(alone)) return;
  diagnostics.error(
      element.where,
      fmt::format("{} '{}' has no finite value at the initial state", kind, support::shown(element.name)),
      "at t = 0, with inputs zero");
}

void report_singular(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  if (!mechanism.loops.empty()) return;  // judged where they are closed
  const auto state = reference::Reference<long double>(mechanism).initial_state();
  const std::vector<model::JointIndex> singular = reference::singular_joints(mechanism, state);
  if (singular.empty() || !reference::massless_joints(mechanism).empty())
    return;  // those check_inertia reports
  for (const model::JointIndex index : singular) {
    const model::Joint& joint = mechanism.joints[index.value];
    diagnostics.error(
        joint.where,
        fmt::format("joint '{}' moves no inertia at the initial state", support::shown(joint.name)),
        "the mass matrix is singular there: start from another position");
  }
}

}  // namespace

void check_start(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  if (starts(mechanism)) return report_singular(mechanism, diagnostics);
  if (!starts(bare(mechanism))) {
    diagnostics.error(suspect(mechanism),
                      "the mechanism's equations have no finite values at the initial state",
                      "a curve or a motion may be singular there, or a number too large");
    return;
  }
  for_each_force_element(mechanism, [&]<class Element>(const Element& element) {
    report(mechanism, element, model::list_of<Element>, Element::kKind, diagnostics);
  });
  for (const model::Output& output : mechanism.outputs)
    report(
        mechanism, output, [](model::Mechanism & alone) -> auto& { return alone.outputs; }, "output",
        diagnostics);
}

}  // namespace jourdain
