// The Simulation Description Format, 1.4 to 1.11 (sdformat.org). Read are links with their inertials, joints, frames
// and nested models with their poses; geometry, sensors, plugins and what simulators add are not. A joint that moves
// by one coordinate gets an actuator of the same name.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <string_view>

#include "model/read/read.hpp"
#include "model/read/sdf_file.hpp"
#include "model/read/sdf_frames.hpp"
#include "model/read/sdf_joint.hpp"
#include "model/read/sdf_tree.hpp"
#include "model/read/xml_text.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

class SdfReader {
 public:
  SdfReader(SdfFile& file, const ReadOptions& options) : file_(file), options_(options), frames_(file) {}

  Mechanism read(const XmlElement& root) {
    mechanism_.gravity = {0.0, 0.0, -9.81};
    const XmlElement* world = file_.child(root, "world");
    const XmlElement* model = file_.child(root, "model");
    file_.check_elements(root, {"world", "model", "light", "actor"});
    if (world && model)
      file_.error(file_.element(*model), "the file has a <world> and a <model>", "one of them is read");
    else if (world)
      read_world(*world);
    else if (model)
      read_only_model(*model);
    else
      file_.error(file_.element(root), "the file has no <model>");
    if (!world == !model) file_.complete().structure = false;
    frames_.settle();
    if (file_.complete().structure) read_joints();
    if (plugins_ > 0)
      file_.diagnostics().note(
          first_plugin_, fmt::format("{} <plugin>{} left out", plugins_, plugins_ == 1 ? " is" : "s are"));
    file_.note_snapped();
    return std::move(mechanism_);
  }

 private:
  void name_mechanism(const XmlElement& element) {
    mechanism_.name = file_.name(element).value_or("");
    mechanism_.where = file_.element(element);
  }

  void read_only_model(const XmlElement& model) {
    name_mechanism(model);
    read_model(model, "", "", "", false);
  }

  /// Names within models of a world begin with that of the model.
  void read_world(const XmlElement& world) {
    name_mechanism(world);
    file_.check_elements(world, {"gravity",
                                 "model",
                                 "include",
                                 "joint",
                                 "frame",
                                 "light",
                                 "physics",
                                 "scene",
                                 "gui",
                                 "plugin",
                                 "state",
                                 "actor",
                                 "magnetic_field",
                                 "atmosphere",
                                 "wind",
                                 "spherical_coordinates",
                                 "population",
                                 "road",
                                 "audio",
                                 "name"});
    mechanism_.gravity = {0.0, 0.0, -9.8};  // what the format says
    read_gravity(world);
    for (const auto* e = world.FirstChildElement("model"); e; e = e->NextSiblingElement("model"))
      if (const std::optional<std::string> name = file_.name(*e)) read_model(*e, "", "", *name + "::", false);
    read_frames_and_joints(world, "", false);
    report_left_out(world);
    if (const XmlElement* state = world.FirstChildElement("state"))
      file_.diagnostics().warning(file_.element(*state), "the <state> of the <world> is ignored",
                                  "motions start where the models' poses put them");
  }

  /// The profile that is taken: the one that says so, else the first.
  static const XmlElement* default_physics(const XmlElement& world) {
    for (const auto* e = world.FirstChildElement("physics"); e; e = e->NextSiblingElement("physics"))
      if (const char* chosen = e->Attribute("default");
          chosen && (std::string_view(chosen) == "true" || std::string_view(chosen) == "1"))
        return e;
    return world.FirstChildElement("physics");
  }

  /// Up to SDF 1.5 it stands in <physics> (sdformat's sdf/1.5/physics.sdf), later in the <world> (sdf/1.6/world.sdf).
  void read_gravity(const XmlElement& world) {
    const XmlElement* gravity = file_.child(world, "gravity");
    const XmlElement* physics = file_.version <= 5 && !gravity ? default_physics(world) : nullptr;
    for (const auto* e = world.FirstChildElement("physics"); e; e = e->NextSiblingElement("physics")) {
      const XmlElement* within = file_.child(*e, "gravity");
      if (within && e == physics)
        gravity = within;
      else if (within)
        file_.diagnostics().warning(
            file_.element(*within), "this <gravity> of <physics> is ignored",
            file_.version <= 5 ? "another one is taken" : "from SDF 1.6 on it stands in the <world>");
    }
    if (!gravity) return;
    const auto g = file_.triple_of(*gravity, {0, 0, -9.8});
    mechanism_.gravity = {g[0], g[1], g[2]};
  }

