#include "dynamics/closure_motion.hpp"

#include <map>
#include <optional>

namespace jourdain::dynamics {

using kinematics::LeafKind;

namespace {

struct Quaternion {
  ScaledReal q[4];

  /// ½ q ⊗ (0, ω)
  Quaternion turned(const ScaledReal (&omega)[3]) const {
    ScaledReal half[3];
    for (std::size_t k = 0; k < 3; ++k) half[k] = omega[k] / 2;
    Quaternion rate;
    rate.q[0] = -(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      rate.q[1 + k] = q[0] * half[k] + q[1 + l] * half[m] - q[1 + m] * half[l];
    }
    return rate;
  }
};

/// y moving on with constant velocities `z`.
std::vector<MovingReal> moving_positions(const model::Tangent& tangent, const std::vector<ScaledReal>& z,
                                         const LeafValue& leaf) {
  std::vector<MovingReal> y;
  const auto set = [&y](std::size_t i, const MovingReal& value) {
    if (y.size() <= i) y.resize(i + 1);
    y[i] = value;
  };
  for (const model::Tangent::Scalar& s : tangent.scalars)
    set(s.position, {leaf(LeafKind::kPosition, s.position), z[s.velocity]});
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    Quaternion q;
    for (std::size_t k = 0; k < 4; ++k) q.q[k] = leaf(LeafKind::kPosition, s.position + k);
    const ScaledReal omega[3] = {z[s.velocity], z[s.velocity + 1], z[s.velocity + 2]};
    const Quaternion rate = q.turned(omega), acceleration = rate.turned(omega);
    for (std::size_t k = 0; k < 4; ++k) set(s.position + k, {q.q[k], rate.q[k], acceleration.q[k]});
  }
  return y;
}

/// y with its derivatives by small displacements of each velocity.
std::vector<GradientReal> displaced_positions(const model::Tangent& tangent, const LeafValue& leaf) {
  std::vector<GradientReal> y;
  const auto at = [&](std::size_t i) -> GradientReal& {
    if (y.size() <= i) y.resize(i + 1);
    return y[i];
  };
  for (const model::Tangent::Scalar& s : tangent.scalars)
    at(s.position) = {leaf(LeafKind::kPosition, s.position), {{s.velocity, 1}}};
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    Quaternion q;
    for (std::size_t k = 0; k < 4; ++k) {
      q.q[k] = leaf(LeafKind::kPosition, s.position + k);
      at(s.position + k).value = q.q[k];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ScaledReal omega[3];
      omega[axis] = 1;
      const Quaternion rate = q.turned(omega);
      for (std::size_t k = 0; k < 4; ++k) at(s.position + k).slopes.push_back({s.velocity + axis, rate.q[k]});
    }
  }
  return y;
}

/// `points`, at rest; as found where there are none.
template <class Number>
typename Evaluation<Number>::HeldValue held_at(const HeldPoints& points) {
  if (points.empty()) return {};
  return [&points](std::size_t i, const Number&) -> Number { return {points.at(i)}; };
}

/// Calls `use` with the number of each row that binds velocities alone, and what it keeps at zero.
template <class Use>
void for_each_velocity(const Equations& closures, const Use& use) {
  std::size_t first = 0;
  for (const LoopClosure& loop : closures.closures) {
    for (const auto& [row, velocity] : loop.velocities) use(first + row, velocity);
    first += loop.rows.size();
  }
}

/// States that motions follow as they move on, by their entry in z; inputs stand still.
std::map<std::size_t, MovingReal> leading_states(const Equations& closures, const LeafValue& leaf) {
  std::map<std::size_t, MovingReal> states;
  if (closures.leading.empty()) return states;
  const HighPrecision now(closures.statements, leaf);
  for (const LeadingState& state : closures.leading)
    states[state.entry] = {leaf(LeafKind::kVelocity, state.entry), now.value(state.rate)};
  const MovingPrecision soon(closures.statements, [&](LeafKind kind, std::size_t i) -> MovingReal {
    if (kind == LeafKind::kTime) return {leaf(kind, i), 1};
    const auto state = states.find(i);
    return kind == LeafKind::kVelocity && state != states.end() ? state->second : MovingReal{leaf(kind, i)};
  });
  for (const LeadingState& state : closures.leading)
    states[state.entry].second = soon.value(state.rate).first;
  return states;
}

