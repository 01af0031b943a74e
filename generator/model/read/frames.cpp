#include "model/read/frames.hpp"

#include <string>

namespace jourdain::model {

FrameIndex frame_of(Mechanism& mechanism, std::optional<BodyIndex> body) {
  const std::string name = body ? mechanism.bodies[body->value].name : "world";
  for (std::size_t i = 0; i < mechanism.frames.size(); ++i)
    if (mechanism.frames[i].name == name) return FrameIndex(i);
  Frame frame;
  frame.name = name;
  frame.body = body;
  mechanism.frames.push_back(frame);
  return FrameIndex(mechanism.frames.size() - 1);
}

std::optional<FrameIndex> frame_named(Mechanism& mechanism, std::string_view name) {
  for (std::size_t i = 0; i < mechanism.frames.size(); ++i)
    if (mechanism.frames[i].name == name) return FrameIndex(i);
  if (name == "world") return frame_of(mechanism, {});
  for (std::size_t i = 0; i < mechanism.bodies.size(); ++i)
    if (mechanism.bodies[i].name == name) return frame_of(mechanism, BodyIndex(i));
  return {};
}

}  // namespace jourdain::model
