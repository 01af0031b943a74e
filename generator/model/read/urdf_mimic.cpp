#include "model/read/urdf_mimic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "model/coupler.hpp"
#include "model/joint_kinds.hpp"
#include "model/read/lock.hpp"

namespace jourdain::model {

namespace {

using support::shown;

class MimicReader {
 public:
  MimicReader(UrdfFile& file, Mechanism& mechanism)
      : file_(file), mechanism_(mechanism), follows_(mechanism.joints.size()) {}

  void read(const std::vector<UrdfMimic>& mimics) {
    for (const UrdfMimic& mimic : mimics)
      if (const auto relation = relation_of(mimic)) follows_[mimic.joint.value] = relation;
    for (const UrdfMimic& mimic : mimics) refuse_cycle(mimic);
    if (file_.diagnostics().has_errors()) return;
    for (const UrdfMimic& mimic : mimics)
      if (follows_[mimic.joint.value]) couple(mimic);
    start_followers(mechanism_);
  }

 private:
  struct Relation {
    std::size_t leader = 0;
    double multiplier = 1, offset = 0;
  };

  const std::string& name(std::size_t joint) const { return mechanism_.joints[joint].name; }

  void error(SourceRange where, std::string message, std::string hint = "") {
    file_.diagnostics().error(where, std::move(message), std::move(hint));
  }

  std::optional<Relation> relation_of(const UrdfMimic& mimic) {
    const XmlElement& element = *mimic.element;
    const std::optional<std::string> followed = file_.required(element, "joint");
    Relation relation{0, file_.number(element, "multiplier", 1), file_.number(element, "offset", 0)};
    const Joint& joint = mechanism_.joints[mimic.joint.value];
    if (joint.coordinates.size() != 1)
      error(file_.element(element), fmt::format("joint '{}' is {} and cannot follow another one",
                                                shown(joint.name), joint_kind(joint).name));
    if (!followed) return {};
    const auto leader = find(*followed, element, joint);
    if (!leader || joint.coordinates.size() != 1) return {};
    relation.leader = *leader;
    return relation;
  }

  std::optional<std::size_t> find(const std::string& followed, const XmlElement& element,
                                  const Joint& follower) {
    const SourceRange where = file_.value(element, "joint");
    std::vector<std::string> names;
    for (const Joint& joint : mechanism_.joints) names.push_back(joint.name);
    const auto found = std::find(names.begin(), names.end(), followed);
    if (found == names.end()) {
      const std::string close = support::nearest(followed, names);
      file_.diagnostics().warning(where,
                                  fmt::format("joint '{}' mimics unknown joint '{}' and moves freely",
                                              shown(follower.name), shown(followed)),
                                  close.empty() ? fmt::format("--lock {} fixes it", shown(follower.name))
                                                : fmt::format("did you mean '{}'?", shown(close)));
      return {};
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    const Joint& leader = mechanism_.joints[index];
    if (leader.coordinates.size() == 1 || leader.type == JointType::kFixed) return index;
    error(where,
          fmt::format("joint '{}' mimics '{}', which is {}", shown(follower.name), shown(followed),
                      joint_kind(leader).name),
          "only a joint with one coordinate can be followed");
    return {};
  }

  /// Said at one joint of the cycle.
  void refuse_cycle(const UrdfMimic& mimic) {
    const std::size_t start = mimic.joint.value;
    std::string way;
    std::size_t at = start;
    for (std::size_t steps = 0; steps <= follows_.size(); ++steps) {
      if (!follows_[at] || at < start) return;
      at = follows_[at]->leader;
      if (at == start) break;
      way += fmt::format("{}'{}'", way.empty() ? " by way of " : ", ", shown(name(at)));
    }
    if (at == start)
      error(file_.value(*mimic.element, "joint"),
            fmt::format("joint '{}' mimics itself{}", shown(name(start)), way));
  }

  void couple(const UrdfMimic& mimic) {
    const Relation& relation = *follows_[mimic.joint.value];
    const bool is_fixed = mechanism_.joints[relation.leader].type == JointType::kFixed;
    const SourceRange where = file_.element(*mimic.element);
    if (is_fixed && relation.offset == 0) {
      file_.diagnostics().note(where,
                               fmt::format("joint '{}' is locked: it follows '{}', which is fixed",
                                           shown(name(mimic.joint.value)), shown(name(relation.leader))));
      return lock(mechanism_, mimic.joint);
    }
    std::erase_if(mechanism_.actuators,
                  [&](const Actuator& actuator) { return actuator.joint == mimic.joint; });
    mechanism_.loops.push_back(coupler(name(mimic.joint.value),
                                       {.coordinate = {mimic.joint, 0},
                                        .leader = {JointIndex(relation.leader), 0},
                                        .ratio = is_fixed ? 0.0 : relation.multiplier,
                                        .offset = relation.offset},
                                       where));
  }

  UrdfFile& file_;
  Mechanism& mechanism_;
  std::vector<std::optional<Relation>> follows_;  ///< by joint
};

}  // namespace

void read_mimics(UrdfFile& file, const std::vector<UrdfMimic>& mimics, Mechanism& mechanism) {
  MimicReader(file, mechanism).read(mimics);
}

}  // namespace jourdain::model