template <class Number>
std::vector<Number> rows_of(const Equations& closures, const Evaluation<Number>& at) {
  std::vector<Number> rows;
  for (const LoopClosure& loop : closures.closures)
    for (const Ex& row : loop.rows) rows.push_back(at.value(row));
  return rows;
}

/// G and g_t of rows that bind velocities alone: their value at rest, and how it changes with z.
void add_velocity_rows(const Equations& closures, std::size_t displacements, const LeafValue& leaf,
                       const HeldPoints& points, ClosureJacobian& jacobian) {
  const GradientPrecision::LeafValue by_velocity = [&](LeafKind kind, std::size_t i) -> GradientReal {
    if (kind == LeafKind::kVelocity && i < displacements) return {0, {{i, 1}}};
    return {leaf(kind, i)};
  };
  std::optional<GradientPrecision> at;
  for_each_velocity(closures, [&](std::size_t row, const Ex& velocity) {
    if (!at) at.emplace(closures.statements, by_velocity, held_at<GradientReal>(points));
    const GradientReal value = at->value(velocity);
    jacobian.g_t[row] = value.value;
    for (const GradientReal::Slope& slope : value.slopes) jacobian.G[row][slope.variable] = slope.by;
  });
}

}  // namespace

ClosureJacobian closure_jacobian(const Equations& closures, const model::Tangent& tangent,
                                 std::size_t velocity_count, const LeafValue& leaf,
                                 const HeldPoints& points) {
  const std::vector<GradientReal> y = displaced_positions(tangent, leaf);
  const std::map<std::size_t, MovingReal> states = leading_states(closures, leaf);
  const GradientPrecision::LeafValue displaced = [&](LeafKind kind, std::size_t i) -> GradientReal {
    if (kind == LeafKind::kPosition) return y[i];
    if (kind == LeafKind::kTime) return {leaf(kind, i), {{velocity_count, 1}}};
    const auto state = states.find(i);
    if (kind == LeafKind::kVelocity && state != states.end())
      return {state->second.value, {{velocity_count, state->second.first}}};
    return {leaf(kind, i)};
  };
  const GradientPrecision at(closures.statements, displaced, held_at<GradientReal>(points));
  ClosureJacobian jacobian;
  for (const GradientReal& row : rows_of(closures, at)) {
    std::vector<ScaledReal> by(velocity_count + 1);
    for (const GradientReal::Slope& slope : row.slopes) by[slope.variable] = slope.by;
    jacobian.g.push_back(row.value);
    jacobian.g_t.push_back(by.back());
    by.pop_back();
    jacobian.G.push_back(std::move(by));
  }
  add_velocity_rows(closures, tangent.scalars.size() + 3 * tangent.quaternions.size(), leaf, points,
                    jacobian);
  return jacobian;
}

namespace {

/// Rates of what is held, by its number: −(∂misfit/∂found)⁻¹ times that of the misfit where it is held.
std::map<std::size_t, ScaledReal> found_rates(const Equations& closures, const MovingPrecision& held) {
  std::map<std::size_t, ScaledReal> rates;
  for (const LoopClosure& loop : closures.closures)
    for (const Search& search : loop.searches)
      for (const auto& inverse : search.inverse) {
        ScaledReal& rate = rates[rates.size()];
        for (std::size_t k = 0; k < 2; ++k)
          rate += held.value(inverse[k]).value * held.value(search.misfit[k]).first;
      }
  return rates;
}

}  // namespace

