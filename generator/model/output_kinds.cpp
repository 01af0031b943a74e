#include "model/output_kinds.hpp"

#include "support/enumerators.hpp"

namespace jourdain::model {

namespace {

using Clock = OutputClock;
using Subject = OutputSubject;

constexpr OutputMemberKind kPoseMembers[] = {{"position", MemberShape::kVector, "m"},
                                             {"rotation", MemberShape::kRotation, "1"}};
constexpr OutputMemberKind kVelocityMembers[] = {{"v", MemberShape::kVector, "m/s"},
                                                 {"omega", MemberShape::kVector, "rad/s"}};
constexpr OutputMemberKind kAccelerationMembers[] = {{"a", MemberShape::kVector, "m/s^2"},
                                                     {"omega_dot", MemberShape::kVector, "rad/s^2"}};
constexpr OutputMemberKind kJacobianMembers[] = {
    {"J_t", MemberShape::kPerVelocity},       {"J_r", MemberShape::kPerVelocity},
    {"v_bar", MemberShape::kVector, "m/s"},   {"omega_bar", MemberShape::kVector, "rad/s"},
    {"a_bar", MemberShape::kVector, "m/s^2"}, {"zeta_bar", MemberShape::kVector, "rad/s^2"}};
constexpr OutputMemberKind kReaction[] = {{"force", MemberShape::kVector, "N"},
                                          {"moment", MemberShape::kVector, "N m"}};
constexpr OutputMemberKind kDrive[] = {{"", MemberShape::kScalar, kForceOnCoordinate}};
constexpr OutputMemberKind kEnergy[] = {{"", MemberShape::kScalar, "J"}};
constexpr OutputMemberKind kNumber[] = {{""}};

constexpr auto kOutputKinds = std::to_array<OutputKindRow>({
    {OutputKind::kPose, "pose", Subject::kFrame, Clock::kFrame, kPoseMembers,
     "Position (inertial frame) and rotation matrix (frame to inertial) of '{}'."},
    {OutputKind::kVelocity, "velocity", Subject::kFrame, Clock::kFrame, kVelocityMembers,
     "Velocity (inertial frame) and angular velocity (frame components) of '{}'."},
    {OutputKind::kAcceleration, "acceleration", Subject::kFrame, Clock::kDynamics, kAccelerationMembers,
     "Acceleration (inertial frame) and angular acceleration (frame components) of '{}'."},
    {OutputKind::kJacobian, "jacobian", Subject::kFrame, Clock::kFrame, kJacobianMembers,
     "Jacobians of '{}': v = J_t z + v_bar, a = J_t zdot + a_bar (inertial frame); omega = J_r z + "
     "omega_bar, omega_dot = J_r zdot + zeta_bar (frame components)."},
    {OutputKind::kReaction, "reaction", Subject::kJoint, Clock::kDynamics, kReaction,
     "What joint '{}' transmits to its child, at the child's origin, child components."},
    {OutputKind::kDrive, "drive", Subject::kCoordinate, Clock::kDynamics, kDrive,
     "Force or torque that the prescribed motion of '{}' needs."},
    {OutputKind::kKineticEnergy, "kinetic_energy", Subject::kNone, Clock::kPositions, kEnergy,
     "Kinetic energy, J."},
    {OutputKind::kPotentialEnergy, "potential_energy", Subject::kNone, Clock::kPositions, kEnergy,
     "Potential energy, J."},
    {OutputKind::kExpression, "expression", Subject::kValue, Clock::kValue, kNumber,
     "Expression of the model description."},
});
static_assert(support::is_complete(kOutputKinds, &OutputKindRow::kind),
              "a row for each OutputKind, in their order");

}  // namespace

const OutputKindRow& output_kind(OutputKind kind) { return kOutputKinds[static_cast<std::size_t>(kind)]; }

const std::vector<std::string>& output_kind_names() {
  static const std::vector<std::string> names = support::names_of(kOutputKinds);
  return names;
}

std::string subject_name(const Mechanism& mechanism, const Output& output) {
  switch (output_kind(output.kind).subject) {
    case Subject::kFrame:
      return mechanism.frames[output.frame.value].name;
    case Subject::kJoint:
      return mechanism.joints[output.joint.value].name;
    case Subject::kCoordinate:
      return mechanism.joints[output.joint.value].coordinates[output.coordinate].name;
    case Subject::kNone:
    case Subject::kValue:
      break;
  }
  return "";
}

}  // namespace jourdain::model
