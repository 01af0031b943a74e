// The descriptor form on random mechanisms with loops, against the reference in minimal coordinates and the
// definitions of the constraint rows, written down a second time.
#include <gtest/gtest.h>

#include <algorithm>

#include "properties/consistent_state.hpp"
#include "properties/effort.hpp"
#include "properties/random_loops.hpp"
#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = VectorX<Long>;
using MatrixL = MatrixX<Long>;
using Vector3L = Vector3<Long>;
using model::LoopType;
using tests::LoopState;

constexpr std::uint64_t kMechanisms = 120;
constexpr std::size_t kStates = 2;
constexpr Long kRounding = 1e-13L;     // long double, condition numbers up to 1e6
constexpr Long kDifferences = 1e-10L;  // differences of order 6 in long double: 1e-13 times numbers up to 1e3

/// Derivative of `f` at 0 by central differences of order 6.
template <class F>
VectorL derivative(F f) {
  const Long h = 1e-3L;
  return ((f(h) - f(-h)) * 45 - (f(2 * h) - f(-2 * h)) * 9 + (f(3 * h) - f(-3 * h))) / (60 * h);
}

VectorL inputs(const model::Mechanism& mechanism) {
  return VectorL::LinSpaced(Eigen::Index(model::lay_out_coordinates(mechanism).input_count()), -2, 3);
}

struct Case {
  std::uint64_t seed = 0;
  model::Mechanism mechanism;
  std::optional<std::vector<LoopState>> states;
};

/// Drawn once for all tests.
const std::vector<Case>& drawn() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> result;
    for (std::uint64_t seed = 0; seed < tests::cases(kMechanisms); ++seed) {
      const model::Mechanism mechanism = tests::random_loops(seed);
      result.push_back({seed, mechanism, tests::consistent_states(mechanism, seed, kStates)});
    }
    return result;
  }();
  return cases;
}

/// Calls `check(mechanism, seed, state)` for consistent states of random mechanisms.
template <class Check>
void for_states(Check&& check) {
  for (const Case& one : drawn()) {
    ASSERT_TRUE(one.states) << one.seed;
    for (const LoopState& state : *one.states) check(one.mechanism, one.seed, state);
  }
}

TEST(RandomLoopsReference, ConstraintForcesAreWhatTheOpenTreesEquationsLack) {
  for_states([](const model::Mechanism& mechanism, std::uint64_t seed, const LoopState& state) {
    const VectorL u = inputs(mechanism);
    const auto solution = DescriptorReference<Long>(mechanism).solve(state.t, state.y, state.z, u);
    const Terms<Long> tree = Reference<Long>(mechanism).evaluate(state, u);
    const VectorL lacking = tree.k_bar - tree.q_bar - tree.M * solution.zdot;
    const Long scale = (tree.k_scale + tree.q_scale + tree.M_scale * solution.zdot.cwiseAbs()).norm();
    EXPECT_LE((solution.loop_forces - lacking).norm(), kRounding * scale) << seed;
    EXPECT_LE((solution.loops.G.transpose() * solution.loop_lambda - lacking).norm(), kRounding * scale)
        << seed;
  });
}

TEST(RandomLoopsReference, AccelerationsKeepTheLoopsClosed) {
  for_states([](const model::Mechanism& mechanism, std::uint64_t seed, const LoopState& state) {
    const auto solution =
        DescriptorReference<Long>(mechanism).solve(state.t, state.y, state.z, inputs(mechanism));
    const VectorL left = solution.loops.G * solution.zdot + solution.loop_gamma;
    EXPECT_LE(left.norm(), kRounding * (1 + solution.loop_gamma.norm() + solution.zdot.norm())) << seed;
  });
}

