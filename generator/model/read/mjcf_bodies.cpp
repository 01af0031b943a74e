#include "model/read/mjcf_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace jourdain::model {

using support::shown;

namespace {

bool is_zero(const Numbers3& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// A name that the file gives, for the name of what it does not name.
void reserve(const XmlElement& element, std::map<std::string, SourceRange>& bodies,
             std::map<std::string, SourceRange>& joints) {
  for (const auto* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const char* name = e->Attribute("name");
    const std::string tag = e->Name();
    if (name && tag == "body") bodies.emplace(name, SourceRange{});
    if (name && (tag == "joint" || tag == "freejoint")) joints.emplace(name, SourceRange{});
    reserve(*e, bodies, joints);
  }
}

}  // namespace

void Repeated::add(SourceRange where, const std::string& name) {
  if (++count_ > 1) return;
  first_ = name;
  where_ = where;
}

void Repeated::report(MjcfFile& file, const std::string& what, const std::string& consequence,
                      const std::string& hint) const {
  if (count_ == 0) return;
  const std::string others = count_ == 1 ? "" : fmt::format(" and of {} more", count_ - 1);
  file.warning(where_, fmt::format("{} '{}'{} {}", what, shown(first_), others, consequence), hint);
}

MjcfBodies MjcfBodyReader::read() {
  const XmlElement& root = file_.root();
  Contents world;
  for (const auto* e = root.FirstChildElement("worldbody"); e; e = e->NextSiblingElement("worldbody")) {
    reserve(*e, body_names_, joint_names_);
    gather(*e, {}, world);
  }
  for (const PlacedElement& joint : world.joints) {
    file_.xml().complete().structure = false;
    file_.error(file_.xml().element(*joint.element),
                "a joint stands within <worldbody>, outside of all bodies");
  }
  read_sites(world.sites, std::nullopt);
  for (const PlacedElement& body : world.bodies) read_body(body, std::nullopt, {});
  inertia_.scale(result_.mechanism.bodies);
  friction_.report(file_, "frictionloss of joint", "is ignored",
                   "--friction takes it, smoothed over 1e-3 rad/s or m/s");
  force_limits_.report(file_, "actuatorfrcrange of joint", "is ignored",
                       "forces of actuators are not clipped");
  return std::move(result_);
}

/// What a body or <worldbody> holds, in order; what is in a <frame> with the place of that.
void MjcfBodyReader::gather(const XmlElement& element, const Pose& frame, Contents& contents) {
  for (const auto* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string name = e->Name();
    if (name == "frame") gather(*e, composed(frame, file_.pose(*e)), contents);
    if (name == "body") contents.bodies.push_back({e, frame});
    if (name == "geom") contents.geoms.push_back({e, frame});
    if (name == "site") contents.sites.push_back({e, frame});
    if (name == "joint" || name == "freejoint") contents.joints.push_back({e, frame});
    if (name != "inertial") continue;
    if (contents.inertial || std::strcmp(element.Name(), "body") != 0)
      file_.error(file_.xml().element(*e),
                  contents.inertial ? "a body has two <inertial>" : "<inertial> stands outside of a body",
                  contents.inertial ? fmt::format("the first one stands at line {}",
                                                  file_.xml().element(*contents.inertial).line)
                                    : "");
    contents.inertial = e;
  }
}

void MjcfBodyReader::read_body(const PlacedElement& placed, std::optional<BodyIndex> parent,
                               const Pose& parent_in_world) {
  const XmlElement& e = *placed.element;
  UrdfFile& xml = file_.xml();
  if (!has_room(e)) return;
  Contents contents;
  gather(e, {}, contents);
  Body body;
  body.name = given_name(e, "body", body_names_);
  body.where = e.Attribute("name") ? xml.value(e, "name") : xml.element(e);
  inertia_.read(e, contents.inertial, contents.geoms, body);
  if (e.Attribute("gravcomp") && file_.number(e, "gravcomp", 0) != 0)
    file_.warning(xml.value(e, "gravcomp"),
                  fmt::format("gravcomp of body '{}' is ignored", shown(body.name)));
  if (file_.truth(e, "mocap", false))
    file_.warning(xml.value(e, "mocap"),
                  fmt::format("mocap body '{}' stays where the file puts it", shown(body.name)));
  const Pose pose = composed(placed.frame, file_.pose(e)), world = composed(parent_in_world, pose);
  const std::string name = body.name;
  const BodyIndex index = add_body(std::move(body));
  result_.bodies[name] = {index, world};
  carry(index, contents.joints, {parent, pose, world});
  read_sites(contents.sites, index);
  for (const PlacedElement& child : contents.bodies) read_body(child, index, world);
}

/// Joins the body to its parent. It stands on its last joint, or is fixed to a body of its own there.
void MjcfBodyReader::carry(BodyIndex body, const std::vector<PlacedElement>& joints, Chain chain) {
  const std::string name = result_.mechanism.bodies[body.value].name;
  const SourceRange where = result_.mechanism.bodies[body.value].where;
  const bool apart = !joints.empty() && moves_origin(joints.back());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool last = j + 1 == joints.size() && !apart;
    read_joint(joints[j], chain, joints.size() == 1, last ? std::optional(body) : std::nullopt, name);
  }
  if (chain.parent == body) return;
  Joint fixed;
  fixed.name = new_name(name + (joints.empty() ? "_fixed" : "_origin"), joint_names_);
  fixed.where = where;
  fixed.placement = placement_of(chain.pose, where);
  join(chain.parent, body, std::move(fixed));
}

