#include <fmt/format.h>

#include <cstring>
#include <set>

#include "model/coupler.hpp"
#include "model/read/mjcf_sections.hpp"

namespace jourdain::model {

namespace {

using Op = Expression::Op;

class EqualityReader {
 public:
  EqualityReader(MjcfFile& file, MjcfBodies& bodies) : file_(file), bodies_(bodies) {
    for (const Frame& frame : bodies.mechanism.frames) frame_names_.insert(frame.name);
  }

  void read() {
    const XmlElement& root = file_.root();
    for (const auto* section = root.FirstChildElement("equality"); section;
         section = section->NextSiblingElement("equality"))
      for (const auto* e = section->FirstChildElement(); e; e = e->NextSiblingElement()) read_equality(*e);
  }

 private:
  UrdfFile& xml() { return file_.xml(); }

  void read_equality(const XmlElement& e) {
    if (++count_ > kMaximumBodies) {
      xml().complete().structure = false;
      if (count_ == kMaximumBodies + 1)
        file_.error(xml().element(e), fmt::format("the file has more than {} equalities", kMaximumBodies));
      return;
    }
    const std::string kind = e.Name();
    const bool is_weld = kind == "weld";
    if (!file_.truth(e, "active", true))
      return xml().diagnostics().note(xml().element(e), fmt::format("<{}> is not active: left out", kind));
    if (kind == "joint") return read_joint(e);
    if (is_weld || kind == "connect") return read_ends(e, is_weld);
    if (kind == "tendon" || kind.starts_with("flex") || kind == "distance")
      file_.warning(xml().element(e), fmt::format("<{}> of <equality> is not read", kind),
                    "the mechanism moves without it");
  }

  /// One body, or the world, of a connect or weld.
  struct End {
    std::optional<BodyIndex> body;
    Pose pose;  ///< of the body, inertial
    std::string name = "world";
  };
  struct Ends {
    FrameIndex from, to;
  };

  std::optional<End> end(const XmlElement& e, const char* attribute) {
    const char* name = e.Attribute(attribute);
    if (!name || std::strcmp(name, "world") == 0) return End{};
    const MjcfBodies::NamedBody* named = find_named(file_, e, attribute, "body", bodies_.bodies);
    if (!named) return {};
    return End{named->body, named->pose, name};
  }

  FrameIndex add_frame(const std::string& name, const End& on, const Pose& pose, SourceRange where) {
    Frame frame;
    frame.name = name;
    for (int i = 2; !frame_names_.insert(frame.name).second; ++i) frame.name = fmt::format("{}_{}", name, i);
    frame.body = on.body;
    frame.placement = placement_of(pose, where);
    frame.where = where;
    bodies_.mechanism.frames.push_back(std::move(frame));
    return FrameIndex(bodies_.mechanism.frames.size() - 1);
  }

  /// A weld without torque is a connect.
  void read_ends(const XmlElement& e, bool is_weld) {
    const bool holds_direction = is_weld && file_.number(e, "torquescale", 1) != 0;
    const SourceRange where = xml().element(e);
    if (e.Attribute("site1") || e.Attribute("site2")) {
      if (!xml().required(e, "site1") || !xml().required(e, "site2")) return;
      const FrameIndex* from = find_named(file_, e, "site1", "site", bodies_.sites);
      const FrameIndex* to = find_named(file_, e, "site2", "site", bodies_.sites);
      if (from && to)
        add_loops(e, {*from, *to}, holds_direction,
                  fmt::format("{}_{}", e.Attribute("site1"), e.Attribute("site2")));
      return;
    }
    if (!xml().required(e, "body1") || (!is_weld && !xml().required(e, "anchor"))) {
      xml().complete().structure = false;
      return;
    }
    const std::optional<End> first = end(e, "body1"), second = end(e, "body2");
    if (!first || !second) return;
    const Pose drawn = composed(inverse(first->pose), second->pose);  // of the second body in the first
    const Numbers3 anchor = file_.triple(e, "anchor", {});
    const std::string name = fmt::format("{}_{}", first->name, second->name);
    const auto both = [&](const Pose& on_first, const Pose& on_second) {
      return Ends{add_frame(name + "_from", *first, on_first, where),
                  add_frame(name + "_to", *second, on_second, where)};
    };
    if (!is_weld)
      return add_loops(e, both({anchor, kIdentity3}, {point_at(inverse(drawn), anchor), kIdentity3}),
                       holds_direction, name);
    const Pose at_anchor{anchor, kIdentity3};
    add_loops(e, both(relative_pose(e).value_or(composed(drawn, at_anchor)), at_anchor), holds_direction,
              name);
  }

