#include "model/read/urdf_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::model {

namespace {

using support::shown;

struct ElementOfUrdf {
  const char* name;
  std::vector<std::string> attributes;
  bool moves = true;  ///< what else it says may be meant to change the motion
};

/// Of links, joints and what lies within them (wiki.ros.org/urdf/XML); limits of acceleration and jerk are ROS 2's.
const std::vector<ElementOfUrdf>& elements() {
  static const std::vector<ElementOfUrdf> list = {
      {"link", {"name", "type"}, false},
      {"joint", {"name", "type"}, false},
      {"inertial", {}},
      {"origin", {"xyz", "rpy", "quat_xyzw"}},
      {"mass", {"value"}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}},
      {"parent", {"link"}, false},
      {"child", {"link"}, false},
      {"axis", {"xyz"}},
      {"dynamics", {"damping", "friction"}},
      {"limit", {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"}, false},
      {"mimic", {"joint", "multiplier", "offset"}},
  };
  return list;
}

/// Says once what is ignored, however often it is: at the first place.
class Ignored {
 public:
  explicit Ignored(UrdfFile& file) : file_(file) {}

  void add(SourceRange where, const std::string& what, const std::string& hint, bool warns) {
    const auto [place, is_new] = numbers_.try_emplace(what, list_.size());
    if (is_new)
      list_.push_back({where, what, hint, warns, 1});
    else
      ++list_[place->second].count;
  }

  void report() {
    for (const Entry& entry : list_) {
      const std::string more =
          entry.count == 1 ? "" : fmt::format(", here and {} times more", entry.count - 1);
      const std::string message = fmt::format("{} is ignored{}", entry.what, more);
      if (entry.warns)
        file_.diagnostics().warning(entry.where, message, entry.hint);
      else
        file_.diagnostics().note(entry.where, message, entry.hint);
    }
  }

 private:
  struct Entry {
    SourceRange where;
    std::string what, hint;
    bool warns = false;
    std::size_t count = 0;
  };

  UrdfFile& file_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<Entry> list_;
};

class SchemaCheck {
 public:
  explicit SchemaCheck(UrdfFile& file) : file_(file), ignored_(file) {}

  void check(const XmlElement& robot) {
    for (const char* name : {"link", "joint"})
      for_each(robot, name, [this](const XmlElement& item) { check_attributes(item); });
    for_each(robot, "gazebo", [this](const XmlElement& item) { check_gazebo(item); });
    for_each(robot, "loop_joint", [this](const XmlElement& item) {
      ignore(item, "a [[loop]] of TOML closes a chain, after an [[import]] of this file");
    });
    for_each(robot, "transmission", [this](const XmlElement& transmission) {
      for_each(transmission, "actuator", [this](const XmlElement& actuator) {
        for_each(actuator, "motorInertia", [this](const XmlElement& inertia) {
          if (has_number(inertia)) ignore(inertia, "'rotor_inertia' of an [[actuator]] of TOML is that");
        });
      });
    });
    ignored_.report();
  }

 private:
  template <class Visit>
  static void for_each(const XmlElement& parent, const char* name, const Visit& visit) {
    for (const auto* e = parent.FirstChildElement(name); e; e = e->NextSiblingElement(name)) visit(*e);
  }

  static bool has_number(const XmlElement& item) { return item.DoubleText(0) != 0; }

  static bool is_text(const XmlElement& item, std::initializer_list<std::string_view> texts) {
    const std::string_view text = item.GetText() ? item.GetText() : "";
    return std::find(texts.begin(), texts.end(), text) != texts.end();
  }

  void check_attributes(const XmlElement& item) {
    for (const ElementOfUrdf& known : elements()) {
      if (std::string_view(item.Name()) != known.name) continue;
      for (const std::string& name : UrdfFile::other_attributes(item, known.attributes))
        tell_attribute(item, name, known);
      for (const auto* e = item.FirstChildElement(); e; e = e->NextSiblingElement()) check_attributes(*e);
    }
  }

  void tell_attribute(const XmlElement& item, const std::string& name, const ElementOfUrdf& known) {
    const std::string close = support::nearest(name, known.attributes);
    if (close.empty() && !known.moves) return;
    ignored_.add(file_.value(item, name.c_str()),
                 fmt::format("attribute '{}' of <{}>", shown(name), shown(item.Name())),
                 close.empty() ? "" : fmt::format("did you mean '{}'?", close), !close.empty());
  }

  void check_gazebo(const XmlElement& gazebo) {
    for (const auto* e = gazebo.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (name == "springStiffness" && has_number(*e)) ignore(*e, "a joint of TOML has 'stiffness'");
      if (name == "dampingFactor" && has_number(*e)) ignore(*e, "<dynamics> of a joint has 'damping'");
      if ((name == "turnGravityOff" && is_text(*e, {"true", "1"})) ||
          (name == "gravity" && is_text(*e, {"false", "0"})))
        ignore(*e, "the body has its weight");
    }
  }

  void ignore(const XmlElement& item, const char* hint) {
    ignored_.add(file_.element(item),
                 fmt::format("<{}> of <{}>", shown(item.Name()), shown(item.Parent()->ToElement()->Name())),
                 hint, true);
  }

  UrdfFile& file_;
  Ignored ignored_;
};

}  // namespace

void check_urdf(UrdfFile& file, const XmlElement& robot) { SchemaCheck(file).check(robot); }

}  // namespace jourdain::model
