#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "model/read/mjcf_law.hpp"
#include "model/read/mjcf_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;
using Op = Expression::Op;

constexpr std::size_t kMostGroups = 31;
constexpr const char* kAtOnce = "the servo acts at once";

class ActuatorReader {
 public:
  ActuatorReader(MjcfFile& file, MjcfBodies& bodies) : file_(file), bodies_(bodies) {}

  void read() {
    const XmlElement& root = file_.root();
    for (const auto* e = root.FirstChildElement("option"); e; e = e->NextSiblingElement("option"))
      if (e->Attribute("actuatorgroupdisable"))
        disabled_ = file_.numbers(*e, "actuatorgroupdisable", std::vector<double>(kMostGroups, -1), 1);
    for (const auto* section = root.FirstChildElement("actuator"); section;
         section = section->NextSiblingElement("actuator"))
      for (const auto* e = section->FirstChildElement(); e; e = e->NextSiblingElement())
        if (is_actuator_name(e->Name()) && std::strcmp(e->Name(), "plugin") != 0 && is_few(*e))
          read_actuator(*e);
    force_limits_.report(file_, "forcerange of actuator", "is ignored", "forces are not clipped");
    carry_armatures();
  }

 private:
  UrdfFile& xml() { return file_.xml(); }

  /// Names are made one by one: no more than anyone has.
  bool is_few(const XmlElement& e) {
    if (++count_ <= kMaximumBodies) return true;
    xml().complete().structure = false;
    if (count_ == kMaximumBodies + 1)
      file_.error(xml().element(e), fmt::format("the file has more than {} actuators", kMaximumBodies));
    return false;
  }

  void read_actuator(const XmlElement& e) {
    const char* const attribute = e.Attribute("jointinparent") ? "jointinparent" : "joint";
    const char* const given = e.Attribute("name");
    const std::string label =
        given ? fmt::format("<{}> '{}'", e.Name(), shown(given)) : fmt::format("<{}>", e.Name());
    const double group = file_.number(e, "group", 0);
    if (std::find(disabled_.begin(), disabled_.end(), group) != disabled_.end())
      return xml().diagnostics().note(xml().element(e),
                                      fmt::format("{} is of disabled group {}: left out", label, group));
    if (!e.Attribute(attribute))
      return file_.warning(xml().element(e), label + " acts on no joint: not read",
                           "actuators of tendons, sites and bodies have no counterpart");
    const MjcfBodies::NamedJoint* named = find_named(file_, e, attribute, "joint", bodies_.joints);
    if (!named) return;
    if (named->type != JointType::kRevolute && named->type != JointType::kPrismatic)
      return file_.warning(xml().value(e, attribute), label + " acts on a joint that turns freely: not read",
                           "actuators of hinges and slides are");
    const double gear = file_.numbers(e, "gear", {1, 0, 0, 0, 0, 0}, 1)[0];
    const MjcfLaw law = readable_law(e, label);
    Actuator actuator;
    actuator.name = new_name(e);
    actuator.joint = named->joint;
    actuator.gear_ratio = gear * law.gain[0];
    actuator.where = given ? xml().value(e, "name") : xml().element(e);
    const bool is_input = gear * law.gain[0] != 0, is_law = gear != 0 && has_bias(law);
    if (!is_input && !is_law)
      return file_.warning(actuator.where, label + " has no effect: its gear or gain is zero");
    if (!is_input)
      xml().diagnostics().note(actuator.where, label + " has a gain of zero: its bias acts, it is no input");
    if (file_.holder(e, "forcerange") && file_.word(e, "forcelimited").value_or("auto") != "false")
      force_limits_.add(xml().value(*file_.holder(e, "forcerange"), "forcerange"), actuator.name);
    warn_of(e, label, "damping", "joints have 'damping' of their own");
    warn_of(e, label, "armature", "joints have 'armature' of their own");
    warn_of(e, label, "delay", "the actuator acts at once");
    add_bias(actuator, gear, law);
    if (is_input) bodies_.mechanism.actuators.push_back(std::move(actuator));
  }

  /// At some position or velocity.
  static bool has_bias(const MjcfLaw& law) {
    return std::any_of(law.bias.begin(), law.bias.begin() + 3, [](double number) { return number != 0; });
  }

  std::string new_name(const XmlElement& e) {
    const bool given = e.Attribute("name") != nullptr;
    const std::optional<std::string> own = given ? xml().name(e) : std::nullopt;
    const char* joint = e.Attribute("joint") ? e.Attribute("joint") : e.Attribute("jointinparent");
    std::string name = own.value_or(joint);
    if (own && names_.contains(name)) {
      xml().complete().structure = false;
      file_.error(xml().value(e, "name"), fmt::format("there are two actuators '{}'", shown(name)));
    }
    for (int i = 2; names_.contains(name); ++i) name = fmt::format("{}_{}", own.value_or(joint), i);
    names_.insert(name);
    return name;
  }