/// Whether the joint turns the body about another point than its origin.
bool MjcfBodyReader::moves_origin(const PlacedElement& joint) {
  const std::string type = file_.word(*joint.element, "type").value_or("hinge");
  if (is_free(*joint.element) || (type != "hinge" && type != "ball")) return false;
  return !is_zero(point_at(joint.frame, file_.triple(*joint.element, "pos", {})));
}

bool MjcfBodyReader::has_room(const XmlElement& e) {
  if (result_.mechanism.bodies.size() < kMaximumBodies) return true;
  if (file_.xml().complete().structure)
    file_.error(file_.xml().element(e),
                fmt::format("the file has more than {} bodies and joints that move one", kMaximumBodies));
  file_.xml().complete().structure = false;
  return false;
}

BodyIndex MjcfBodyReader::add_body(Body body) {
  const BodyIndex index(result_.mechanism.bodies.size());
  result_.mechanism.bodies.push_back(std::move(body));
  return index;
}

void MjcfBodyReader::join(std::optional<BodyIndex> parent, BodyIndex child, Joint joint) {
  joint.parent = parent;
  joint.child = child;
  joint_names_[joint.name] = joint.where;
  result_.mechanism.joints.push_back(std::move(joint));
}

std::string MjcfBodyReader::given_name(const XmlElement& e, const std::string& otherwise,
                                       std::map<std::string, SourceRange>& names) {
  const std::optional<std::string> given = e.Attribute("name") ? file_.xml().name(e) : std::nullopt;
  const SourceRange where = given ? file_.xml().value(e, "name") : file_.xml().element(e);
  std::string name = given ? *given : new_name(otherwise, names);
  SourceRange& first = names[name];
  if (first.line != 0) {
    file_.xml().complete().structure = false;
    file_.error(where, fmt::format("there are two <{}> with the name '{}'", e.Name(), shown(name)),
                fmt::format("first declared at line {}", first.line));
  }
  first = where;
  return name;
}

std::string MjcfBodyReader::new_name(const std::string& wanted,
                                     const std::map<std::string, SourceRange>& names) const {
  std::string name = wanted;
  for (int i = 2; names.contains(name); ++i) name = fmt::format("{}_{}", wanted, i);
  return name;
}

void MjcfBodyReader::read_sites(const std::vector<PlacedElement>& sites, std::optional<BodyIndex> body) {
  for (const PlacedElement& site : sites) {
    if (!site.element->Attribute("name")) continue;
    if (const XmlElement* ends = file_.holder(*site.element, "fromto")) {
      file_.warning(file_.xml().value(*ends, "fromto"), "a site with 'fromto' is no frame here",
                    "give its pos");
      continue;
    }
    Frame frame;
    frame.name = given_name(*site.element, "site", site_names_);
    frame.where = file_.xml().value(*site.element, "name");
    frame.body = body;
    frame.placement = placement_of(composed(site.frame, file_.pose(*site.element)), frame.where);
    result_.sites[frame.name] = FrameIndex(result_.mechanism.frames.size());
    result_.mechanism.frames.push_back(std::move(frame));
  }
}

}  // namespace jourdain::model