ClosureMotion closure_motion(const Equations& closures, const model::Tangent& tangent,
                             const std::vector<ScaledReal>& z, const LeafValue& leaf,
                             const HeldPoints& points) {
  const std::vector<MovingReal> y = moving_positions(tangent, z, leaf);
  const std::map<std::size_t, MovingReal> states = leading_states(closures, leaf);
  const MovingPrecision::LeafValue moving = [&](LeafKind kind, std::size_t i) -> MovingReal {
    if (kind == LeafKind::kPosition) return y[i];
    if (kind == LeafKind::kTime) return {leaf(kind, i), 1};
    const auto state = states.find(i);
    if (kind == LeafKind::kVelocity && state != states.end()) return state->second;
    return {kind == LeafKind::kVelocity ? z[i] : leaf(kind, i)};
  };
  const MovingPrecision held(closures.statements, moving, held_at<MovingReal>(points));
  const std::map<std::size_t, ScaledReal> rates = found_rates(closures, held);
  const MovingPrecision::HeldValue found = [&](std::size_t i, const MovingReal& at) -> MovingReal {
    return {points.empty() ? at.value : points.at(i), rates.at(i)};
  };
  const std::optional<MovingPrecision> both =
      rates.empty() ? std::nullopt
                    : std::optional<MovingPrecision>(std::in_place, closures.statements, moving, found);
  ClosureMotion motion;
  for (const MovingReal& row : rows_of(closures, held)) {
    motion.g.push_back(row.value);
    motion.rate.push_back(row.first);
    motion.gamma.push_back(row.second);
  }
  if (both) {
    // With the second derivatives A of what moves where points are held, C the other way round and B of both,
    // A + C + 2 X, that of G z is A + X.
    const MovingPrecision resting(
        closures.statements, [&](LeafKind kind, std::size_t i) { return at_rest(moving(kind, i)); }, found);
    const std::vector<MovingReal> B = rows_of(closures, *both), C = rows_of(closures, resting);
    for (std::size_t r = 0; r < B.size(); ++r)
      motion.gamma[r] = (motion.gamma[r] + B[r].second - C[r].second) / ScaledReal(2);
  }
  for_each_velocity(closures, [&](std::size_t row, const Ex& velocity) {
    const MovingReal value = (both ? *both : held).value(velocity);
    motion.rate[row] = value.value;
    motion.gamma[row] = value.first;
  });
  return motion;
}

std::vector<ScaledReal> closure_values(const Equations& closures, const LeafValue& leaf,
                                       const HeldPoints& points) {
  return rows_of(closures, HighPrecision(closures.statements, leaf, held_at<ScaledReal>(points)));
}

HeldPoints found_points(const Equations& closures, const LeafValue& leaf) {
  const HighPrecision at(closures.statements, leaf);
  HeldPoints points;
  for (const LoopClosure& loop : closures.closures)
    for (const Search& search : loop.searches)
      for (const Ex& number : search.found) points.push_back(at.value(number));
  return points;
}

HeldPoints moved_points(const Equations& closures, const LeafValue& leaf, const LeafValue& moved) {
  HeldPoints points = found_points(closures, leaf);
  if (points.empty()) return points;
  const HighPrecision here(closures.statements, leaf),
      there(closures.statements, moved, held_at<ScaledReal>(points));
  HeldPoints result = points;
  std::size_t i = 0;
  for (const LoopClosure& loop : closures.closures)
    for (const Search& search : loop.searches)
      for (const auto& inverse : search.inverse) {
        for (std::size_t k = 0; k < 2; ++k)
          result[i] +=
              here.value(inverse[k]) * (there.value(search.misfit[k]) - here.value(search.misfit[k]));
        ++i;
      }
  return result;
}

ScaledReal closure_misses(const Equations& closures, const LeafValue& leaf) {
  const HighPrecision at(closures.statements, leaf);
  ScaledReal sum;
  for (const LoopClosure& loop : closures.closures)
    for (const Search& search : loop.searches) {
      sum += at.value(search.missed);
      for (const Ex& positive : {search.determinant, search.trace})
        if (at.value(positive) < ScaledReal(0)) sum += ScaledReal(1);
    }
  return sum;
}

}  // namespace jourdain::dynamics
