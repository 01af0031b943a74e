#include "model/read/sdf_joint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "model/joint_kinds.hpp"

namespace jourdain::model {

namespace {

using support::shown;

class JointReader {
 public:
  JointReader(SdfFile& file, SdfFrames& frames, const SdfJointElement& given, const ReadOptions& options)
      : file_(file), frames_(frames), element_(*given.element), scope_(given.scope), options_(options) {}

  std::optional<SdfJoint> read() {
    file_.check_elements(element_,
                         {"parent", "child", "pose", "axis", "axis2", "thread_pitch", "screw_thread_pitch",
                          "gearbox_ratio", "gearbox_reference_body", "gearbox_reference_body_parent",
                          "gearbox_reference_body_child", "physics", "sensor", "plugin"});
    joint().name = scope_ + element_.Attribute("name");
    joint().where = file_.value(element_, "name");
    const std::optional<JointType> type = joint_type();
    const std::optional<std::string> parent = end("parent"), child = end("child");
    if (!type || !parent || !child) return {};
    joint().set_type(*type);
    joint().parent = frames_.link(*parent);
    const std::optional<BodyIndex> carried = frames_.link(*child);
    if (!carried) {
      file_.error(joint().child_where,
                  fmt::format("joint '{}' has the world as its child", shown(joint().name)),
                  "the world cannot move");
      return {};
    }
    joint().child = *carried;
    if (joint().parent == joint().child) {
      file_.error(joint().child_where,
                  fmt::format("joint '{}' joins a link with itself", shown(joint().name)));
      return {};
    }
    read_.pose = frames_.pose(joint().name);
    read_.pose_where = file_.element(element_);
    if (const XmlElement* pose = element_.FirstChildElement("pose")) read_.pose_where = file_.element(*pose);
    read_.limits.resize(joint().coordinates.size());
    joint().axis = axis("axis");
    if (*type == JointType::kUniversal || read_.gearbox) joint().second_axis = axis("axis2");
    for (std::size_t c = 0; c < joint().coordinates.size(); ++c) read_coordinate(c);
    if (*type == JointType::kSpherical) look_at_ball();
    if (*type == JointType::kScrew) read_pitch();
    if (read_.gearbox && !read_gearbox()) return {};
    return std::move(read_);
  }

 private:
  Joint& joint() { return read_.joint; }

  std::optional<JointType> joint_type() {
    const std::optional<std::string> type = file_.required(element_, "type");
    if (!type) return {};
    if (*type == "revolute" || *type == "continuous") return JointType::kRevolute;
    if (*type == "prismatic") return JointType::kPrismatic;
    if (*type == "fixed") return JointType::kFixed;
    if (*type == "ball") return JointType::kSpherical;
    if (*type == "universal" || *type == "revolute2") return JointType::kUniversal;
    if (*type == "screw") return JointType::kScrew;
    if (*type == "gearbox") {
      read_.gearbox.emplace();
      return JointType::kFixed;
    }
    const std::string close = support::nearest(*type, {"revolute", "continuous", "prismatic", "fixed", "ball",
                                                       "universal", "revolute2", "screw", "gearbox"});
    file_.error(file_.value(element_, "type"),
                fmt::format("joint '{}' has unknown type '{}'", shown(joint().name), shown(*type)),
                close.empty() ? "known are revolute, continuous, prismatic, fixed, ball, universal, "
                                "revolute2, screw, gearbox"
                              : fmt::format("did you mean '{}'?", close));
    return {};
  }

  /// The whole name of the frame that <parent> or <child> names.
  std::optional<std::string> end(const char* which) {
    const std::optional<std::string> name = file_.text_in(element_, which);
    if (!name || name->empty()) {
      file_.error(file_.element(element_), fmt::format("joint '{}' needs <{}>", shown(joint().name), which));
      return {};
    }
    const SourceRange where = file_.element(*element_.FirstChildElement(which));
    if (std::string_view(which) == "child") joint().child_where = where;
    return frames_.find(scope_, *name, where, fmt::format("joint '{}' names", shown(joint().name)));
  }

  /// In the joint's frame. Up to 1.4 it is given in that of the model, in 1.5 and 1.6 where the file says so, later in
  /// any frame.
  std::array<double, 3> axis(const char* name) {
    constexpr std::array<double, 3> kStandard{0, 0, 1};
    const XmlElement* found = file_.child(element_, name);
    const XmlElement* xyz = found ? file_.child(*found, "xyz") : nullptr;
    const std::array<double, 3> given = xyz ? file_.triple_of(*xyz, kStandard) : kStandard;
    if (xyz) file_.check_attributes(*xyz, {file_.version > 6 ? "expressed_in" : ""});
    if (xyz && name == std::string_view("axis")) joint().axis_where = file_.element(*xyz);
    if (found && file_.version > 6 && found->FirstChildElement("use_parent_model_frame"))
      file_.diagnostics().warning(file_.element(*found->FirstChildElement("use_parent_model_frame")),
                                  "<use_parent_model_frame> is ignored from SDF 1.7 on",
                                  "<xyz expressed_in=\"__model__\"> says the same");
    std::string base;
    if (found && file_.version <= 6 && file_.flag_in(*found, "use_parent_model_frame", file_.version < 5))
      base = "__model__";
    if (const char* frame = xyz && file_.version > 6 ? xyz->Attribute("expressed_in") : nullptr) base = frame;
    if (base.empty()) return given;
    const auto whole = frames_.find(scope_, base, file_.element(*found),
                                    fmt::format("the axis of joint '{}' names", shown(joint().name)));
    const SdfPose from = whole ? frames_.pose(*whole) : SdfPose();
    const Matrix3 R = relative(read_.pose, from).rotation;
    return R == kIdentity3 ? given : product(R, given);
  }