  /// Where a weld holds the second body's anchor in the first, and how that body is turned. None where relpose has no
  /// quaternion: as drawn.
  std::optional<Pose> relative_pose(const XmlElement& e) {
    const std::vector<double> given = file_.numbers(e, "relpose", {0, 1, 0, 0, 0, 0, 0}, 7);
    const std::optional<Matrix3> R = rotation_from_quaternion({given[3], given[4], given[5], given[6]});
    if (!R) return {};
    return Pose{{given[0], given[1], given[2]}, *R};
  }

  void add_loops(const XmlElement& e, const Ends& ends, bool holds_direction, const std::string& otherwise) {
    Loop loop;
    loop.name = new_name(e, otherwise);
    loop.type = holds_direction ? LoopType::kPrismatic : LoopType::kBall;
    loop.from = ends.from;
    loop.to = ends.to;
    loop.where = xml().element(e);
    bodies_.mechanism.loops.push_back(loop);
    if (!holds_direction) return;
    // A slide that is stopped: five rows and the sixth.
    loop.name = unused(loop.name + "_stop");
    loop.type = LoopType::kPointInPlane;
    loop.continues = true;
    bodies_.mechanism.loops.push_back(std::move(loop));
  }

  std::string new_name(const XmlElement& e, const std::string& otherwise) {
    const std::optional<std::string> own = e.Attribute("name") ? xml().name(e) : std::nullopt;
    return unused(own.value_or(otherwise));
  }

  std::string unused(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    return name;
  }

  const MjcfBodies::NamedJoint* scalar_joint(const XmlElement& e, const char* attribute) {
    const MjcfBodies::NamedJoint* joint = find_named(file_, e, attribute, "joint", bodies_.joints);
    if (!joint || joint->type == JointType::kRevolute || joint->type == JointType::kPrismatic) return joint;
    xml().complete().structure = false;
    file_.error(xml().value(e, attribute), "<joint> of <equality> is of hinges and slides");
    return nullptr;
  }

  /// y₁ − ref₁ = a₀ + a₁ d + … + a₄ d⁴ with d = y₂ − ref₂.
  void read_joint(const XmlElement& e) {
    if (!xml().required(e, "joint1")) {
      xml().complete().structure = false;
      return;
    }
    const bool alone = e.Attribute("joint2") == nullptr;
    const MjcfBodies::NamedJoint* first = scalar_joint(e, "joint1");
    const MjcfBodies::NamedJoint* second = alone ? nullptr : scalar_joint(e, "joint2");
    if (!first || (!alone && !second)) return;
    std::vector<double> a = file_.numbers(e, "polycoef", {0, 1, 0, 0, 0}, 1);
    const std::string name =
        new_name(e, alone ? e.Attribute("joint1")
                          : fmt::format("{}_{}", e.Attribute("joint1"), e.Attribute("joint2")));
    std::vector<CouplerTerm> terms{{first->joint, 0, 1.0}};
    const bool linear = alone || (a[2] == 0 && a[3] == 0 && a[4] == 0);
    double offset = first->reference + a[0];
    if (linear && !alone && a[1] != 0) {
      terms.push_back({second->joint, 0, -a[1]});
      offset -= a[1] * second->reference;
    }
    Loop loop = coupler(name, terms, offset, xml().element(e));
    if (!linear) {
      const Expression position = Expression::variable({Variable::Kind::kPosition, second->joint.value, 0});
      const Expression d = Expression::binary(Op::kSubtract, position, second->reference);
      Expression powers = a[4];
      for (std::size_t k = 4; k-- > 1;)
        powers = Expression::binary(Op::kAdd, a[k], Expression::binary(Op::kMultiply, powers, d));
      loop.residual =
          Expression::binary(Op::kSubtract, loop.residual, Expression::binary(Op::kMultiply, powers, d));
    }
    bodies_.mechanism.loops.push_back(std::move(loop));
  }

  MjcfFile& file_;
  MjcfBodies& bodies_;
  std::set<std::string> names_, frame_names_;
  std::size_t count_ = 0;
};

}  // namespace

void read_mjcf_equalities(MjcfFile& file, MjcfBodies& bodies) { EqualityReader(file, bodies).read(); }

}  // namespace jourdain::model
