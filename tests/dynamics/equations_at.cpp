#include "dynamics/equations_at.hpp"

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "extremes/extreme_scenes.hpp"

namespace jourdain::tests {

using kinematics::Ex;
using kinematics::LeafKind;

namespace {

double leaf(const model::Mechanism& mechanism, const StateNumbers& state, LeafKind kind, std::size_t i) {
  switch (kind) {
    case LeafKind::kConstant:
    case LeafKind::kParameter:
      return mechanism.parameters[i].value;
    case LeafKind::kPosition:
      return state.y.at(i);
    case LeafKind::kVelocity:
      return state.z.at(i);
    case LeafKind::kInput:
      return state.u.at(i);
    case LeafKind::kTime:
      return state.t;
    case LeafKind::kAcceleration:
    case LeafKind::kMultiplier:
    case LeafKind::kStepLength:
    case LeafKind::kHeld:
      return 0;
  }
  return 0;
}

}  // namespace

EquationsAt equations_at(const model::Mechanism& mechanism, const StateNumbers& state) {
  const dynamics::Equations e = dynamics::derive_equations(mechanism);
  const dynamics::HighPrecision exact(
      e.statements, [&](LeafKind kind, std::size_t i) { return leaf(mechanism, state, kind, i); });
  const auto number = [&](const Ex& value) { return dynamics::to_double(exact.value(value)); };
  const auto numbers = [&](const std::vector<Ex>& values) {
    std::vector<double> list;
    for (const Ex& value : values) list.push_back(number(value));
    return list;
  };
  EquationsAt result;
  for (const std::vector<Ex>& row : e.M) result.M.push_back(numbers(row));
  result.k_bar = numbers(e.k_bar);
  result.q_bar = numbers(e.q_bar);
  result.ydot = numbers(e.ydot);
  result.kinetic_energy = number(e.kinetic_energy);
  result.potential_energy = number(e.potential_energy);
  return result;
}

model::Mechanism one_body(const std::string& body, const std::string& joint, const std::string& more) {
  return read_scene("[model]\nname = \"one body\"\n[[body]]\nname = \"b\"\n" + body +
                    "\n[[joint]]\nname = \"j\"\nparent = \"world\"\nchild = \"b\"\n" + joint + "\n" + more);
}

}  // namespace jourdain::tests
