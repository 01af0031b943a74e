#include "kinematics/link_states.hpp"

#include <fmt/format.h>

namespace jourdain::kinematics {

namespace {

using model::Expression;

std::vector<Ex> declare(LeafKind kind, const char* name, std::size_t count, Statements& statements) {
  std::vector<Ex> symbols;
  for (std::size_t i = 0; i < count; ++i)
    symbols.push_back(statements.leaf(kind, i, fmt::format("{}{}", name, i)));
  return symbols;
}

}  // namespace

Leaves::Leaves(const model::Mechanism& mechanism, const model::CoordinateLayout& layout,
               Statements& statements) {
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i)
    parameters.push_back(statements.leaf(LeafKind::kParameter, i, mechanism.parameters[i].name));
  y = declare(LeafKind::kPosition, "y", layout.position_count(), statements);
  z = declare(LeafKind::kVelocity, "z", layout.velocity_count(), statements);
  first_state = layout.first_state();
  zdot = declare(LeafKind::kAcceleration, "zdot", layout.velocity_count(), statements);
  std::size_t rows = 0;
  for (const model::Loop& loop : mechanism.loops) rows += model::row_count(loop.type);
  lambda = declare(LeafKind::kMultiplier, "lambda", rows, statements);
  u = declare(LeafKind::kInput, "u", layout.input_count(), statements);
  t = statements.leaf(LeafKind::kTime, 0, "t");
  h = statements.leaf(LeafKind::kStepLength, 0, "h");
}

std::size_t LinkState::column_count(const Link& link) const {
  if (!entry) return 0;
  return link.kind == LinkKind::kFree ? 6 : link.kind == LinkKind::kBall ? 3 : 1;
}

namespace {

/// Prescribed motions as they move on: states by their rates, inputs not at all.
class Motions {
 public:
  Motions(const model::Mechanism& mechanism, const Leaves& leaves, Statements& statements)
      : mechanism_(mechanism), leaves_(leaves), statements_(statements) {}

  Taylor of(const Expression& motion) const {
    return differentiated(motion, [this](std::size_t state) {
      const Taylor rate = velocity(mechanism_.states[state].rate);
      return Taylor{value({Variable::Kind::kState, state}), rate.value, rate.first};
    });
  }

 private:
  using Variable = model::Variable;

  Ex value(const Variable& variable) const {
    switch (variable.kind) {
      case Variable::Kind::kTime:
        return leaves_.t;
      case Variable::Kind::kInput:
        return leaves_.u[variable.index];
      case Variable::Kind::kState:
        return leaves_.z[leaves_.first_state + variable.index];
      default:
        throw support::InternalError("a motion follows what moves");
    }
  }

  template <class OfState>
  Taylor differentiated(const Expression& expression, const OfState& of_state) const {
    return kinematics::differentiated(expression, leaves_.parameters, statements_, [&](const Variable& v) {
      if (v.kind == Variable::Kind::kState) return of_state(v.index);
      return Taylor{value(v), v.kind == Variable::Kind::kTime ? 1 : 0, 0};
    });
  }

  /// A rate and its first derivative; the second is not known.
  Taylor velocity(const Expression& rate) const {
    return differentiated(rate, [this](std::size_t state) {
      const Ex moving = to_symbolic(mechanism_.states[state].rate, leaves_.parameters, statements_,
                                    [this](const Variable& v) { return value(v); });
      return Taylor{value({Variable::Kind::kState, state}), moving, 0};
    });
  }

  const model::Mechanism& mechanism_;
  const Leaves& leaves_;
  Statements& statements_;
};

void set_scalar(LinkState& state, const Link& link, const model::JointEntries& entries,
                const model::Coordinate& coordinate, const Leaves& leaves, const Motions& motions) {
  if (coordinate.motion) {
    const Taylor motion = motions.of(*coordinate.motion);
    state.position = link.sign * motion.value;
    state.rate = link.sign * motion.first;
    state.acceleration = link.sign * motion.second;
    return;
  }
  state.entry = entries.velocity[link.coordinate];
  state.position = link.sign * leaves.y[*entries.position[link.coordinate]];
  state.rate = link.sign * leaves.z[*state.entry];
}

void set_curve(LinkState& state, const model::Joint& joint, const Leaves& leaves, Statements& statements) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Taylor component = differentiated(joint.curve[k], state.position, leaves.parameters, statements);
    state.place[k] = component.value;
    state.slope[k] = component.first;
    state.curvature[k] = component.second;
  }
}

void set_rotation(LinkState& state, const Link& link, const model::JointEntries& entries,
                  const Leaves& leaves) {
  const bool free = link.kind == LinkKind::kFree;
  const std::size_t y = entries.first_position + (free ? 3 : 0), z = entries.first_velocity + (free ? 3 : 0);
  state.entry = entries.first_velocity;
  for (std::size_t k = 0; k < 4; ++k) state.quaternion[k] = leaves.y[y + k];
  for (std::size_t k = 0; k < 3; ++k) state.spin[k] = leaves.z[z + k];
  if (!free) return;
  for (std::size_t k = 0; k < 3; ++k) {
    state.origin[k] = leaves.y[entries.first_position + k];
    state.velocity[k] = leaves.z[entries.first_velocity + k];
  }
}

}  // namespace

std::vector<LinkState> derive_link_states(const model::Mechanism& mechanism,
                                          const model::CoordinateLayout& layout, const LinkTree& tree,
                                          const Leaves& leaves, Statements& statements) {
  std::vector<LinkState> states;
  const Motions motions(mechanism, leaves, statements);
  for (const Link& link : tree.links) {
    const model::Joint& joint = mechanism.joints[link.joint.value];
    const model::JointEntries& entries = layout.joints[link.joint.value];
    LinkState& state = states.emplace_back();
    if (link.has_quaternion())
      set_rotation(state, link, entries, leaves);
    else
      set_scalar(state, link, entries, joint.coordinates[link.coordinate], leaves, motions);
    if (link.kind == LinkKind::kCurve) set_curve(state, joint, leaves, statements);
  }
  return states;
}

Taylor coordinate_motion(const Link& link, const LinkState& state) {
  return {link.sign * state.position, link.sign * state.rate, link.sign * state.acceleration};
}

}  // namespace jourdain::kinematics
