#include "model/kinematic_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/c_names.hpp"
#include "support/enumerators.hpp"

namespace jourdain::model {

namespace {

constexpr ArrayExtent k3[] = {ArrayExtent::kThree}, k6[] = {ArrayExtent::kSix},
                      k3x3[] = {ArrayExtent::kThree, ArrayExtent::kThree},
                      k6x6[] = {ArrayExtent::kSix, ArrayExtent::kSix}, kN[] = {ArrayExtent::kVelocities},
                      k3xN[] = {ArrayExtent::kThree, ArrayExtent::kVelocities},
                      k6xN[] = {ArrayExtent::kSix, ArrayExtent::kVelocities};

constexpr KinematicArray kPose[] = {{"position", k3, "m"}, {"rotation", k3x3, "1"}};
constexpr KinematicArray kVelocity[] = {{"velocity", k6, "m/s, rad/s"}};
constexpr KinematicArray kAcceleration[] = {{"acceleration", k6, "m/s^2, rad/s^2"}};
constexpr KinematicArray kImu[] = {{"specific_force", k3, "m/s^2"}, {"angular_velocity", k3, "rad/s"}};
constexpr KinematicArray kJacobian[] = {{"J", k6xN, ""}, {"drift", k6, "m/s, rad/s", true}};
constexpr KinematicArray kJacobianBias[] = {{"bias", k6, "m/s^2, rad/s^2"}};
constexpr KinematicArray kCenterOfMass[] = {{"center_of_mass", k3, "m"}};
constexpr KinematicArray kCenterOfMassJacobian[] = {{"J_com", k3xN, ""}, {"drift_com", k3, "m/s", true}};
constexpr KinematicArray kCenterOfMassBias[] = {{"bias_com", k3, "m/s^2"}};
constexpr KinematicArray kMomentum[] = {{"momentum", k6, "N s, N m s"}};
constexpr KinematicArray kMomentumMatrix[] = {{"A", k6xN, ""}, {"drift_momentum", k6, "N s, N m s", true}};
constexpr KinematicArray kMomentumBias[] = {{"bias_momentum", k6, "N, N m"}};
constexpr KinematicArray kGravity[] = {{"tau_gravity", kN, "N m or N"}};
constexpr KinematicArray kInverseInertia[] = {{"inverse_inertia", k6x6, ""}};

constexpr auto kRows = std::to_array<QuantityRow>({
    {KinematicQuantity::kPose, "pose", true, false, false, false, kPose,
     "position: origin of '{}' in world axes, m. rotation: its axes are the columns."},
    {KinematicQuantity::kVelocity, "velocity", true, true, false, false, kVelocity,
     "velocity: of '{}', linear (m/s) before angular (rad/s)."},
    {KinematicQuantity::kAcceleration, "acceleration", true, true, true, true, kAcceleration,
     "acceleration: of '{0}'{1}, linear (m/s^2) before angular (rad/s^2)."},
    {KinematicQuantity::kImu, "imu", true, false, true, true, kImu,
     "specific_force: acceleration of '{0}'{1} less gravity, m/s^2, which an accelerometer "
     "there "
     "reads;\nangular_velocity: rad/s, which a gyroscope reads. Both in its own axes."},
    {KinematicQuantity::kJacobian, "jacobian", true, true, false, false, kJacobian,
     "J: Jacobian of '{}', velocity = J z, linear rows before angular rows."},
    {KinematicQuantity::kJacobianBias, "jacobian_bias", true, true, false, true, kJacobianBias,
     "bias: acceleration of '{}' at zdot = 0, so that acceleration = J zdot + bias."},
    {KinematicQuantity::kCenterOfMass, "center_of_mass", false, false, false, false, kCenterOfMass,
     "center_of_mass: of all bodies, in world axes, m."},
    {KinematicQuantity::kCenterOfMassJacobian, "center_of_mass_jacobian", false, false, false, false,
     kCenterOfMassJacobian, "J_com: velocity of the centre of mass of all bodies = J_com z, world axes."},
    {KinematicQuantity::kCenterOfMassBias, "center_of_mass_bias", false, false, false, true,
     kCenterOfMassBias, "bias_com: acceleration of the centre of mass at zdot = 0, world axes, m/s^2."},
    {KinematicQuantity::kMomentum, "momentum", false, false, false, false, kMomentum,
     "momentum: linear (N s), then angular about the centre of mass (N m s), world axes; rotors are not in "
     "it."},
    {KinematicQuantity::kCentroidalMomentumMatrix, "centroidal_momentum_matrix", false, false, false, false,
     kMomentumMatrix,
     "A: momentum = A z, linear rows, then angular ones about the centre of mass, world axes."},
    {KinematicQuantity::kCentroidalMomentumBias, "centroidal_momentum_bias", false, false, false, true,
     kMomentumBias,
     "bias_momentum: rate of the momentum at zdot = 0, so that its rate = A zdot + bias_momentum, N, N m."},
    {KinematicQuantity::kGravityCompensation, "gravity_compensation", false, false, false, false, kGravity,
     "tau_gravity: generalized forces that hold the mechanism against gravity alone, N m or N."},
    {KinematicQuantity::kInverseOperationalInertia, "inverse_operational_inertia", true, true, false, false,
     kInverseInertia,
     "inverse_inertia: J M^-1 J^T of '{}', the inverse of the operational-space inertia where that has one; "
     "of\nloops "
     "that multipliers hold with M^-1 of what they leave free. Force linear before angular, as for J; "
     "acceleration\nper "
     "unit of force. Both triangles are filled."},
});
static_assert(support::is_complete(kRows, &QuantityRow::quantity),
              "a row for each KinematicQuantity, in their order");

struct AxesRow {
  Axes axes = Axes::kWorldAligned;
  std::string_view name;
  std::string_view text;
};

constexpr auto kAxesRows = std::to_array<AxesRow>({
    {Axes::kWorldAligned, "world_aligned",
     "Of the frame's origin, in world axes (Pinocchio: LOCAL_WORLD_ALIGNED; the geometric Jacobian)."},
    {Axes::kFrame, "frame",
     "Of the frame's origin, in the frame's axes (Pinocchio: LOCAL; the body Jacobian); the "
     "linear\nacceleration is "
     "the origin's, not the spatial one."},
    {Axes::kWorld, "world",
     "Spatial: of the point of the body that is at the world's origin, in world axes (Pinocchio: WORLD)."},
});
static_assert(support::is_complete(kAxesRows, &AxesRow::axes), "a row for each Axes, in their order");

}  // namespace

const QuantityRow& quantity_row(KinematicQuantity quantity) {
  return kRows[static_cast<std::size_t>(quantity)];
}

const std::vector<std::string>& quantity_names() {
  static const std::vector<std::string> names = support::names_of(kRows);
  return names;
}

std::optional<KinematicQuantity> quantity_named(std::string_view name) {
  const std::vector<std::string>& names = quantity_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return {};
  return static_cast<KinematicQuantity>(found - names.begin());
}

const std::vector<std::string>& axes_names() {
  static const std::vector<std::string> names = support::names_of(kAxesRows);
  return names;
}

std::string_view axes_text(Axes axes) { return kAxesRows[static_cast<std::size_t>(axes)].text; }

std::optional<std::size_t> kinematic_function_named(const Mechanism& mechanism, std::string_view name) {
  for (std::size_t k = 0; k < mechanism.kinematics.size(); ++k)
    if (mechanism.kinematics[k].name == name) return k;
  return {};
}

bool takes_acceleration(const KinematicFunction& function) {
  return std::any_of(function.quantities.begin(), function.quantities.end(),
                     [](KinematicQuantity quantity) { return quantity_row(quantity).takes_acceleration; });
}

bool holds_accelerations(const KinematicFunction& function) {
  return std::any_of(function.quantities.begin(), function.quantities.end(),
                     [](KinematicQuantity quantity) { return quantity_row(quantity).holds_accelerations; });
}

std::variant<std::vector<KinematicQuantity>, KinematicError> parse_quantities(std::string_view text,
                                                                              bool of_frame) {
  std::vector<KinematicQuantity> quantities;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    const std::string word(text.substr(begin, end - begin));
    begin = end + 1;
    std::vector<std::string> known;
    for (const QuantityRow& row : kRows)
      if (row.of_frame == of_frame) known.emplace_back(row.name);
    const std::optional<KinematicQuantity> quantity = quantity_named(word);
    if (!quantity) {
      const std::string near = support::nearest(word, quantity_names());
      return KinematicError{fmt::format("there is no quantity '{}'", support::shown(word)),
                            near.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean '{}'?", near)};
    }
    if (quantity_row(*quantity).of_frame != of_frame)
      return KinematicError{of_frame ? fmt::format("'{}' is of the whole mechanism, not of a frame", word)
                                     : fmt::format("'{}' is of a frame", word),
                            of_frame ? "a [[kinematics]] without 'frame' has it" : "name its frame"};
    if (std::find(quantities.begin(), quantities.end(), *quantity) != quantities.end())
      return KinematicError{fmt::format("'{}' stands twice in '{}'", word, support::shown(text)), ""};
    quantities.push_back(*quantity);
  }
  return quantities;
}

namespace {

/// At the parameters' default values, kg.
double total_mass(const Mechanism& mechanism) {
  const std::vector<double> parameters = default_values(mechanism);
  double mass = 0;
  for (const Body& body : mechanism.bodies) mass += body.mass.evaluate<double>(parameters);
  return mass;
}

/// In C, constants `y_NAME`, `z_NAME` and `u_NAME` are the entries of coordinates, states and inputs.
std::string entry_with_constant(const Mechanism& mechanism, const std::string& constant) {
  if (constant.size() < 3 || constant[1] != '_') return "";
  std::string name = constant.substr(2);
  const auto has = [&name](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const auto& element) { return element.name == name; });
  };
  const bool is_coordinate =
      std::any_of(mechanism.joints.begin(), mechanism.joints.end(), [&](const Joint& joint) {
        return std::any_of(joint.coordinates.begin(), joint.coordinates.end(),
                           [&](const Coordinate& c) { return !c.motion && c.name == name; });
      });
  const char letter = constant[0];
  if ((letter == 'y' || letter == 'z') && is_coordinate) return name;
  if (letter == 'z' && has(mechanism.states)) return name;
  if (letter == 'u' && (has(mechanism.actuators) || has(mechanism.inputs))) return name;
  return "";
}

}  // namespace

