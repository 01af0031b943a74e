// The sections of an MJCF file beside <worldbody>.
#pragma once

#include "model/read/mjcf_bodies.hpp"

namespace jourdain::model {

/// Reads <actuator>: what acts on a hinge or slide. The input is MuJoCo's ctrl, not clipped: gear times gain times ctrl
/// on the joint, and the bias of servos as a force of its own. Joints' armatures become rotors, as seen at the joint; a
/// joint that has one and no actuator gets an input, which a note says.
void read_mjcf_actuators(MjcfFile& file, MjcfBodies& bodies);

/// Reads <equality>: connect as a ball, weld as a prismatic joint and a plane that stops it, joint as a residual. They
/// hold exactly where MuJoCo's are springs; what is not active is left out with a note.
void read_mjcf_equalities(MjcfFile& file, MjcfBodies& bodies);

/// Starts the mechanism where the keyframe "home" says, if there is one.
void read_mjcf_keyframe(MjcfFile& file, MjcfBodies& bodies);

/// What an element of these sections refers to by `attribute`; an error and null where there is no such `kind`.
template <class Named>
const Named* find_named(MjcfFile& file, const XmlElement& element, const char* attribute, const char* kind,
                        const std::map<std::string, Named>& all) {
  const std::string name = element.Attribute(attribute);
  if (const auto found = all.find(name); found != all.end()) return &found->second;
  std::vector<std::string> known;
  for (const auto& entry : all) known.push_back(entry.first);
  const std::string close = support::nearest(name, known);
  file.xml().complete().structure = false;
  file.error(
      file.xml().value(element, attribute),
      std::string("<") + element.Name() + "> names unknown " + kind + " '" + support::shown(name) + "'",
      close.empty() ? "" : "did you mean '" + close + "'?");
  return nullptr;
}

}  // namespace jourdain::model
