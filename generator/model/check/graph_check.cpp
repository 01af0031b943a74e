// Do the joints make a tree that is rooted in the world?
#include <fmt/format.h>

#include <optional>
#include <string>

#include "model/check/checks.hpp"
#include "model/coordinates.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

SourceRange child_range(const Joint& joint) {
  return joint.child_where.line == 0 ? joint.where : joint.child_where;
}

class GraphCheck {
 public:
  GraphCheck(const Mechanism& mechanism, Diagnostics& diagnostics)
      : mechanism_(mechanism), diagnostics_(diagnostics), joint_of_(mechanism.bodies.size()) {}

  bool run() {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j) attach(j);
    for (std::size_t b = 0; b < mechanism_.bodies.size(); ++b)
      if (!joint_of_[b]) report_loose(mechanism_.bodies[b]);
    find_loops();
    return sound_;
  }

 private:
  void attach(std::size_t j) {
    const Joint& joint = mechanism_.joints[j];
    std::optional<std::size_t>& first = joint_of_[joint.child.value];
    const std::string& child = mechanism_.bodies[joint.child.value].name;
    if (joint.parent == joint.child) {
      sound_ = false;
      diagnostics_.error(child_range(joint), fmt::format("joint '{}' joins body '{}' with itself",
                                                         shown(joint.name), shown(child)));
    } else if (first) {
      sound_ = false;
      const Joint& other = mechanism_.joints[*first];
      diagnostics_.error(
          child_range(joint),
          fmt::format("body '{}' is the child of two joints, '{}' and '{}'", shown(child), shown(other.name),
                      shown(joint.name)),
          fmt::format("'{}' is declared{}; the joint that closes a loop is a [[loop]] of a TOML model",
                      shown(other.name),
                      other.where.line == 0
                          ? ""
                          : " at " + diagnostics_.line_in_words(other.where, child_range(joint))));
    }
    if (!first) first = j;
  }

  void report_loose(const Body& body) {
    sound_ = false;
    diagnostics_.error(body.where, fmt::format("body '{}' has no joint", shown(body.name)),
                       "give it a joint whose child it is; its parent may be 'world'");
  }

  /// Follows parents from each body; a body met twice on one way closes a loop.
  void find_loops() {
    std::vector<std::size_t> visit(mechanism_.bodies.size(),
                                   0);  // 0: never, else 1 + the body we started from
    for (std::size_t start = 0; start < visit.size(); ++start) {
      std::optional<std::size_t> body = start;
      while (body && visit[*body] == 0) {
        visit[*body] = start + 1;
        body = parent_of(*body);
      }
      if (body && visit[*body] == start + 1) report_loop(*body);
    }
  }

  std::optional<std::size_t> parent_of(std::size_t body) const {
    if (!joint_of_[body]) return {};
    const auto& parent = mechanism_.joints[*joint_of_[body]].parent;
    return parent ? std::optional(parent->value) : std::nullopt;
  }

  void report_loop(std::size_t start) {
    if (parent_of(start) == start) return;  // reported as a joint of a body with itself
    sound_ = false;
    constexpr int kNamed = 6;
    std::string way = fmt::format("'{}'", shown(mechanism_.bodies[start].name));
    std::size_t body = *parent_of(start);
    for (int named = 1; body != start; body = *parent_of(body), ++named)
      if (named < kNamed)
        way = fmt::format("'{}' -> {}", shown(mechanism_.bodies[body].name), way);
      else if (named == kNamed)
        way = "... -> " + way;
    diagnostics_.error(
        child_range(mechanism_.joints[*joint_of_[start]]),
        fmt::format("the joints form a loop: '{}' -> {}", shown(mechanism_.bodies[start].name), way),
        "one joint must lead to the world; the one that closes a loop is a [[loop]] of a TOML model");
  }

  const Mechanism& mechanism_;
  Diagnostics& diagnostics_;
  std::vector<std::optional<std::size_t>> joint_of_;  ///< the first joint whose child is that body
  bool sound_ = true;
};

void check_states(const Mechanism& mechanism, Diagnostics& diagnostics) {
  if (mechanism.states.empty() || lay_out_coordinates(mechanism).position_count() > 0) return;
  diagnostics.error(mechanism.states.front().where,
                    fmt::format("state '{}' moves beside a mechanism that only time moves",
                                support::shown(mechanism.states.front().name)),
                    "states need a coordinate without 'motion'");
}

}  // namespace

bool check_graph(const Mechanism& mechanism, Diagnostics& diagnostics) {
  if (mechanism.bodies.empty()) {
    diagnostics.error(mechanism.where, "the mechanism has no bodies");
    return false;
  }
  if (!GraphCheck(mechanism, diagnostics).run()) return false;
  if (moving_joints(mechanism).empty())
    diagnostics.error(mechanism.where, "the mechanism has no degree of freedom",
                      diagnostics.path().ends_with(".urdf") || diagnostics.path().ends_with(".sdf") ||
                              diagnostics.path().ends_with(".world")
                          ? "every joint is fixed; --root free lets the root link move"
                          : "every joint is fixed");
  check_states(mechanism, diagnostics);
  return true;
}

}  // namespace jourdain::model
