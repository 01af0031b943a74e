#include "model/bushing.hpp"

#include <algorithm>

namespace jourdain::model {

std::vector<Expression*> Bushing::expressions() {
  std::vector<Expression*> list;
  for (Vector3* triple : {&stiffness, &damping, &torsional_stiffness, &torsional_damping})
    for (Expression& number : *triple) list.push_back(&number);
  return list;
}

bool Bushing::conserves_energy() const {
  const auto is_zero = [](const Expression& number) { return number.is_zero(); };
  return std::all_of(damping.begin(), damping.end(), is_zero) &&
         std::all_of(torsional_damping.begin(), torsional_damping.end(), is_zero);
}

std::string Bushing::assumption() {
  return "a bushing turned by phi about one of its axes meets its torsional stiffness times sin(phi)";
}

}  // namespace jourdain::model
