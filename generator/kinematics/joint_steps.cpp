#include "kinematics/joint_steps.hpp"

#include "model/joint_kinds.hpp"

namespace jourdain::kinematics {

namespace {

LinkKind link_kind(model::MotionKind kind) {
  switch (kind) {
    case model::MotionKind::kTurn:
      return LinkKind::kTurn;
    case model::MotionKind::kSlide:
      return LinkKind::kSlide;
    case model::MotionKind::kScrew:
      return LinkKind::kScrew;
    case model::MotionKind::kCurve:
      return LinkKind::kCurve;
    case model::MotionKind::kBall:
      return LinkKind::kBall;
    case model::MotionKind::kFree:
      return LinkKind::kFree;
  }
  return LinkKind::kTurn;
}

}  // namespace

std::vector<JointStep> joint_steps(const model::Joint& joint) {
  std::vector<JointStep> steps;
  for (const model::JointMotion& motion : model::joint_kind(joint).motions) {
    JointStep step{.kind = link_kind(motion.kind), .coordinate = motion.has_coordinate() ? steps.size() : 0};
    if (motion.along != model::Along::kNone) step.axis = model::direction(joint, motion);
    steps.push_back(step);
  }
  return steps;
}

}  // namespace jourdain::kinematics