  /// `scope` is that of the names in the model, `outer` that of its own, `base` the frame around it.
  void read_model(const XmlElement& model, const std::string& outer, const std::string& base,
                  const std::string& scope, bool in_static) {
    file_.check_elements(model, {"static", "pose", "link", "joint", "frame", "model", "include", "plugin",
                                 "gripper", "self_collide", "allow_auto_disable", "enable_wind"});
    if (file_.flag_in(model, "enable_wind", false))
      file_.diagnostics().warning(file_.element(*model.FirstChildElement("enable_wind")),
                                  "<enable_wind> of a <model> is ignored: no wind blows");
    const char* placed = model.Attribute("placement_frame");
    const bool is_static = file_.flag_in(model, "static", false) || in_static;
    SourceRange where = file_.element(model);
    const std::string frame = scope + "__model__";
    frames_.add(frame, {.scope = outer,
                        .base_name = file_.pose_base(model),
                        .placed_name = placed ? placed : "",
                        .placed_where = placed ? file_.value(model, "placement_frame") : where,
                        .base = base,
                        .pose = file_.pose_in(model, where),
                        .attached = canonical_link(model, scope),
                        .where = where});
    if (!scope.empty())
      frames_.add(scope.substr(0, scope.size() - 2),
                  {.scope = "", .base = frame, .attached = frame, .where = where});
    for (const auto* e = model.FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
      read_link(*e, scope, is_static);
    for (const auto* e = model.FirstChildElement("model"); e; e = e->NextSiblingElement("model"))
      if (const std::optional<std::string> name = file_.name(*e))
        read_model(*e, scope, frame, scope + *name + "::", is_static);
    read_frames_and_joints(model, scope, true);
    report_left_out(model);
  }

  static const XmlElement* named(const XmlElement& model, const char* kind, std::string_view name) {
    for (const auto* e = model.FirstChildElement(kind); e; e = e->NextSiblingElement(kind))
      if (e->Attribute("name") && e->Attribute("name") == name) return e;
    return nullptr;
  }

  /// "link", or "model::link" of a model inside.
  static bool has_link(const XmlElement& model, std::string_view name) {
    const std::size_t colons = name.find("::");
    if (colons == std::string_view::npos) return named(model, "link", name);
    const XmlElement* inner = named(model, "model", name.substr(0, colons));
    return inner && has_link(*inner, name.substr(colons + 2));
  }

  /// What the frame of a model is attached to: the link that it names, else its first one; of its first model where it
  /// has none, as the format has it.
  std::string canonical_link(const XmlElement& model, const std::string& scope) {
    if (const char* given = model.Attribute("canonical_link"); given && *given) {
      if (has_link(model, given)) return scope + given;
      file_.error(
          file_.value(model, "canonical_link"),
          fmt::format("the model has no link '{}' that its frame could be attached to", shown(given)));
    }
    const XmlElement* link = model.FirstChildElement("link");
    if (link) return scope + (link->Attribute("name") ? link->Attribute("name") : "");
    const XmlElement* inner = model.FirstChildElement("model");
    const char* name = inner ? inner->Attribute("name") : nullptr;
    return name ? canonical_link(*inner, scope + name + "::") : "";
  }

  void report_left_out(const XmlElement& parent) {
    for (const auto* e = parent.FirstChildElement("include"); e; e = e->NextSiblingElement("include"))
      file_.diagnostics().warning(file_.element(*e), "<include> is left out",
                                  "one file is read: put the model in its place");
    for (const auto* e = parent.FirstChildElement("plugin"); e; e = e->NextSiblingElement("plugin"))
      if (plugins_++ == 0) first_plugin_ = file_.element(*e);
  }

  void read_frames_and_joints(const XmlElement& parent, const std::string& scope, bool in_model) {
    const std::string base = in_model ? scope + "__model__" : "";
    for (const auto* e = parent.FirstChildElement("frame"); e; e = e->NextSiblingElement("frame"))
      read_frame(*e, scope, base);
    for (const auto* e = parent.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
      declare_joint(*e, scope);
  }

  void read_frame(const XmlElement& element, const std::string& scope, const std::string& base) {
    const std::optional<std::string> name = file_.name(element);
    if (!name) return;
    file_.check_elements(element, {"pose"});
    SourceRange where = file_.value(element, "name");
    const char* attached = element.Attribute("attached_to");
    const std::string attached_name = attached ? attached : "";
    const std::string pose_base = file_.pose_base(element);
    SourceRange pose_where = where;
    frames_.add(scope + *name, {.scope = scope,
                                .base_name = pose_base.empty() ? attached_name : pose_base,
                                .attached_name = attached_name,
                                .base = base,
                                .pose = file_.pose_in(element, pose_where),
                                .attached = base,
                                .where = where});
    named_frames_.push_back({.name = scope + *name, .where = where, .pose_where = pose_where});
  }

  void declare_joint(const XmlElement& element, const std::string& scope) {
    const std::optional<std::string> name = file_.name(element);
    const std::optional<std::string> child = file_.text_in(element, "child");
    if (!name) return;
    SourceRange where = file_.value(element, "name"), pose_where;
    const std::string pose_base = file_.pose_base(element);
    const bool is_new =
        frames_.add(scope + *name, {.scope = scope,
                                    .base_name = pose_base.empty() ? child.value_or("") : pose_base,
                                    .attached_name = child.value_or(""),
                                    .pose = file_.pose_in(element, pose_where),
                                    .where = where});
    if (is_new) joint_elements_.push_back({&element, scope});
    if (joint_elements_.size() == kMaximumBodies + 1)
      file_.error(where, fmt::format("more than {} joints", kMaximumBodies));
    if (joint_elements_.size() > kMaximumBodies) file_.complete().structure = false;
  }

  void read_link(const XmlElement& element, const std::string& scope, bool is_static) {
    const std::optional<std::string> name = file_.name(element);
    file_.check_elements(
        element, {"pose", "inertial", "visual", "collision", "sensor", "light", "projector", "audio_sink",
                  "audio_source", "battery", "particle_emitter", "self_collide", "enable_wind",
                  "must_be_base_link", "gravity", "kinematic", "velocity_decay", "plugin"});
    if (!name) {
      file_.complete().structure = false;
      return;
    }
    SdfLink link;
    link.body.name = scope + *name;
    link.body.where = file_.value(element, "name");
    link.is_static = is_static;
    warn_of_simulation(element, link.body.name);
    frames_.add(link.body.name, {.scope = scope,
                                 .base_name = file_.pose_base(element),
                                 .base = scope + "__model__",
                                 .pose = file_.pose_in(element, link.pose_where),
                                 .link = BodyIndex(links_.size()),
                                 .where = link.body.where});
    read_inertial(element, link);
    links_.push_back(std::move(link));
    if (links_.size() == kMaximumBodies + 1)
      file_.error(links_.back().body.where, fmt::format("more than {} links", kMaximumBodies));
    if (links_.size() > kMaximumBodies) file_.complete().structure = false;
  }

  void warn_of_simulation(const XmlElement& element, const std::string& name) {
    const auto warn = [&](const char* key, const char* what) {
      file_.diagnostics().warning(file_.element(*element.FirstChildElement(key)),
                                  fmt::format("<{}> of link '{}' is ignored: {}", key, shown(name), what));
    };
    if (!file_.flag_in(element, "gravity", true)) warn("gravity", "gravity acts on all links");
    if (file_.flag_in(element, "kinematic", false)) warn("kinematic", "forces move all links");
    if (element.FirstChildElement("velocity_decay")) warn("velocity_decay", "nothing slows links down");
    if (file_.flag_in(element, "enable_wind", false)) warn("enable_wind", "no wind blows");
  }

  /// A mass of 1 kg and moments of 1 kg m² where it does not say, as the format has it.
  void read_inertial(const XmlElement& element, SdfLink& link) {
    Body& body = link.body;
    body.mass = 1.0;
    body.inertia = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
    const XmlElement* inertial = file_.child(element, "inertial");
    const XmlElement* inertia = inertial ? file_.child(*inertial, "inertia") : nullptr;
    const bool is_said = inertial && inertia && file_.child(*inertial, "mass");
    if (!is_said && !link.is_static)
      file_.diagnostics().warning(
          inertial ? file_.element(*inertial) : body.where,
          fmt::format("link '{}' does not give all of its inertia: 1 kg and 1 kg m² where it does not",
                      shown(body.name)));
    if (!inertial) return;
    file_.check_elements(*inertial, {"pose", "mass", "inertia", "density"});
    if (file_.truth_of(*inertial, "auto", false))
      file_.error(file_.value(*inertial, "auto"), "an inertia that follows from geometry is not read",
                  "write <mass> and <inertia>");
    link.inertial = file_.pose_in(*inertial, link.inertial_where);
    if (!file_.pose_base(*inertial).empty())
      file_.diagnostics().warning(link.inertial_where, "the frame of the <pose> of an <inertial> is ignored",
                                  "it is given in that of the link");
    if (const XmlElement* mass = file_.child(*inertial, "mass")) {
      body.mass = file_.number_in(*inertial, "mass", 1);
      body.mass_where = file_.element(*mass);
    }
    if (!inertia) return;
    body.inertia_where = file_.element(*inertia);
    const auto entry = [&](const char* name, double otherwise) {
      return Expression(file_.number_in(*inertia, name, otherwise));
    };
    body.inertia = {entry("ixx", 1), entry("iyy", 1), entry("izz", 1),
                    entry("ixy", 0), entry("ixz", 0), entry("iyz", 0)};
  }

  void read_joints() {
    std::vector<SdfJoint> joints;
    bool complete = true;
    for (SdfLink& link : links_) link.pose = frames_.pose(link.body.name);
    for (const SdfJointElement& element : joint_elements_)
      if (std::optional<SdfJoint> joint = read_sdf_joint(file_, frames_, element, options_))
        joints.push_back(std::move(*joint));
      else
        complete = false;
    file_.complete().structure = file_.complete().structure && complete;
    if (!file_.complete().structure) return;
    for (SdfNamedFrame& frame : named_frames_) {
      frame.body = frames_.link(frame.name);
      frame.pose = frames_.pose(frame.name);
    }
    if (file_.complete().structure) assemble(file_, {links_, joints, named_frames_}, options_, mechanism_);
  }

  SdfFile& file_;
  const ReadOptions& options_;
  SdfFrames frames_;
  Mechanism mechanism_;
  std::vector<SdfLink> links_;
  std::vector<SdfJointElement> joint_elements_;
  std::vector<SdfNamedFrame> named_frames_;
  std::size_t plugins_ = 0;
  SourceRange first_plugin_;
};

/// The y of version="1.y"; nothing after a diagnostic.
std::optional<int> version_of(SdfFile& file, const XmlElement& root) {
  constexpr int kOldest = 4, kNewest = 11;
  const std::optional<std::string> text = file.required(root, "version");
  if (!text) return {};
  int minor = 0;
  const char* const end = text->data() + text->size();
  const bool is_one = text->starts_with("1.");
  const auto [stop, failure] = std::from_chars(text->data() + (is_one ? 2 : 0), end, minor);
  const bool is_version = is_one && failure == std::errc() && stop == end;
  const SourceRange where = file.value(root, "version");
  if (!is_version || minor < kOldest) {
    file.error(where, fmt::format("SDF {} is not read", shown(*text)),
               fmt::format("known are 1.{} to 1.{}", kOldest, kNewest));
    return {};
  }
  if (minor > kNewest)
    file.diagnostics().warning(where, fmt::format("SDF {} is read as 1.{}", shown(*text), kNewest));
  return minor;
}

}  // namespace

std::optional<Part> read_sdf(Diagnostics& diagnostics, const ReadOptions& options) {
  const std::unique_ptr<XmlText> xml = parse_xml(diagnostics);
  const XmlElement* root = xml ? root_element(*xml, "sdf", "an SDF file", diagnostics) : nullptr;
  if (!root) return {};
  SdfFile file(diagnostics, xml->starts, xml->document, options.snap);
  const std::optional<int> version = version_of(file, *root);
  if (!version) return {};
  file.version = *version;
  Mechanism mechanism = SdfReader(file, options).read(*root);
  return Part{std::move(mechanism), file.complete(), support::Severity::kWarning};
}

}  // namespace jourdain::model
