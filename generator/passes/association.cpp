#include "passes/association.hpp"

namespace jourdain::passes {

std::vector<ir::Signed> places_in(Copy& copy, ir::Op op, const Association& association) {
  std::vector<ir::Signed> places;
  for (const ir::Signed& term : association.terms)
    places.push_back(term.negative ? -copy[term.value] : copy[term.value]);
  for (const auto& [a, b] : association.steps)
    places.push_back(op == ir::Op::kAdd ? copy.builder().add(places[a], places[b])
                                        : copy.builder().multiply(places[a], places[b]));
  return places;
}

}  // namespace jourdain::passes
