#include "model/read/sdf_frames.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace jourdain::model {

using support::shown;

namespace {

constexpr std::size_t kMost = 5000;
/// How the whole names of the models' own frames end.
constexpr std::string_view kModel = "__model__";

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

std::string SdfFrames::placed(const std::string& name, const Frame& model) {
  if (model.placed_name == "world") {
    file_.error(model.placed_where, "'placement_frame' names 'world', which is no frame of the model");
    file_.complete().structure = false;
    return "";
  }
  const std::string scope = name.substr(0, name.size() - kModel.size());
  return find(scope, model.placed_name, model.placed_where, "'placement_frame' names").value_or("");
}

void SdfFrames::settle() {
  for (auto& [name, frame] : frames_) {
    const std::string who = fmt::format("'{}' names", shown(name));
    if (!frame.base_name.empty())
      frame.base = find(frame.scope, frame.base_name, frame.where, who).value_or("");
    if (!frame.attached_name.empty())
      frame.attached = find(frame.scope, frame.attached_name, frame.where, who).value_or("");
    if (!frame.placed_name.empty()) frame.placed = placed(name, frame);
    for (std::string* whole : {&frame.base, &frame.attached, &frame.placed})
      if (!frames_.contains(*whole)) *whole = "";  // its own name is an error
  }
}

void SdfFrames::report_cycle(const std::string& name) {
  file_.error(frames_.at(name).where, fmt::format("the pose of '{}' is relative to itself", shown(name)));
  file_.complete().structure = false;
}

SdfPose SdfFrames::pose(const std::string& name) {
  Frame& frame = frames_.at(name);
  if (frame.is_resolved) return frame.in_world;
  if (frame.is_visited) {
    report_cycle(name);
    frame.is_resolved = true;
    return {};
  }
  frame.is_visited = true;
  frame.in_world = pose(frame.base) * pose_in_base(name);
  frame.is_resolved = true;
  return frame.in_world;
}

SdfPose SdfFrames::pose_in_base(const std::string& name) {
  Frame& frame = frames_.at(name);
  if (frame.placed.empty() || frame.is_placed) return frame.pose;
  frame.is_placed = true;
  if (const std::optional<SdfPose> placed = pose_within(frame.placed, name))
    frame.pose = frame.pose * relative(*placed, {});
  return frame.pose;
}

std::optional<SdfPose> SdfFrames::pose_within(const std::string& name, const std::string& model) {
  SdfPose result;
  std::string at = name;
  for (std::size_t steps = 0; at != model; ++steps) {
    if (steps > frames_.size()) {
      report_cycle(name);
      return {};
    }
    if (at.empty()) {
      const Frame& frame = frames_.at(model);
      file_.error(frame.placed_where,
                  fmt::format("'{}' is placed in the world, not in its model", shown(frame.placed_name)),
                  "that leaves the pose of the model open");
      file_.complete().structure = false;
      return {};
    }
    result = pose_in_base(at) * result;
    at = frames_.at(at).base;
  }
  return result;
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
