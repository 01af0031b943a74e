#include "commands/kind_names.hpp"

#include "model/loop_kinds.hpp"

namespace jourdain::commands {

const char* joint_type_name(model::JointType type) {
  switch (type) {
    case model::JointType::kFixed:
      return "fixed";
    case model::JointType::kRevolute:
      return "revolute";
    case model::JointType::kPrismatic:
      return "prismatic";
    case model::JointType::kScrew:
      return "screw";
    case model::JointType::kCylindrical:
      return "cylindrical";
    case model::JointType::kUniversal:
      return "universal";
    case model::JointType::kPlanar:
      return "planar";
    case model::JointType::kSpherical:
      return "spherical";
    case model::JointType::kFree:
      return "free";
    case model::JointType::kCurve:
      return "curve";
  }
  return "";
}

std::string loop_type_name(model::LoopType type) { return std::string(model::loop_kind(type).name); }

const char* output_kind_name(model::OutputKind kind) {
  switch (kind) {
    case model::OutputKind::kPose:
      return "pose";
    case model::OutputKind::kVelocity:
      return "velocity";
    case model::OutputKind::kAcceleration:
      return "acceleration";
    case model::OutputKind::kJacobian:
      return "jacobian";
    case model::OutputKind::kReaction:
      return "reaction";
    case model::OutputKind::kDrive:
      return "drive";
    case model::OutputKind::kKineticEnergy:
      return "kinetic_energy";
    case model::OutputKind::kPotentialEnergy:
      return "potential_energy";
    case model::OutputKind::kExpression:
      return "expression";
  }
  return "";
}

}  // namespace jourdain::commands
