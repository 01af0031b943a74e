#include "model/coupler.hpp"

#include <array>
#include <utility>
#include <vector>

namespace jourdain::model {

Loop coupler(std::string name, std::span<const CouplerTerm> terms, const Expression& offset,
             SourceRange where) {
  Loop loop;
  loop.name = std::move(name);
  loop.type = LoopType::kResidual;
  loop.where = where;
  for (const CouplerTerm& term : terms) {
    const Variable position{Variable::Kind::kPosition, term.joint.value, term.coordinate};
    loop.residual = Expression::binary(
        Expression::Op::kAdd, loop.residual,
        Expression::binary(Expression::Op::kMultiply, term.factor, Expression::variable(position)));
  }
  loop.residual = Expression::binary(Expression::Op::kSubtract, loop.residual, offset);
  return loop;
}

Loop coupler(std::string name, const Follower& follower, SourceRange where) {
  const auto& [coordinate, leader, ratio, offset] = follower;
  const Expression back = Expression::unary(Expression::Op::kNegate, ratio);
  const std::array<CouplerTerm, 2> terms{
      {{coordinate.joint, coordinate.coordinate, 1.0}, {leader.joint, leader.coordinate, back}}};
  Loop loop = coupler(std::move(name), terms, offset, where);
  loop.follower = coordinate;
  return loop;
}

namespace {

bool is_follower(const Loop& loop, const Variable& v) {
  return v.index == loop.follower->joint.value && v.component == loop.follower->coordinate;
}

/// What the follower has where the leader's value is `value`.
Expression followed(const Loop& loop, const Expression& value) {
  return Expression::unary(Expression::Op::kNegate, loop.residual.substituted([&](const Variable& v) {
    return is_follower(loop, v) ? Expression(0.0) : value;
  }));
}

/// The coordinate that is followed; the follower itself where the ratio is zero.
ScalarCoordinate leader_of(const Loop& loop) {
  for (const Expression::Node& node : loop.residual.nodes())
    if (node.op == Expression::Op::kVariable && !is_follower(loop, node.variable))
      return {JointIndex(node.variable.index), node.variable.component};
  return *loop.follower;
}

/// After what it follows.
void start(Mechanism& mechanism, std::size_t index, std::vector<bool>& is_started) {
  const Loop& loop = mechanism.loops[index];
  if (!loop.follower || is_started[index]) return;
  is_started[index] = true;
  const auto [joint, coordinate] = leader_of(loop);
  for (std::size_t k = 0; k < mechanism.loops.size(); ++k)
    if (const auto& other = mechanism.loops[k].follower;
        other && other->joint == joint && other->coordinate == coordinate)
      start(mechanism, k, is_started);
  const Coordinate& first = mechanism.joints[joint.value].coordinates[coordinate];
  Coordinate& second = mechanism.joints[loop.follower->joint.value].coordinates[loop.follower->coordinate];
  if (first.motion || second.motion) return;
  if (second.position_where.line == 0) second.initial_position = followed(loop, first.initial_position);
  if (second.velocity_where.line == 0)
    second.initial_velocity = Expression::binary(Expression::Op::kSubtract,
                                                 followed(loop, first.initial_velocity), followed(loop, 0.0));
}

}  // namespace

void start_followers(Mechanism& mechanism) {
  std::vector<bool> is_started(mechanism.loops.size(), false);
  for (std::size_t k = 0; k < mechanism.loops.size(); ++k) start(mechanism, k, is_started);
}

}  // namespace jourdain::model
