#include "loops/closed_form/position_request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/angular_entries.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

namespace {

bool is_among(const std::vector<std::size_t>& list, std::size_t k) {
  return std::find(list.begin(), list.end(), k) != list.end();
}

std::string names_of(const Block& block, const model::CoordinateLayout& layout) {
  std::vector<std::string> names;
  for (const std::size_t k : block.dependents) names.push_back(layout.velocity_names[k]);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::variant<ClosedFormRequest, std::string> position_request(const model::Mechanism& mechanism,
                                                              const ConstraintPrograms& constraints,
                                                              const LoopPlan& plan) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const model::Tangent tangent = layout.tangent;
  ClosedFormRequest request;
  request.g = constraints.value;
  request.spans = constraints.spans;
  request.jacobian = constraints.jacobian;
  for (const Block& block : plan.blocks) {
    if (!block.binds_positions) {
      request.velocities.push_back({block.rows, block.dependents, names_of(block, layout)});
      continue;
    }
    PositionBlock& positions = request.blocks.emplace_back();
    positions.rows = block.rows;
    for (const model::Tangent::Scalar& scalar : tangent.scalars)
      if (is_among(block.dependents, scalar.velocity)) positions.dependents.push_back(scalar.position);
    for (const model::Tangent::Scalar& rotation : tangent.quaternions) {
      const std::size_t count = is_among(block.dependents, rotation.velocity) +
                                is_among(block.dependents, rotation.velocity + 1) +
                                is_among(block.dependents, rotation.velocity + 2);
      if (count == 0) continue;
      if (count < 3) return "a rotation in space depends on other coordinates in part";
      if (positions.rotation) return "two rotations in space depend on each other";
      positions.rotation = rotation.position;
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