  /// That of a motor where its own is none that is read, after a warning.
  MjcfLaw readable_law(const XmlElement& e, const std::string& label) {
    MjcfLaw law = law_of(file_, e);
    if (!law.is_affine()) {
      file_.warning(xml().element(e), label + " is read as a motor: its own law is not",
                    "the input is the force before the gear");
      return {};
    }
    if (law.has_damping_ratio()) {
      warn_of_ratio(e, label);
      law.bias[2] = 0;
    }
    if (law.is_position) warn_of_position(e, label, law);
    return law;
  }

  void warn_of_ratio(const XmlElement& e, const std::string& label) {
    if (file_.holder(e, "dampratio")) return warn_of(e, label, "dampratio", "kv damps");
    const XmlElement* numbers = file_.holder(e, "biasprm");
    file_.warning(numbers ? xml().value(*numbers, "biasprm") : xml().element(e),
                  fmt::format("the damping ratio of {} is ignored", label),
                  "in servos on positions the third number of the bias is one where it is positive");
  }

  void warn_of_position(const XmlElement& e, const std::string& label, const MjcfLaw& law) {
    if (!law.foreign.empty())
      file_.warning(xml().element(e),
                    fmt::format("{} takes over numbers of a default class of <{}>", label, law.foreign),
                    "as MuJoCo 3 does; other versions begin anew");
    if (law.dynamics == "none") return;
    const XmlElement* lag = file_.holder(e, "timeconst");
    if (lag && std::strcmp(lag->Name(), "position") == 0) return warn_of(e, label, "timeconst", kAtOnce);
    file_.warning(xml().element(e),
                  fmt::format("the activation dynamics that {} takes over are ignored", label), kAtOnce);
  }

  /// That a number of an actuator that is not zero is ignored, and what happens instead.
  void warn_of(const XmlElement& e, const std::string& label, const char* attribute,
               const std::string& instead) {
    if (file_.number(e, attribute, 0) != 0)
      file_.warning(xml().value(*file_.holder(e, attribute), attribute),
                    fmt::format("{} of {} is ignored", attribute, label), instead);
  }

  /// gear (b₀ + b₁ gear q + b₂ gear q̇) on the joint.
  void add_bias(const Actuator& actuator, double gear, const MjcfLaw& law) {
    const auto times_variable = [&](double factor, Variable::Kind kind) {
      return Expression::binary(Op::kMultiply, factor, Expression::variable({kind, actuator.joint.value, 0}));
    };
    CoordinateForce force;
    force.force = Expression::binary(
        Op::kAdd, gear * law.bias[0],
        Expression::binary(Op::kAdd, times_variable(gear * gear * law.bias[1], Variable::Kind::kPosition),
                           times_variable(gear * gear * law.bias[2], Variable::Kind::kVelocity)));
    if (force.force.is_zero()) return;
    force.name = actuator.name;
    force.joint = actuator.joint;
    force.where = actuator.where;
    bodies_.mechanism.coordinate_forces.push_back(std::move(force));
  }

  /// An armature adds to the joint's own inertia, whatever the gear: divided by what the rotor's is multiplied by.
  void carry_armatures() {
    Mechanism& mechanism = bodies_.mechanism;
    std::size_t count = 0;
    std::string first;
    SourceRange where;
    for (const std::string& name : bodies_.joint_order) {
      const MjcfBodies::NamedJoint& joint = bodies_.joints.at(name);
      if (joint.armature == 0) continue;
      Actuator* carrier = nullptr;
      for (Actuator& actuator : mechanism.actuators)
        if (!carrier && actuator.joint == joint.joint) carrier = &actuator;
      if (!carrier) {
        if (++count == 1) std::tie(first, where) = std::tie(name, joint.where);
        std::string input = name;
        while (!names_.insert(input).second) input += '_';
        mechanism.actuators.push_back({.name = input,
                                       .joint = joint.joint,
                                       .rotor_inertia = 0.0,
                                       .where = joint.where,
                                       .implied = true});
        carrier = &mechanism.actuators.back();
      }
      const double ratio = carrier->gear_ratio.constant();
      carrier->rotor_inertia = joint.armature / (ratio * ratio);
    }
    if (count == 0) return;
    const std::string others = count == 1 ? "" : fmt::format(" and {} more", count - 1);
    xml().diagnostics().note(
        where, fmt::format("joint '{}'{} with an armature and no actuator: an input is made for it",
                           shown(first), others));
  }

  MjcfFile& file_;
  MjcfBodies& bodies_;
  std::vector<double> disabled_;  ///< groups
  std::set<std::string> names_;
  std::size_t count_ = 0;
  Repeated force_limits_;
};

}  // namespace

void read_mjcf_actuators(MjcfFile& file, MjcfBodies& bodies) { ActuatorReader(file, bodies).read(); }

}  // namespace jourdain::model
