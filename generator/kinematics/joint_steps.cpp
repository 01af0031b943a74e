#include "kinematics/joint_steps.hpp"

namespace jourdain::kinematics {

using model::JointType;

std::vector<JointStep> joint_steps(const model::Joint& joint) {
  switch (joint.type) {
    case JointType::kFixed:
      return {};
    case JointType::kRevolute:
      return {{LinkKind::kTurn, joint.axis, 0}};
    case JointType::kPrismatic:
      return {{LinkKind::kSlide, joint.axis, 0}};
    case JointType::kScrew:
      return {{LinkKind::kScrew, joint.axis, 0}};
    case JointType::kCylindrical:
      return {{LinkKind::kTurn, joint.axis, 0}, {LinkKind::kSlide, joint.axis, 1}};
    case JointType::kUniversal:
      return {{LinkKind::kTurn, joint.axis, 0}, {LinkKind::kTurn, joint.second_axis, 1}};
    case JointType::kPlanar: {
      const auto directions = model::slide_directions(joint.axis);
      return {{LinkKind::kSlide, directions[0], 0},
              {LinkKind::kSlide, directions[1], 1},
              {LinkKind::kTurn, joint.axis, 2}};
    }
    case JointType::kSpherical:
      return {{LinkKind::kBall}};
    case JointType::kFree:
      return {{LinkKind::kFree}};
    case JointType::kCurve:
      return {{LinkKind::kCurve}};
  }
  return {};
}

}  // namespace jourdain::kinematics
