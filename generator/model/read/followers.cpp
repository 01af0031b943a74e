#include "model/read/followers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace jourdain::model {

namespace {

using support::shown;

bool is_named(const std::vector<std::string>& names, const Joint& joint) {
  return std::find(names.begin(), names.end(), joint.name) != names.end();
}

/// The joint that the follower of a coupler follows; none where the ratio is zero.
std::optional<JointIndex> leader(const Loop& coupler) {
  for (const Expression::Node& node : coupler.residual.nodes())
    if (node.op == Expression::Op::kVariable && node.variable.index != coupler.follower->joint.value)
      return JointIndex(node.variable.index);
  return {};
}

bool has_offset(const Loop& coupler) {
  return !coupler.residual.substituted([](const Variable&) { return Expression(0.0); }).is_zero();
}

}  // namespace

void settle_followers(Mechanism& mechanism, std::vector<std::string>& names,
                      support::Diagnostics& diagnostics) {
  const std::vector<Joint>& joints = mechanism.joints;
  std::erase_if(mechanism.loops, [&](const Loop& loop) {
    if (!loop.follower || !is_named(names, joints[loop.follower->joint.value])) return false;
    if (const auto before = leader(loop);
        before && (has_offset(loop) || !is_named(names, joints[before->value])))
      diagnostics.note(loop.where, fmt::format("joint '{}' is locked and does not follow '{}'",
                                               shown(joints[loop.follower->joint.value].name),
                                               shown(joints[before->value].name)));
    return true;
  });
  const auto follows_locked = [&](const Loop& loop) {
    if (!loop.follower || is_named(names, joints[loop.follower->joint.value])) return false;
    const auto before = leader(loop);
    const bool alone = joints[loop.follower->joint.value].coordinates.size() == 1;
    return before && alone && is_named(names, joints[before->value]) && !has_offset(loop);
  };
  for (auto loop = mechanism.loops.begin(); loop != mechanism.loops.end();) {
    loop = std::find_if(mechanism.loops.begin(), mechanism.loops.end(), follows_locked);
    if (loop == mechanism.loops.end()) return;
    const std::string& name = joints[loop->follower->joint.value].name;
    diagnostics.note(loop->where, fmt::format("joint '{}' is locked with '{}', which it follows", shown(name),
                                              shown(joints[leader(*loop)->value].name)));
    names.push_back(name);
    mechanism.loops.erase(loop);
    loop = mechanism.loops.begin();
  }
}

}  // namespace jourdain::model