// They are orthogonal to all multipliers that do nothing, and the rank is that of the rows in z.
TEST(RandomLoopsReference, MultipliersHaveTheLeastNorm) {
  int redundant = 0;
  for_states([&](const model::Mechanism& mechanism, std::uint64_t seed, const LoopState& state) {
    const auto solution =
        DescriptorReference<Long>(mechanism).solve(state.t, state.y, state.z, inputs(mechanism));
    Eigen::JacobiSVD<MatrixL> svd(solution.loops.G, Eigen::ComputeFullU);
    svd.setThreshold(1e-9L);
    EXPECT_EQ(svd.rank(), solution.loop_rank) << seed;
    const Eigen::Index idle = solution.loops.G.rows() - solution.loop_rank;
    EXPECT_EQ(solution.size - solution.rank, idle) << seed;
    redundant += idle > 0;
    const VectorL wasted = svd.matrixU().rightCols(idle).transpose() * solution.loop_lambda;
    EXPECT_LE(wasted.norm(), kRounding * (1 + solution.loop_lambda.norm())) << seed;
  });
  EXPECT_GE(redundant, int(tests::cases(kMechanisms)) / 5);
}

TEST(RandomLoopsReference, AbsoluteStatesHaveTheSameAccelerations) {
  for_states([](const model::Mechanism& mechanism, std::uint64_t seed, const LoopState& state) {
    const DescriptorReference<Long> form(mechanism);
    const auto solution = form.solve(state.t, state.y, state.z, inputs(mechanism));
    const auto rates = form.rates(form.absolute(state.t, state.y, state.z), inputs(mechanism));
    for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
      const auto first = 6 * Eigen::Index(b);
      EXPECT_LE((rates.xdot.segment<3>(first) - solution.bodies[b].a_C).norm(),
                1e-11L * (1 + rates.xdot.norm()))
          << seed;
      EXPECT_LE((rates.xdot.segment<3>(first + 3) - solution.bodies[b].omega_dot).norm(),
                1e-11L * (1 + rates.xdot.norm()))
          << seed;
    }
  });
}

/// The rows of model::Loop, from the frames' poses in minimal coordinates.
class Definitions {
 public:
  explicit Definitions(const model::Mechanism& mechanism)
      : mechanism_(mechanism), tree_(with_origins(mechanism)) {}

  VectorL rows(const LoopState& state) const {
    const auto frames = tree_.frame_motion(state);
    std::vector<Long> g;
    for (const model::Loop& loop : mechanism_.loops) add(loop, state, frames, g);
    return Eigen::Map<const VectorL>(g.data(), Eigen::Index(g.size()));
  }

 private:
  using Frames = std::vector<BodyMotion<Long>>;

  /// Behind the mechanism's frames those of its bodies.
  static model::Mechanism with_origins(model::Mechanism mechanism) {
    for (std::size_t b = 0; b < mechanism.bodies.size(); ++b)
      mechanism.frames.emplace_back().body = model::BodyIndex(b);
    return mechanism;
  }

  static Vector3L unit(const std::array<double, 3>& v) { return Vector3L(v[0], v[1], v[2]).normalized(); }
  static Vector3L across(const std::array<double, 3>& v, std::size_t which) {
    const Vector3<double> n = Vector3<double>(v.data()).normalized();
    const auto axes = model::plane_axes({n.x(), n.y(), n.z()});
    return Vector3<double>(axes[which].data()).cast<Long>();
  }

  void add(const model::Loop& loop, const LoopState& state, const Frames& frames,
           std::vector<Long>& g) const {
    if (loop.type == LoopType::kResidual) {
      g.push_back(value(loop.residual, state, frames));
      return;
    }
    const auto &from = frames[loop.from.value], &to = frames[loop.to.value];
    const auto body = [&](model::FrameIndex frame) { return mechanism_.frames[frame.value].body; };
    const auto carrier = model::carrier(mechanism_, body(loop.from), body(loop.to));
    const Matrix3<Long> R_WK =
        carrier ? frames[mechanism_.frames.size() + carrier->value].R_WB : Matrix3<Long>::Identity();
    const Vector3L delta = to.p_WC - from.p_WC, in_from = from.R_WB.transpose() * delta;
    const Vector3L w = from.R_WB.transpose() * to.R_WB * unit(loop.to_axis);
    const auto a = [&](std::size_t i) { return across(loop.axis, i); };
    const auto meet = [&] {
      const Vector3L in_carrier = R_WK.transpose() * delta;
      g.insert(g.end(), in_carrier.begin(), in_carrier.end());
    };
    const auto add_both = [&](const Vector3L& v) { g.insert(g.end(), {a(0).dot(v), a(1).dot(v)}); };
    switch (loop.type) {
      case LoopType::kBall:
        return meet();
      case LoopType::kRevolute:
        meet();
        return add_both(w);
      case LoopType::kUniversal:
        meet();
        return g.push_back(unit(loop.axis).dot(w));
      case LoopType::kCylindrical:
      case LoopType::kPrismatic:
        add_both(in_from);
        add_both(w);
        if (loop.type == LoopType::kPrismatic)
          g.push_back(a(0).dot(from.R_WB.transpose() * to.R_WB * across(loop.to_axis, 1)));
        return;
      case LoopType::kPlanarPin:
        return add_both(R_WK.transpose() * delta);
      case LoopType::kPointInPlane:
        return g.push_back(unit(loop.axis).dot(in_from));
      case LoopType::kPointOnLine:
        return add_both(in_from);
      case LoopType::kRod: {
        const Long length = value(loop.length, state, frames);
        return g.push_back((delta.squaredNorm() - length * length) / (2 * length));
      }
      default:
        FAIL() << "no rows for a loop of type " << int(loop.type);
    }
  }

