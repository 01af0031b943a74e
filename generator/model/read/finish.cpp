#include "model/read/finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/check/checks.hpp"
#include "model/loop_kinds.hpp"
#include "model/read/followers.hpp"
#include "model/read/lock.hpp"
#include "model/read/weld.hpp"
#include "model/snap.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

void lock_joints(Mechanism& mechanism, const ReadOptions& options, Diagnostics& diagnostics) {
  std::vector<std::string> locked = options.locked_joints;
  if (!locked.empty()) settle_followers(mechanism, locked, diagnostics);
  for (const std::string& name : locked) {
    const auto joint = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                    [&](const Joint& candidate) { return candidate.name == name; });
    if (joint != mechanism.joints.end()) {
      lock(mechanism, JointIndex(static_cast<std::size_t>(joint - mechanism.joints.begin())));
      continue;
    }
    std::vector<std::string> names;
    for (const Joint& candidate : mechanism.joints) names.push_back(candidate.name);
    const std::string close = support::nearest(name, names);
    diagnostics.error({}, fmt::format("there is no joint '{}' to lock", shown(name)),
                      close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  }
}

/// Limits of robot files are ranges of what is proven of loop joints, where coordinates start within them.
void keep_useful_limits(Mechanism& mechanism) {
  const bool closes = std::any_of(mechanism.loops.begin(), mechanism.loops.end(), [](const Loop& loop) {
    return loop_kind(loop).has_ends() && !loop_kind(loop).is_constraint();
  });
  const std::vector<double> parameters = default_values(mechanism);
  for (Joint& joint : mechanism.joints)
    for (Coordinate& coordinate : joint.coordinates) {
      if (!coordinate.range_is_limit || !coordinate.range) continue;
      const auto start = coordinate.initial_position.evaluate<double>(parameters);
      const auto [low, high] = *coordinate.range;
      if (!closes || !(low <= start && start <= high)) coordinate.range.reset();
    }
}

}  // namespace

std::optional<Mechanism> finish_reading(Part part, const ReadOptions& options, Diagnostics& diagnostics) {
  auto [mechanism, complete, triangle] = std::move(part);
  mechanism.snap = options.snap > 0;
  if (complete.structure) lock_joints(mechanism, options, diagnostics);
  keep_useful_limits(mechanism);
  // Of cables: the frame of an imported file's world may be on a body here.
  const std::vector<Frame>& frames = mechanism.frames;
  std::erase_if(mechanism.loads, [&frames](const Load& load) { return !frames[load.frame.value].body; });
  if (mechanism.snap) snap_directions(mechanism, options.snap, diagnostics);
  check_numbers(mechanism, diagnostics);
  const bool tree = complete.structure && check_graph(mechanism, diagnostics);
  if (tree) check_motions(mechanism, diagnostics);
  if (tree) check_loops(mechanism, diagnostics);
  if (tree && complete.numbers) weld_massless_ends(mechanism, diagnostics);
  if (tree && complete.numbers) mechanism.indefinite = check_inertias(mechanism, diagnostics, triangle);
  if (diagnostics.has_errors()) return {};
  return std::move(mechanism);
}

}  // namespace jourdain::model