std::string add_kinematic_function(Mechanism& mechanism, const std::string& prefix,
                                   std::optional<FrameIndex> frame, Axes axes,
                                   const std::vector<KinematicQuantity>& quantities, SourceRange where) {
  KinematicFunction function{prefix, frame, axes, quantities, where};
  for (const KinematicQuantity quantity : quantities) {
    if (!function.name.empty()) function.name += '_';
    function.name += quantity_row(quantity).name;
  }
  if (function.name.find("__") != std::string::npos || function.name.starts_with('_'))
    return fmt::format("'{}' would be a name that is reserved in C++", function.name);
  if (function.name.starts_with("detail_"))
    return fmt::format("'{}' would begin as emitted functions do that are not for users", function.name);
  if (const std::string entry = entry_with_constant(mechanism, function.name); !entry.empty())
    return fmt::format("'{}' is in C the constant of '{}', its entry in {}", function.name, entry,
                       function.name[0]);
  const auto is_about_center = [](KinematicQuantity quantity) {
    return !quantity_row(quantity).of_frame && quantity != KinematicQuantity::kGravityCompensation;
  };
  if (std::any_of(quantities.begin(), quantities.end(), is_about_center) && !(total_mass(mechanism) > 0))
    return fmt::format("'{}' is about a centre of mass, and no body has mass", function.name);
  if (is_macro(function.name)) return fmt::format("'{}' is a macro of the C library", function.name);
  if (kinematic_function_named(mechanism, function.name))
    return fmt::format("there are two functions '{}'", function.name);
  mechanism.kinematics.push_back(std::move(function));
  return "";
}

}  // namespace jourdain::model
