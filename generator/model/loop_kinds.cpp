#include "model/loop_kinds.hpp"

#include <algorithm>

#include "support/enumerators.hpp"

namespace jourdain::model {

namespace {

constexpr LoopRow kX{"x"}, kY{"y"}, kZ{"z"}, kA1D{"a1_d"}, kA2D{"a2_d"}, kA1W{"a1_w", false},
    kA2W{"a2_w", false};
constexpr LoopRow kBall[] = {kX, kY, kZ};
constexpr LoopRow kRevolute[] = {kX, kY, kZ, kA1W, kA2W};
constexpr LoopRow kUniversal[] = {kX, kY, kZ, {"n_w", false}};
constexpr LoopRow kPrismatic[] = {kA1D, kA2D, kA1W, kA2W, {"a1_b2", false}};
constexpr LoopRow kCylindrical[] = {kA1D, kA2D, kA1W, kA2W};
constexpr LoopRow kPlanarPin[] = {{"c1_d"}, {"c2_d"}};
constexpr LoopRow kPointInPlane[] = {{"n_d"}};
constexpr LoopRow kPointOnLine[] = {kA1D, kA2D};
constexpr LoopRow kRod[] = {{"length"}};
constexpr LoopRow kResidual[] = {{"residual", false}};

constexpr std::string_view kEnds[] = {"from", "to"};
constexpr std::string_view kAxis[] = {"from", "to", "axis"};
constexpr std::string_view kAxes[] = {"from", "to", "axis", "to_axis"};
constexpr std::string_view kLength[] = {"from", "to", "length"};
constexpr std::string_view kExpression[] = {"residual"};

constexpr auto kKinds = std::to_array<LoopKind>({
    {LoopType::kBall, "ball", kBall, kEnds},
    {LoopType::kRevolute, "revolute", kRevolute, kAxes},
    {LoopType::kUniversal, "universal", kUniversal, kAxes},
    {LoopType::kPrismatic, "prismatic", kPrismatic, kAxes},
    {LoopType::kCylindrical, "cylindrical", kCylindrical, kAxes},
    {LoopType::kPlanarPin, "planar_pin", kPlanarPin, kAxis},
    {LoopType::kPointInPlane, "point_in_plane", kPointInPlane, kAxis},
    {LoopType::kPointOnLine, "point_on_line", kPointOnLine, kAxis},
    {LoopType::kRod, "rod", kRod, kLength},
    {LoopType::kResidual, "residual", kResidual, kExpression},
});
static_assert(support::is_complete(kKinds, &LoopKind::type), "a row for each LoopType, in their order");

}  // namespace

bool LoopKind::takes(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }

const LoopKind& loop_kind(LoopType type) { return kKinds[static_cast<std::size_t>(type)]; }

std::size_t row_count(LoopType type) { return loop_kind(type).rows.size(); }

const std::vector<std::string>& loop_type_names() {
  static const std::vector<std::string> names = support::names_of(kKinds);
  return names;
}

}  // namespace jourdain::model
