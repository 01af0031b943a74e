#include "model/read/mjcf_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

namespace jourdain::model {

namespace {

using support::shown;
using Names = std::vector<std::string>;

constexpr int kMostReported = 10;  // unknown attributes of one element

Names split(std::string_view text) {
  Names result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    result.emplace_back(text.substr(i, end - i));
    i = end + 1;
  }
  return result;
}

/// What MuJoCo's XML reference (mujoco.readthedocs.io) lists up to version 3.3, by the element's name; joints and
/// tendons of other sections have that before theirs.
const Names* attributes_of(const std::string& element) {
  static const std::string kTurn = "quat axisangle euler xyaxes zaxis ";
  static const std::string kOfActuators =
      "name class group nsample interp delay ctrllimited forcelimited ctrlrange forcerange lengthrange gear "
      "damping armature cranklength user joint jointinparent tendon slidersite cranksite site refsite body "
      "actlimited actrange actdim actearly inheritrange ";
  static const std::string kEquality = "name class active solref solimp ";
  static const std::map<std::string, Names> table = {
      {"compiler",
       split(
           "autolimits boundmass boundinertia settotalmass balanceinertia strippath coordinate angle fitaabb "
           "eulerseq meshdir texturedir assetdir discardvisual convexhull usethread fusestatic "
           "inertiafromgeom inertiagrouprange exactmeshinertia saveinertial alignfree conflict")},
      {"option",
       split("timestep apirate impratio tolerance ls_tolerance noslip_tolerance ccd_tolerance mpr_tolerance "
             "sleep_tolerance gravity wind magnetic density viscosity o_margin o_solref o_solimp o_friction "
             "integrator collision cone jacobian solver iterations ls_iterations noslip_iterations "
             "ccd_iterations mpr_iterations sdf_iterations sdf_initpoints actuatorgroupdisable")},
      {"body", split("name childclass pos mocap gravcomp sleep user " + kTurn)},
      {"worldbody", split("name childclass")},
      {"frame", split("name childclass pos " + kTurn)},
      {"inertial", split("pos mass diaginertia fullinertia " + kTurn)},
      {"joint",
       split("name class type group pos axis springdamper limited actuatorfrclimited actuatorfrcrange "
             "actuatorgravcomp solreflimit solimplimit solreffriction solimpfriction stiffness range margin "
             "ref springref armature damping frictionloss user")},
      {"freejoint", split("name group align")},
      {"geom",
       split("name class type group pos contype conaffinity condim priority size material friction mass "
             "density shellinertia solmix solref solimp margin gap fromto hfield mesh fitscale rgba "
             "fluidshape fluidcoef user " +
             kTurn)},
      {"site", split("name class type group pos material size fromto rgba user " + kTurn)},
      {"equality connect", split(kEquality + "body1 body2 anchor site1 site2")},
      {"equality weld", split(kEquality + "body1 body2 relpose anchor torquescale site1 site2")},
      {"equality joint", split(kEquality + "joint1 joint2 polycoef")},
      {"actuator general", split(kOfActuators + "dyntype gaintype biastype dynprm gainprm biasprm")},
      {"actuator motor", split(kOfActuators)},
      {"actuator position", split(kOfActuators + "kp kv dampratio timeconst")},
      {"actuator velocity", split(kOfActuators + "kv")},
  };
  const auto found = table.find(element);
  return found == table.end() ? nullptr : &found->second;
}

/// Elements that an element may have within it; null: those of no interest.
const Names* children_of(const std::string& element) {
  static const std::string kInBody =
      "body frame geom site camera light joint freejoint composite flexcomp replicate attach plugin include";
  static const std::map<std::string, Names> table = {
      {"mujoco",
       split("compiler option size visual statistic default custom extension asset worldbody contact "
             "deformable equality tendon actuator sensor keyframe include")},
      {"worldbody", split(kInBody)},
      {"body", split(kInBody + " inertial")},
      {"frame", split(kInBody + " inertial")},
      {"default",
       split("default mesh material joint geom site camera light pair equality tendon general motor position "
             "velocity intvelocity damper cylinder muscle adhesion dcmotor")},
      {"equality", split("connect weld joint tendon flex flexvert flexstrain distance include")},
      {"actuator",
       split("general motor position velocity intvelocity damper cylinder muscle adhesion dcmotor "
             "plugin include")},
      {"option", split("flag")},
      {"compiler", split("lengthrange")},
  };
  const auto found = table.find(element);
  return found == table.end() ? nullptr : &found->second;
}

bool is_one_of(const std::string& name, const Names& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class SchemaCheck {
 public:
  explicit SchemaCheck(MjcfFile& file) : file_(file) {}

  void walk(const XmlElement& element) {
    check_attributes(element);
    const Names* known = children_of(element.Name());
    if (!known) return;
    for (const auto* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
      if (!is_one_of(e->Name(), *known))
        unknown_element(*e, *known);
      else if (!is_left_out(*e))
        walk(*e);
    }
  }

 private:
  UrdfFile& xml() { return file_.xml(); }

  /// "joint", "equality joint", "actuator motor": joints of bodies and of defaults have their name alone.
  static std::string key(const XmlElement& element) {
    const XmlElement* parent = element.Parent()->ToElement();
    std::string name = element.Name();
    const std::string section = parent ? parent->Name() : "";
    if (section == "equality") return "equality " + name;
    if (section == "actuator" || (section == "default" && is_actuator_name(name))) return "actuator " + name;
    return name;
  }

  void check_attributes(const XmlElement& element) {
    const std::string name = element.Name();
    const bool is_class_itself = name == "default";
    if (!is_class_itself) file_.check_class(element, "class");
    file_.check_class(element, "childclass");
    const Names* known = attributes_of(key(element));
    if (!known) return;
    int unknown = 0;
    for (const auto* a = element.FirstAttribute(); a; a = a->Next()) {
      if (is_one_of(a->Name(), *known) || ++unknown > kMostReported) continue;
      const std::string close = support::nearest(a->Name(), *known);
      file_.warning(xml().value(element, a->Name()),
                    fmt::format("MJCF has no attribute '{}' of <{}>: ignored", shown(a->Name()), name),
                    close.empty() ? "" : fmt::format("did you mean '{}'?", close));
    }
  }

  void unknown_element(const XmlElement& element, const Names& known) {
    const std::string close = support::nearest(element.Name(), known);
    file_.warning(xml().element(element),
                  fmt::format("MJCF has no element <{}> within <{}>: ignored", shown(element.Name()),
                              element.Parent()->Value()),
                  close.empty() ? "" : fmt::format("did you mean <{}>?", close));
  }

  /// Says so where that matters.
  bool is_left_out(const XmlElement& element) {
    static const Names bringing = split("composite flexcomp replicate attach include");
    static const Names forces = split("deformable plugin extension");
    const std::string name = element.Name();
    if (is_one_of(name, bringing)) {
      xml().complete().structure = false;
      file_.error(xml().element(element), fmt::format("<{}> is not read", name),
                  "MuJoCo writes a file without it: mj_saveLastXML");
      return true;
    }
    if (is_one_of(name, forces)) {
      file_.warning(xml().element(element), fmt::format("<{}> is not read", name));
      return true;
    }
    if (name == "tendon" && key(element) == "tendon") return tendons(element);
    return false;
  }

  /// Forces of tendons; those that are only measured have none.
  bool tendons(const XmlElement& section) {
    tendon_forces(section);
    for (const auto* e = section.FirstChildElement(); e; e = e->NextSiblingElement()) tendon_forces(*e);
    return true;
  }

  void tendon_forces(const XmlElement& element) {
    const char* name = element.Attribute("name");
    for (const char* attribute : {"stiffness", "damping", "frictionloss", "armature"})
      if (element.DoubleAttribute(attribute) != 0)
        file_.warning(xml().value(element, attribute),
                      fmt::format("{} of tendon{} is ignored", attribute,
                                  name ? fmt::format(" '{}'", shown(name)) : "s"));
  }

  MjcfFile& file_;
};

}  // namespace

void check_mjcf(MjcfFile& file) { SchemaCheck(file).walk(file.root()); }

}  // namespace jourdain::model
