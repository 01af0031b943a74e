// MuJoCo's XML format. Read are bodies with their inertias, joints, equality constraints, actuators of joints and
// sites; contacts, limits, sensors and appearance are not. States are MuJoCo's: coordinates are its qpos and qvel.
#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "model/read/finish.hpp"
#include "model/read/mjcf_schema.hpp"
#include "model/read/mjcf_sections.hpp"
#include "model/read/nesting.hpp"
#include "model/read/read.hpp"
#include "model/read/xml_text.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

constexpr std::size_t kMaximumElements = 50'000;

/// What <option> says of forces.
void read_options(MjcfFile& file, Mechanism& mechanism) {
  UrdfFile& xml = file.xml();
  Numbers3 gravity{0, 0, -kStandardGravity};
  if (const XmlElement* e = file.section("option", "gravity")) gravity = file.triple(*e, "gravity", gravity);
  for (const char* attribute : {"density", "viscosity"})
    if (const XmlElement* e = file.section("option", attribute))
      if (file.number(*e, attribute, 0) != 0)
        file.warning(xml.value(*e, attribute), fmt::format("{} of the medium is ignored", attribute));
  const XmlElement& root = file.root();
  for (const auto* e = root.FirstChildElement("option"); e; e = e->NextSiblingElement("option")) {
    const XmlElement* flag = e->FirstChildElement("flag");
    if (!flag) continue;
    const auto disabled = [&](const char* attribute) {
      const char* value = flag->Attribute(attribute);
      return value && std::strcmp(value, "disable") == 0;
    };
    if (disabled("gravity")) gravity = {};
    for (const char* attribute : {"passive", "spring", "damper", "actuation"})
      if (disabled(attribute))
        file.warning(xml.value(*flag, attribute), fmt::format("'{}' is not disabled", attribute));
  }
  mechanism.gravity = {gravity[0], gravity[1], gravity[2]};
}

/// False, with a note, where a flag switches equality constraints off.
bool has_equalities(MjcfFile& file) {
  const XmlElement& root = file.root();
  for (const auto* e = root.FirstChildElement("option"); e; e = e->NextSiblingElement("option"))
    for (const char* attribute : {"constraint", "equality"}) {
      const XmlElement* flag = e->FirstChildElement("flag");
      const char* value = flag ? flag->Attribute(attribute) : nullptr;
      if (!value || std::strcmp(value, "disable") != 0) continue;
      file.xml().diagnostics().note(file.xml().value(*flag, attribute),
                                    "equality constraints are disabled: left out");
      return false;
    }
  return true;
}

void check_compiler(MjcfFile& file) {
  if (const XmlElement* e = file.compiler("coordinate"))
    if (std::strcmp(e->Attribute("coordinate"), "local") != 0)
      file.error(file.xml().value(*e, "coordinate"), "global coordinates are not read",
                 "MuJoCo left them in version 2.3.4, which writes local ones");
  if (const XmlElement* e = file.compiler("alignfree"))
    if (file.truth(*e, "alignfree", false))
      file.warning(file.xml().value(*e, "alignfree"),
                   "alignfree is ignored: the coordinates of free joints are those of the body as drawn");
}

/// A range that does not hold the start would promise what is not.
void drop_ranges(MjcfFile& file, Mechanism& mechanism) {
  for (Joint& joint : mechanism.joints)
    for (Coordinate& coordinate : joint.coordinates) {
      const double start = coordinate.initial_position.constant();
      if (!coordinate.range || (start >= (*coordinate.range)[0] && start <= (*coordinate.range)[1])) continue;
      file.xml().diagnostics().note(
          joint.where,
          fmt::format("joint '{}' starts at {:.5g}, outside its range from {:.5g} to {:.5g}: the "
                      "range is not used",
                      shown(joint.name), start, (*coordinate.range)[0], (*coordinate.range)[1]),
          "a keyframe \"home\" starts it elsewhere");
      coordinate.range.reset();
    }
}

Mechanism read_root(MjcfFile& file, const ReadOptions& options) {
  check_mjcf(file);
  check_compiler(file);
  MjcfBodies bodies = MjcfBodyReader(file, options).read();
  Mechanism& mechanism = bodies.mechanism;
  const XmlElement& root = file.root();
  const char* const model = root.Attribute("model");
  mechanism.name = model && *model ? file.xml().name(root, "model").value_or("") : "MuJoCo Model";
  mechanism.where = file.xml().element(root);
  read_options(file, mechanism);
  if (file.xml().complete().structure) {
    if (has_equalities(file)) read_mjcf_equalities(file, bodies);
    read_mjcf_actuators(file, bodies);
    read_mjcf_keyframe(file, bodies);
    drop_ranges(file, mechanism);
  }
  return std::move(bodies.mechanism);
}

}  // namespace

std::optional<Part> read_mjcf(Diagnostics& diagnostics, const ReadOptions& options) {
  if (options.root == RootJoint::kFree) {
    diagnostics.error({}, "a free root can be asked for with URDF and SDF files only",
                      "declare the root's joint in the file: <freejoint/>");
    return {};
  }
  const std::unique_ptr<XmlText> text = parse_xml(diagnostics);
  const XmlElement* root = text ? root_element(*text, "mujoco", "an MJCF file", diagnostics) : nullptr;
  if (!root) return {};
  if (text->starts.size() > kMaximumElements) {
    diagnostics.error(
        {}, fmt::format("the file has {} elements, more than {}", text->starts.size(), kMaximumElements));
    return {};
  }
  UrdfFile xml(diagnostics, text->starts, text->document);
  MjcfFile file(xml, *root);
  Mechanism mechanism = read_root(file, options);
  return Part{std::move(mechanism), xml.complete(), support::Severity::kWarning};
}

}  // namespace jourdain::model
