#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "model/read/mjcf_sections.hpp"

namespace jourdain::model {

namespace {

const XmlElement* home(const XmlElement& root) {
  for (const auto* section = root.FirstChildElement("keyframe"); section;
       section = section->NextSiblingElement("keyframe"))
    for (const auto* e = section->FirstChildElement("key"); e; e = e->NextSiblingElement("key"))
      if (e->Attribute("name") && std::string_view(e->Attribute("name")) == "home") return e;
  return nullptr;
}

/// Numbers of a joint in MuJoCo's qpos and qvel.
std::size_t position_count(JointType type) {
  return type == JointType::kFree ? 7 : type == JointType::kSpherical ? 4 : 1;
}
std::size_t velocity_count(JointType type) {
  return type == JointType::kFree ? 6 : type == JointType::kSpherical ? 3 : 1;
}

/// Takes the numbers of a list one after the other.
class Taking {
 public:
  Taking(const std::vector<double>& numbers, SourceRange where) : numbers_(numbers), where_(where) {}
  double next() { return numbers_[at_++]; }
  void three(Vector3& into) {
    for (Expression& entry : into) entry = next();
  }
  SourceRange where() const { return where_; }

 private:
  const std::vector<double>& numbers_;
  SourceRange where_;
  std::size_t at_ = 0;
};

/// A quaternion of any length; one that is zero or not finite stays as it was.
void take_orientation(Taking& from, Joint& joint) {
  std::array<double, 4> q{from.next(), from.next(), from.next(), from.next()};
  const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(length > 0)) return;
  joint.initial_orientation = {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
  joint.orientation_where = from.where();
}

void take_position(Taking& from, Joint& joint) {
  if (joint.type == JointType::kFree) {
    from.three(joint.initial_origin);
    joint.origin_where = from.where();
  }
  if (joint.coordinates.empty()) return take_orientation(from, joint);
  joint.coordinates.front().initial_position = from.next();
  joint.coordinates.front().position_where = from.where();
}

void take_velocity(Taking& from, Joint& joint) {
  if (joint.type == JointType::kFree) {
    from.three(joint.initial_origin_velocity);
    joint.origin_velocity_where = from.where();
  }
  if (joint.coordinates.empty()) {
    from.three(joint.initial_spin);
    joint.spin_where = from.where();
    return;
  }
  joint.coordinates.front().initial_velocity = from.next();
  joint.coordinates.front().velocity_where = from.where();
}

}  // namespace

void read_mjcf_keyframe(MjcfFile& file, MjcfBodies& bodies) {
  const XmlElement* key = home(file.root());
  if (!key) return;
  const auto each = [&](const char* attribute, auto count, auto take) {
    if (!key->Attribute(attribute)) return;
    std::size_t all = 0;
    for (const auto& [name, joint] : bodies.joints) all += count(joint.type);
    const std::vector<double> numbers = file.numbers(*key, attribute, std::vector<double>(all), all);
    Taking from(numbers, file.xml().value(*key, attribute));
    for (const std::string& name : bodies.joint_order)
      take(from, bodies.mechanism.joints[bodies.joints.at(name).joint.value]);
  };
  each("qpos", position_count, take_position);
  each("qvel", velocity_count, take_velocity);
}

}  // namespace jourdain::model
