#include "model/joint_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "support/check.hpp"
#include "support/enumerators.hpp"

namespace jourdain::model {

namespace {

using Kind = MotionKind;

constexpr JointMotion kRevolute[] = {{Kind::kTurn, Along::kAxis}};
constexpr JointMotion kPrismatic[] = {{Kind::kSlide, Along::kAxis}};
constexpr JointMotion kScrew[] = {{Kind::kScrew, Along::kAxis}};
constexpr JointMotion kCylindrical[] = {{Kind::kTurn, Along::kAxis, "angle"},
                                        {Kind::kSlide, Along::kAxis, "slide"}};
constexpr JointMotion kUniversal[] = {{Kind::kTurn, Along::kAxis, "first"},
                                      {Kind::kTurn, Along::kSecondAxis, "second"}};
constexpr JointMotion kPlanar[] = {{Kind::kSlide, Along::kFirstInPlane, "x"},
                                   {Kind::kSlide, Along::kSecondInPlane, "y"},
                                   {Kind::kTurn, Along::kAxis, "angle"}};
constexpr JointMotion kSpherical[] = {{Kind::kBall}};
constexpr JointMotion kFree[] = {{Kind::kFree}};
constexpr JointMotion kCurve[] = {{Kind::kCurve}};
constexpr JointMotion kGimbal[] = {{Kind::kTurn, Along::kFirstAxis, "first"},
                                   {Kind::kTurn, Along::kMiddleAxis, "second"},
                                   {Kind::kTurn, Along::kLastAxis, "third"}};
constexpr JointMotion kPoint[] = {
    {Kind::kSlide, Along::kX, "x"}, {Kind::kSlide, Along::kY, "y"}, {Kind::kSlide, Along::kZ, "z"}};

constexpr std::string_view kAxis[] = {"axis"};
constexpr std::string_view kAxisAndPitch[] = {"axis", "pitch"};
constexpr std::string_view kAxes[] = {"axis", "second_axis"};
constexpr std::string_view kTurning[] = {"damping", "initial_orientation", "initial_angular_velocity"};
constexpr std::string_view kMoving[] = {"initial_position", "initial_velocity", "initial_orientation",
                                        "initial_angular_velocity"};
constexpr std::string_view kOnCurve[] = {"curve"};
constexpr std::string_view kSequence[] = {"sequence"};

constexpr auto kKinds = std::to_array<JointKind>({
    {JointType::kFixed, "fixed", {}, {}},
    {JointType::kRevolute, "revolute", kRevolute, kAxis, LoopType::kRevolute},
    {JointType::kPrismatic, "prismatic", kPrismatic, kAxis, LoopType::kPrismatic},
    {JointType::kScrew, "screw", kScrew, kAxisAndPitch},
    {JointType::kCylindrical, "cylindrical", kCylindrical, kAxis, LoopType::kCylindrical},
    {JointType::kUniversal, "universal", kUniversal, kAxes, LoopType::kUniversal},
    {JointType::kPlanar, "planar", kPlanar, kAxis},
    {JointType::kSpherical, "spherical", kSpherical, kTurning, LoopType::kBall},
    {JointType::kFree, "free", kFree, kMoving},
    {JointType::kCurve, "curve", kCurve, kOnCurve},
    {JointType::kGimbal, "gimbal", kGimbal, kSequence, LoopType::kBall},
    {JointType::kPoint, "point", kPoint, {}},
});
static_assert(support::is_complete(kKinds, &JointKind::type), "a row for each JointType, in their order");

std::array<double, 3> unit_axis(std::size_t index) {
  std::array<double, 3> axis{0, 0, 0};
  axis.at(index) = 1;
  return axis;
}

}  // namespace

bool JointKind::has(MotionKind kind) const {
  return std::ranges::any_of(motions, [kind](const JointMotion& motion) { return motion.kind == kind; });
}

bool JointKind::has(Along along) const {
  return std::ranges::any_of(motions, [along](const JointMotion& motion) { return motion.along == along; });
}

bool JointKind::takes(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }

bool JointKind::has_axis() const { return takes("axis"); }

const JointMotion* JointKind::plain_motion() const {
  if (motions.size() != 1) return nullptr;
  const JointMotion& only = motions.front();
  return only.kind == Kind::kTurn || only.kind == Kind::kSlide ? &only : nullptr;
}

const JointKind& joint_kind(JointType type) { return kKinds[static_cast<std::size_t>(type)]; }

const std::vector<std::string>& joint_type_names() {
  static const std::vector<std::string> names = support::names_of(kKinds);
  return names;
}

std::string sequence_text(const Joint& joint) {
  std::string text;
  for (const std::size_t axis : joint.sequence) text += "xyz"[axis];
  return text;
}

void Joint::set_type(JointType new_type) {
  type = new_type;
  coordinates.clear();
  for (const JointMotion& motion : joint_kind(type).coordinates()) {
    Coordinate coordinate;
    coordinate.name = motion.suffix.empty() ? name : fmt::format("{}_{}", name, motion.suffix);
    coordinate.angular = motion.is_angular();
    coordinates.push_back(coordinate);
  }
}

std::array<double, 3> direction(const Joint& joint, const JointMotion& motion) {
  switch (motion.along) {
    case Along::kAxis:
      return joint.axis;
    case Along::kSecondAxis:
      return joint.second_axis;
    case Along::kFirstInPlane:
      return slide_directions(joint.axis)[0];
    case Along::kSecondInPlane:
      return slide_directions(joint.axis)[1];
    case Along::kFirstAxis:
      return unit_axis(joint.sequence[0]);
    case Along::kMiddleAxis:
      return unit_axis(joint.sequence[1]);
    case Along::kLastAxis:
      return unit_axis(joint.sequence[2]);
    case Along::kX:
      return unit_axis(0);
    case Along::kY:
      return unit_axis(1);
    case Along::kZ:
      return unit_axis(2);
    case Along::kNone:
      break;
  }
  throw support::InternalError("a motion without a direction");
}

}  // namespace jourdain::model
