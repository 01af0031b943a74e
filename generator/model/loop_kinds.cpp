#include "model/loop_kinds.hpp"

#include <fmt/format.h>

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
constexpr LoopRow kVelocity[] = {{"velocity", false, false}};
constexpr LoopRow kKnifeEdge[] = {{"slip", true, false}};
constexpr LoopRow kRolling[] = {{"height"}, {"slip_1", true, false}, {"slip_2", true, false}};

constexpr std::string_view kEnds[] = {"from", "to"};
constexpr std::string_view kAxis[] = {"from", "to", "axis"};
constexpr std::string_view kAxes[] = {"from", "to", "axis", "to_axis"};
constexpr std::string_view kLength[] = {"from", "to", "length"};
constexpr std::string_view kExpression[] = {"residual"};
constexpr std::string_view kOfVelocities[] = {"velocity"};
constexpr std::string_view kBlade[] = {"frame", "axis", "plane"};
constexpr std::string_view kWheel[] = {"frame", "axis", "radius", "plane", "normal", "height", "approaches"};
constexpr std::string_view kRound[] = {"frame", "radius", "plane", "normal", "height", "approaches"};
constexpr std::string_view kEllipsoid[] = {"frame", "radii", "plane", "normal", "height", "approaches"};

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
    {LoopType::kVelocity, "velocity", kVelocity, kOfVelocities},
    {LoopType::kKnifeEdge, "knife_edge", kKnifeEdge, kBlade},
    {LoopType::kRollingWheel, "rolling_wheel", kRolling, kWheel},
    {LoopType::kRollingBall, "rolling_ball", kRolling, kRound},
    {LoopType::kRollingEllipsoid, "rolling_ellipsoid", kRolling, kEllipsoid},
});
static_assert(support::is_complete(kKinds, &LoopKind::type), "a row for each LoopType, in their order");

}  // namespace

bool LoopKind::takes(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }

const LoopKind& loop_kind(LoopType type) { return kKinds[static_cast<std::size_t>(type)]; }

std::size_t row_count(LoopType type) { return loop_kind(type).rows.size(); }

std::string in_words(const Loop& loop) {
  return fmt::format("{} '{}'", loop_kind(loop).is_constraint() ? "constraint" : "loop",
                     support::shown(loop.name));
}

const Loop* bar_without_length(const Mechanism& mechanism, const std::vector<double>& parameters, double t) {
  for (const Loop& loop : mechanism.loops) {
    if (!loop_kind(loop).is_bar()) continue;
    const auto length = loop.length.evaluate<double>(
        parameters, [](double v) { return v; }, [t](const Variable&) { return t; });
    if (!(length > 0)) return &loop;
  }
  return nullptr;
}

const Loop& loop_of_row(const Mechanism& mechanism, std::size_t row) {
  std::size_t loop = 0;
  for (std::size_t first = 0; row >= first + row_count(mechanism.loops[loop].type); ++loop)
    first += row_count(mechanism.loops[loop].type);
  return mechanism.loops[loop];
}

bool binds_velocities(const Mechanism& mechanism) {
  return std::ranges::any_of(mechanism.loops, [](const Loop& loop) {
    return std::ranges::any_of(loop_kind(loop).rows, [](const LoopRow& row) { return !row.has_position; });
  });
}

namespace {

std::vector<std::string> names_of(bool constraints) {
  std::vector<std::string> names;
  for (const LoopKind& kind : kKinds)
    if (kind.is_constraint() == constraints) names.emplace_back(kind.name);
  return names;
}

}  // namespace

const std::vector<std::string>& loop_type_names() {
  static const std::vector<std::string> names = names_of(false);
  return names;
}

const std::vector<std::string>& constraint_type_names() {
  static const std::vector<std::string> names = names_of(true);
  return names;
}

}  // namespace jourdain::model
