// The one list of everything applied that a description adds to its bodies and joints. Whoever treats force elements
// visits it, by a function of each kind or by what each kind answers: one that is forgotten does not compile.
//
// A kind has these members, beside its data, `name` and `where`:
//
//   kKind               what messages call it
//   pushed()            the scalar coordinate that it acts on, if it acts on one
//   ends()              the frames that it acts at, which are on its bodies
//   expressions()       all that it holds; each is of parameters and of what its description says
//   conserves_energy()  whether what it does is stored in its potential; of an actuator while its input is zero
//   assumption()        sentence about all elements of the kind, empty: nothing to say
//
// A new kind: its description in a file of this folder; its line in ForceElements and its name in
// `for_each_force_list`; its reader (read/); its forces and potential (dynamics/element_forces.hpp) and,
// sharing nothing with those, the numbers of both references (reference/minimal_elements.hpp,
// reference/descriptor_elements.hpp).
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "model/actuator.hpp"
#include "model/bushing.hpp"
#include "model/coordinate_force.hpp"
#include "model/frame_load.hpp"
#include "model/spring.hpp"
#include "model/state_variable.hpp"

namespace jourdain::model {

/// By kind, each as declared. Inputs are numbered by the actuators.
struct ForceElements {
  std::vector<Actuator> actuators;
  std::vector<CoordinateForce> coordinate_forces;
  std::vector<Spring> springs;
  std::vector<Load> loads;
  std::vector<Bushing> bushings;
  std::vector<StateVariable> states;  ///< the last entries of z, in this order
};

/// Calls `visit` with the list of each kind, in the order of ForceElements, const lists of const elements.
template <class Elements, class Visit>
requires std::is_base_of_v<ForceElements, std::remove_const_t<Elements>>
void for_each_force_list(Elements& all, Visit&& visit) {
  using Lists = std::conditional_t<std::is_const_v<Elements>, const ForceElements, ForceElements>;
  auto& [actuators, coordinate_forces, springs, loads, bushings, states] = static_cast<Lists&>(all);
  const auto each = [&visit](auto&... lists) { (visit(lists), ...); };
  each(actuators, coordinate_forces, springs, loads, bushings, states);
}

/// Calls `visit` with each element.
template <class Elements, class Visit>
void for_each_force_element(Elements& all, Visit&& visit) {
  for_each_force_list(all, [&visit](auto& list) {
    for (auto& element : list) visit(element);
  });
}

/// Whether `holds` says so of some element.
template <class Holds>
bool any_force_element(const ForceElements& all, const Holds& holds) {
  bool any = false;
  for_each_force_element(all, [&](const auto& element) { any = any || holds(element); });
  return any;
}

/// The elements of one kind.
template <class Element>
std::vector<Element>& list_of(ForceElements& all) {
  std::vector<Element>* found = nullptr;
  for_each_force_list(all, [&found](auto& list) {
    if constexpr (std::is_same_v<decltype(list), std::vector<Element>&>) found = &list;
  });
  return *found;
}

/// Whether `holds` says so of a variable of one of the element's expressions.
template <class Element, class Holds>
bool any_variable(Element element, const Holds& holds) {
  const std::vector<Expression*> expressions = element.expressions();
  return std::any_of(expressions.begin(), expressions.end(),
                     [&](const Expression* e) { return any_variable(*e, holds); });
}

/// Whether a state is sampled where a step begins.
inline bool has_samples(const ForceElements& all) {
  return std::any_of(all.states.begin(), all.states.end(),
                     [](const StateVariable& state) { return state.sampled.has_value(); });
}

/// Whether there is no element but actuators, whose forces are inputs.
inline bool has_inputs_alone(const ForceElements& all) {
  std::size_t count = 0;
  for_each_force_list(all, [&count](const auto& list) { count += list.size(); });
  return count == all.actuators.size();
}

}  // namespace jourdain::model
