// Does each loop joint constrain something, and is it known what its force acts on where that is asked for?
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/check/checks.hpp"
#include "model/loop_kinds.hpp"
#include "model/output_kinds.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

class LoopCheck {
 public:
  LoopCheck(const Mechanism& mechanism, Diagnostics& diagnostics)
      : mechanism_(mechanism), diagnostics_(diagnostics), joint_of_(mechanism.bodies.size()) {
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j) joint_of_[mechanism.joints[j].child.value] = j;
  }

  void run() {
    for (const Loop& loop : mechanism_.loops) {
      if (loop_kind(loop).has_ends()) {
        ends(loop);
      } else {
        residual(loop);
        outputs_beside(loop);
      }
    }
  }

 private:
  /// The joints from the body inward to `end`, which carries it.
  std::vector<std::size_t> joints_between(std::optional<BodyIndex> body, std::optional<BodyIndex> end) const {
    std::vector<std::size_t> joints;
    while (body != end) {
      joints.push_back(joint_of_[body->value]);
      body = mechanism_.joints[joints.back()].parent;
    }
    return joints;
  }

  bool is_free(std::size_t j) const {
    const Joint& joint = mechanism_.joints[j];
    if (joint.coordinates.empty()) return joint.type != JointType::kFixed;
    return std::any_of(joint.coordinates.begin(), joint.coordinates.end(),
                       [](const Coordinate& coordinate) { return !coordinate.motion; });
  }

  std::string named(std::optional<BodyIndex> body) const {
    return body ? fmt::format("body '{}'", shown(mechanism_.bodies[body->value].name)) : "the world";
  }

  void ends(const Loop& loop) {
    const std::optional<BodyIndex> from = mechanism_.frames[loop.from.value].body,
                                   to = mechanism_.frames[loop.to.value].body;
    const SourceRange where = loop.to_where.line == 0 ? loop.where : loop.to_where;
    const std::string name = fmt::format("{} joins {} with ", in_words(loop), named(from));
    if (from == to) return diagnostics_.error(where, name + "itself", "its ends must be on two bodies");
    const std::optional<BodyIndex> carrying = carrier(mechanism_, from, to);
    std::vector<std::size_t> joints = joints_between(from, carrying);
    for (const std::size_t j : joints_between(to, carrying)) joints.push_back(j);
    if (std::any_of(joints.begin(), joints.end(), [this](std::size_t j) { return is_free(j); })) return;
    const bool rigid = std::all_of(joints.begin(), joints.end(), [this](std::size_t j) {
      return mechanism_.joints[j].type == JointType::kFixed;
    });
    diagnostics_.error(
        where, name + named(to) + (rigid ? ", which are one rigid body" : ", whose motion is prescribed"),
        rigid ? "no joint between them can move" : "every coordinate between them has a motion");
  }

  void residual(const Loop& loop) {
    const bool of_velocities = loop.type == LoopType::kVelocity;
    if (any_variable(loop.residual, [&](const Variable& v) { return moves(v, of_velocities); })) return;
    diagnostics_.error(
        loop.where,
        of_velocities ? fmt::format("the velocity of {} depends on no rate", in_words(loop))
                      : fmt::format("the residual of {} depends on no coordinate", in_words(loop)),
        of_velocities ? "it is kept at zero by rates that are not prescribed: 'name.rate', 'frame.vx'"
                      : "it is kept at zero by coordinates that are not prescribed");
  }

  /// Whether it is a position, or a velocity, that is not prescribed.
  bool moves(const Variable& variable, bool velocity) const {
    using Kind = Variable::Kind;
    const auto& [kind, index, component] = variable;
    const bool moves = variable.is_rate() || kind == Kind::kPosition || kind == Kind::kFramePosition ||
                       kind == Kind::kFrameDirection;
    if (!moves || variable.is_rate() != velocity) return false;
    if (kind == Kind::kPosition || kind == Kind::kVelocity)
      return !mechanism_.joints[index].coordinates[component].motion;
    const std::vector<std::size_t> joints = joints_between(mechanism_.frames[index].body, std::nullopt);
    return std::any_of(joints.begin(), joints.end(), [this](std::size_t j) { return is_free(j); });
  }

  /// A residual of coordinates pushes these along their joints, between parent and child: joints transmit that like
  /// a spring's force. What transmits the force of one of positions, and to which bodies, is not known; nor is what a
  /// driven coordinate feels of its own residual part of the equations.
  void outputs_beside(const Loop& loop) {
    for (const Output& output : mechanism_.outputs) {
      const OutputKindRow& kind = output_kind(output.kind);
      if (!kind.is_of_joint()) continue;
      const bool unknown = any_variable(loop.residual, [&](const Variable& v) {
        if (v.kind == Variable::Kind::kPosition || v.kind == Variable::Kind::kVelocity)
          return kind.subject == OutputSubject::kCoordinate && v.index == output.joint.value &&
                 v.component == output.coordinate;
        return v.kind != Variable::Kind::kTime;
      });
      if (unknown)
        diagnostics_.error(
            output.where,
            fmt::format("output '{}' is a {} in a mechanism with the {} '{}'", shown(output.name), kind.name,
                        loop.type == LoopType::kVelocity ? "velocity constraint" : "residual",
                        shown(loop.name)),
            kind.subject == OutputSubject::kJoint
                ? "an expression does not say on which bodies its force acts: a loop or a "
                  "constraint of two frames does"
                : "what drives its own coordinate is not known");
    }
  }

  const Mechanism& mechanism_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> joint_of_;  ///< whose child is that body
};

}  // namespace

void check_loops(const Mechanism& mechanism, Diagnostics& diagnostics) {
  LoopCheck(mechanism, diagnostics).run();
}

}  // namespace jourdain::model