  Long value(const model::Expression& expression, const LoopState& state, const Frames& frames) const {
    using Kind = model::Variable::Kind;
    std::vector<Long> parameters;
    for (const model::Parameter& parameter : mechanism_.parameters) parameters.push_back(parameter.value);
    const auto layout = model::lay_out_coordinates(mechanism_);
    return expression.evaluate<Long>(
        parameters, [](double v) { return Long(v); },
        [&](const model::Variable& v) -> Long {
          if (v.kind == Kind::kTime) return state.t;
          if (v.kind == Kind::kFrameDirection)
            return frames[v.index].R_WB(Eigen::Index(v.component / 3), Eigen::Index(v.component % 3));
          if (v.kind == Kind::kFramePosition) return frames[v.index].p_WC[Eigen::Index(v.component)];
          return state.y[Eigen::Index(*layout.joints[v.index].position[v.component])];
        });
  }

  const model::Mechanism& mechanism_;
  Reference<Long> tree_;
};

// Off the loops, where no row is zero: values, G by displacing one coordinate after the other, and g_t by
// letting time run.
TEST(RandomLoopsReference, RowsAreTheirDefinitionsAndDerivativesOfThem) {
  for_states([](const model::Mechanism& mechanism, std::uint64_t seed, LoopState state) {
    const DescriptorReference<Long> form(mechanism);
    const Definitions definitions(mechanism);
    const VectorL way = VectorL::LinSpaced(state.z.size(), -0.2L, 0.3L);
    state.y = tests::displaced(mechanism, state.y, way);
    const auto rows = form.loop_constraints(state.t, state.y, state.z);
    EXPECT_LE((rows.g - definitions.rows(state)).norm(), 1e-16L * (1 + state.y.norm())) << seed;
    for (Eigen::Index k = 0; k < state.z.size(); ++k) {
      const VectorL column = derivative([&](Long h) {
        const VectorL change = h * VectorL::Unit(state.z.size(), k);
        return definitions.rows({state.t, tests::displaced(mechanism, state.y, change), state.z});
      });
      EXPECT_LE((column - rows.G.col(k)).norm(), kDifferences) << seed << " column " << k;
    }
    const VectorL running = derivative([&](Long h) {
      return definitions.rows({state.t + h, state.y, state.z});
    });
    EXPECT_LE((rows.rate - rows.G * state.z - running).norm(), kDifferences) << seed;
  });
}

// γ is the rate of G z + g_t while z stays what it is.
TEST(RandomLoopsReference, GammaIsTheRateOfTheConstraintsRate) {
  for_states([](const model::Mechanism& mechanism, std::uint64_t seed, const LoopState& state) {
    const DescriptorReference<Long> form(mechanism);
    const VectorL ydot = Reference<Long>(mechanism).position_rate(state);
    const VectorL gamma = derivative([&](Long h) {
      return VectorL(form.loop_constraints(state.t + h, state.y + h * ydot, state.z).rate);
    });
    const auto solution = form.solve(state.t, state.y, state.z, inputs(mechanism));
    EXPECT_LE((gamma - solution.loop_gamma).norm(), kDifferences * (1 + gamma.norm())) << seed;
  });
}

}  // namespace
}  // namespace jourdain::reference
