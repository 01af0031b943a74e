#include "loops/position_request.hpp"

#include <algorithm>

#include "model/angles.hpp"
#include "model/checks.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

std::variant<ClosedFormRequest, std::string> position_request(const model::Mechanism& mechanism,
                                                              const ConstraintPrograms& constraints,
                                                              const LoopPlan& plan) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const model::Tangent tangent = model::tangent_of(mechanism, layout);
  ClosedFormRequest request;
  request.g = constraints.value;
  for (const Block& block : plan.blocks) {
    PositionBlock& positions = request.blocks.emplace_back();
    positions.rows = block.rows;
    for (const std::size_t velocity : block.dependents) {
      const auto scalar = std::find_if(tangent.scalars.begin(), tangent.scalars.end(),
                                       [&](const auto& s) { return s.velocity == velocity; });
      if (scalar == tangent.scalars.end()) return "a rotation in space depends on other coordinates";
      positions.dependents.push_back(scalar->position);
    }
  }
  request.initial_y = plan.y;
  request.parameters = model::default_values(mechanism);
  request.angular = model::angular_positions(mechanism);
  request.range = position_ranges(mechanism);
  request.names = layout.position_names;
  for (const model::Parameter& parameter : mechanism.parameters) {
    request.parameter_range.push_back(parameter.range);
    request.parameter_names.push_back(parameter.name);
  }
  return request;
}

std::vector<std::optional<std::array<double, 2>>> position_ranges(const model::Mechanism& mechanism) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<std::optional<std::array<double, 2>>> ranges(layout.position_count());
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].position[c])
        ranges[*entry] = mechanism.joints[j].coordinates[c].range;
  return ranges;
}

}  // namespace jourdain::loops