  void read_coordinate(std::size_t c) {
    const XmlElement* found = element_.FirstChildElement(c == 0 ? "axis" : "axis2");
    if (!found) return;
    file_.check_elements(*found,
                         {"xyz", "dynamics", "limit", "mimic", "use_parent_model_frame", "initial_position"});
    Coordinate& coordinate = joint().coordinates[c];
    if (const XmlElement* dynamics = file_.child(*found, "dynamics")) {
      file_.check_elements(*dynamics, {"damping", "friction", "spring_stiffness", "spring_reference"});
      if (options_.damping) coordinate.damping = file_.number_in(*dynamics, "damping", 0);
      coordinate.friction = file_.number_in(*dynamics, "friction", 0);
      coordinate.stiffness = file_.number_in(*dynamics, "spring_stiffness", 0);
      coordinate.rest = file_.number_in(*dynamics, "spring_reference", 0);
      if (options_.friction && coordinate.friction.constant() < 0)
        file_.error(file_.element(*dynamics->FirstChildElement("friction")),
                    fmt::format("the friction of joint '{}' is negative", shown(joint().name)));
    }
    if (file_.child(*found, "initial_position")) {
      coordinate.initial_position = file_.number_in(*found, "initial_position", 0);
      coordinate.position_where = file_.element(*found->FirstChildElement("initial_position"));
    }
    const bool is_endless = std::string_view(element_.Attribute("type")) == "continuous";
    if (const XmlElement* limit = is_endless ? nullptr : file_.child(*found, "limit")) {
      const auto lower = file_.limit_in(*limit, "lower"), upper = file_.limit_in(*limit, "upper");
      if (lower && upper && *lower < *upper) read_.limits[c] = {*lower, *upper};
    }
    if (const XmlElement* mimic = options_.mimic ? file_.child(*found, "mimic") : nullptr)
      read_mimic(*mimic, c);
  }

  /// A ball joint has no coordinate for what dynamics its axis may have.
  void look_at_ball() {
    const XmlElement* found = element_.FirstChildElement("axis");
    const XmlElement* dynamics = found ? file_.child(*found, "dynamics") : nullptr;
    if (!dynamics) return;
    for (const char* name : {"damping", "friction", "spring_stiffness"})
      if (file_.number_in(*dynamics, name, 0) != 0)
        return file_.diagnostics().warning(
            file_.element(*dynamics->FirstChildElement(name)),
            fmt::format("the <{}> of ball joint '{}' is ignored", name, shown(joint().name)));
  }

  void read_mimic(const XmlElement& mimic, std::size_t c) {
    const std::optional<std::string> leader = file_.required(mimic, "joint");
    if (!leader) return;
    SdfMimic read{.coordinate = c, .leader = scope_ + *leader, .where = file_.element(mimic)};
    const char* which = mimic.Attribute("axis");
    read.leader_coordinate = which && std::string_view(which) == "axis2" ? 1 : 0;
    read.multiplier = file_.number_in(mimic, "multiplier", 1);
    read.offset =
        file_.number_in(mimic, "offset", 0) - read.multiplier * file_.number_in(mimic, "reference", 0);
    read_.mimics.push_back(read);
  }

  /// <thread_pitch>: rad/m of a left-handed thread. <screw_thread_pitch>: m per turn of a right-handed one.
  void read_pitch() {
    if (file_.child(element_, "screw_thread_pitch")) {
      joint().pitch = file_.number_in(element_, "screw_thread_pitch", 1) / (2 * std::numbers::pi);
      return;
    }
    const double turns = file_.number_in(element_, "thread_pitch", 0);
    if (turns != 0)
      joint().pitch = -1 / turns;
    else
      file_.error(file_.element(element_),
                  fmt::format("joint '{}' needs <screw_thread_pitch>, m per turn", shown(joint().name)));
  }

  /// False after a diagnostic.
  bool read_gearbox() {
    read_.gearbox->ratio = file_.number_in(element_, "gearbox_ratio", 1);
    const std::optional<std::string> body = file_.text_in(element_, "gearbox_reference_body");
    if (!body) {
      file_.error(file_.element(element_),
                  fmt::format("joint '{}' needs <gearbox_reference_body>", shown(joint().name)));
      return false;
    }
    const SourceRange where = file_.element(*element_.FirstChildElement("gearbox_reference_body"));
    const auto whole =
        frames_.find(scope_, *body, where, fmt::format("joint '{}' names", shown(joint().name)));
    if (whole) read_.gearbox->reference = frames_.link(*whole);
    return whole.has_value();
  }

  SdfFile& file_;
  SdfFrames& frames_;
  const XmlElement& element_;
  const std::string& scope_;
  const ReadOptions& options_;
  SdfJoint read_;
};

}  // namespace

std::optional<SdfJoint> read_sdf_joint(SdfFile& file, SdfFrames& frames, const SdfJointElement& given,
                                       const ReadOptions& options) {
  return JointReader(file, frames, given, options).read();
}

}  // namespace jourdain::model
