// The bodies, joints and sites of an MJCF file as parts of a mechanism.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/read/mjcf_inertia.hpp"
#include "model/read/read.hpp"

namespace jourdain::model {

/// Things of one kind that one message speaks of, at the first.
class Repeated {
 public:
  void add(SourceRange where, const std::string& name);
  /// Warns that `what`, such as "frictionloss of joint", "is ignored".
  void report(MjcfFile& file, const std::string& what, const std::string& consequence,
              const std::string& hint) const;

 private:
  std::string first_;
  SourceRange where_;
  std::size_t count_ = 0;
};

/// What the other sections of the file refer to by name.
struct MjcfBodies {
  struct NamedJoint {
    JointIndex joint;
    JointType type = JointType::kFixed;
    double reference = 0;  ///< of the coordinate where the file draws the mechanism, rad or m
    double armature = 0;   ///< kg m² or kg
    SourceRange where;     ///< of the armature
  };
  struct NamedBody {
    BodyIndex body;
    Pose pose;  ///< in the inertial frame, where the file draws the mechanism
  };
  Mechanism mechanism;
  std::map<std::string, NamedBody> bodies;
  std::map<std::string, FrameIndex> sites;
  std::map<std::string, NamedJoint> joints;
  std::vector<std::string> joint_order;  ///< as in MuJoCo's qpos
};

/// Reads <worldbody>. Each joint of a body with several moves a body of its own without mass, in order; where a joint's
/// anchor is not the body's origin, the body is fixed to the one that the joint moves.
class MjcfBodyReader {
 public:
  MjcfBodyReader(MjcfFile& file, const ReadOptions& options)
      : file_(file), options_(options), inertia_(file) {}

  MjcfBodies read();

 private:
  struct Contents {
    const XmlElement* inertial = nullptr;
    std::vector<PlacedElement> joints, geoms, sites, bodies;
  };
  /// A body that is being carried outward by its joints.
  struct Chain {
    std::optional<BodyIndex> parent;
    Pose pose;   ///< of the body's frame in the parent's
    Pose world;  ///< of the body's frame, inertial
  };
  void gather(const XmlElement& element, const Pose& frame, Contents& contents);
  void read_body(const PlacedElement& placed, std::optional<BodyIndex> parent, const Pose& parent_in_world);
  void carry(BodyIndex body, const std::vector<PlacedElement>& joints, Chain chain);
  bool moves_origin(const PlacedElement& joint);
  void read_joint(const PlacedElement& placed, Chain& chain, bool alone, std::optional<BodyIndex> last,
                  const std::string& body_name);
  void read_free(const XmlElement& element, const Chain& chain, bool alone, Joint& joint);
  static void step_back(Pose& pose, const Joint& joint, double reference);
  BodyIndex add_carried_body(const std::string& body_name, const Joint& joint);
  void read_motion(const XmlElement& element, Joint& joint, MjcfBodies::NamedJoint& named);
  void read_range(const XmlElement& element, double unit, Coordinate& coordinate);
  void read_sites(const std::vector<PlacedElement>& sites, std::optional<BodyIndex> body);
  void not_of_scalars(const XmlElement& element, Joint& joint);
  JointType joint_type(const XmlElement& element);
  static bool is_free(const XmlElement& element) { return std::string_view(element.Name()) == "freejoint"; }
  /// Whether the mechanism may have one more body; an error where not, once.
  bool has_room(const XmlElement& element);
  BodyIndex add_body(Body body);
  void join(std::optional<BodyIndex> parent, BodyIndex child, Joint joint);
  /// The element's name; where it has none, one that begins with `otherwise`.
  std::string given_name(const XmlElement& element, const std::string& otherwise,
                         std::map<std::string, SourceRange>& names);
  std::string new_name(const std::string& wanted, const std::map<std::string, SourceRange>& names) const;

  MjcfFile& file_;
  const ReadOptions& options_;
  MjcfInertia inertia_;
  MjcfBodies result_;
  std::map<std::string, SourceRange> body_names_, joint_names_, site_names_;
  Repeated friction_, force_limits_;
};

}  // namespace jourdain::model
