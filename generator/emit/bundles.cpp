#include "emit/bundles.hpp"

namespace jourdain::emit {

using ir::ValueId;

Bundles::Bundles(const ir::Program& program)
    : program_(program), places_(program.nodes.size()), read_once_(program.lanes.size()) {
  for (std::size_t b = 0; b < program.lanes.size(); ++b)
    for (std::size_t l = 0; l < program.lanes[b].size(); ++l)
      places_[program.lanes[b][l].value] = Place{b, l};
  const std::vector<std::size_t> uses = ir::use_counts(program);
  std::vector<std::size_t> whole(program.lanes.size());
  for (const std::vector<ValueId>& bundle : program.lanes)
    for (int k = 0; k < ir::operand_count(program[bundle[0]].op); ++k) {
      const std::vector<ValueId> read = operands(bundle[0].value, k);
      if (are_bundle(read)) ++whole[places_[read[0].value]->bundle];
    }
  for (std::size_t b = 0; b < program.lanes.size(); ++b) {
    read_once_[b] = whole[b] == 1;
    for (const ValueId value : program.lanes[b]) read_once_[b] = read_once_[b] && uses[value.value] == 1;
  }
}

std::vector<ValueId> Bundles::together(std::size_t value) const {
  return places_[value] ? program_.lanes[places_[value]->bundle] : std::vector<ValueId>{ValueId(value)};
}

std::vector<ValueId> Bundles::operands(std::size_t value, int k) const {
  std::vector<ValueId> list;
  for (const ValueId lane : together(value)) list.push_back(k == 0 ? program_[lane].a : program_[lane].b);
  return list;
}

bool Bundles::are_bundle(const std::vector<ValueId>& values) const {
  const std::optional<Place>& first = places_[values[0].value];
  return first && program_.lanes[first->bundle] == values;
}

}  // namespace jourdain::emit
