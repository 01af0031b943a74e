#include "model/read/sdf_frames.hpp"

#include <fmt/format.h>

#include <vector>

namespace jourdain::model {

using support::shown;

namespace {

constexpr std::size_t kMost = 5000;

}  // namespace

bool SdfFrames::add(const std::string& name, Frame frame) {
  const SourceRange where = frame.where;
  if (frames_.size() == kMost) {
    file_.error(where, fmt::format("more than {} links, joints and frames", kMost));
    file_.complete().structure = false;
  }
  if (frames_.size() >= kMost) return false;
  const auto [place, is_new] = frames_.emplace(name, std::move(frame));
  if (is_new) return true;
  file_.error(where, fmt::format("there are two links, joints, frames or models '{}'", shown(name)),
              fmt::format("first declared at line {}", place->second.where.line));
  file_.complete().structure = false;
  return false;
}

std::optional<std::string> SdfFrames::find(const std::string& scope, const std::string& name,
                                           SourceRange where, const std::string& who) {
  if (name == "world") return "";
  if (frames_.contains(scope + name)) return scope + name;
  std::vector<std::string> known;
  for (const auto& [whole, frame] : frames_)
    if (whole.starts_with(scope) && whole.size() > scope.size()) known.push_back(whole.substr(scope.size()));
  const std::string close = support::nearest(name, known);
  file_.error(where, fmt::format("{} unknown frame '{}'", who, shown(name)),
              close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
  file_.complete().structure = false;
  return {};
}

void SdfFrames::settle() {
  for (auto& [name, frame] : frames_) {
    const std::string who = fmt::format("'{}' names", shown(name));
    if (!frame.base_name.empty())
      frame.base = find(frame.scope, frame.base_name, frame.where, who).value_or("");
    if (!frame.attached_name.empty())
      frame.attached = find(frame.scope, frame.attached_name, frame.where, who).value_or("");
    for (std::string* whole : {&frame.base, &frame.attached})
      if (!frames_.contains(*whole)) *whole = "";  // its own name is an error
  }
}

SdfPose SdfFrames::pose(const std::string& name) {
  Frame& frame = frames_.at(name);
  if (frame.is_resolved) return frame.pose;
  if (frame.is_visited) {
    file_.error(frame.where, fmt::format("the pose of '{}' is relative to itself", shown(name)));
    file_.complete().structure = false;
    frame.is_resolved = true;
    return {};
  }
  frame.is_visited = true;
  const SdfPose in_world = pose(frame.base) * frame.pose;
  frame.pose = in_world;
  frame.is_resolved = true;
  return in_world;
}

std::optional<BodyIndex> SdfFrames::link(const std::string& name) {
  const Frame* frame = &frames_.at(name);
  for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {
    if (frame->link || frame->attached == "") return frame->link;
    frame = &frames_.at(frame->attached);
  }
  file_.error(frame->where, fmt::format("frame '{}' is attached to itself", shown(name)));
  file_.complete().structure = false;
  return {};
}

}  // namespace jourdain::model
