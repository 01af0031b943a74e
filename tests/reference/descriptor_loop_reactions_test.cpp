// Loops replaced by the forces that they were found to transmit: the open tree then moves as before, and its
// joints transmit what they did, also where redundant loops share their forces with the joints in the way that
// least multipliers choose.
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
using Vector3L = Vector3<Long>;
using model::LoopType;
using tests::LoopState;

constexpr std::uint64_t kMechanisms = 200;
constexpr Long kTolerance = 1e-11L;  // the loops' forces pass through a double, condition numbers up to 1e4

/// The mechanism without loops, loaded by what their multipliers stand for: −λ ∂g/∂(p, turn) on each end.
class Opened {
 public:
  Opened(const model::Mechanism& mechanism, const LoopState& state, const VectorL& lambda)
      : mechanism_(mechanism), frames_(Reference<Long>(mechanism).frame_motion(state)) {
    bodies_ = Reference<Long>(mechanism).motion(state);
    Eigen::Index row = 0;
    for (const model::Loop& loop : mechanism.loops) {
      const auto rows = Eigen::Index(model::row_count(loop.type));
      replace(loop, lambda.segment(row, rows));
      row += rows;
    }
    mechanism_.loops.clear();
  }

  /// Whether a loop's forces act at its ends alone; a row in the axes of a moving carrier pushes that too,
  /// unless Δ = 0.
  static bool handles(const model::Mechanism& mechanism) {
    return std::all_of(mechanism.loops.begin(), mechanism.loops.end(), [](const model::Loop& loop) {
      return loop.type == LoopType::kBall || loop.type == LoopType::kRevolute ||
             loop.type == LoopType::kUniversal || loop.type == LoopType::kRod;
    });
  }

  const model::Mechanism& mechanism() const { return mechanism_; }

 private:
  void replace(const model::Loop& loop, const VectorL& lambda) {
    const auto &from = frames_[loop.from.value], &to = frames_[loop.to.value];
    const auto unit = [](const std::array<double, 3>& v) {
      return Vector3L(Vector3L(v[0], v[1], v[2]).normalized());
    };
    if (loop.type == LoopType::kRod) {
      const Vector3L push = -lambda[0] * (to.p_WC - from.p_WC).normalized();
      load(loop.to, push, Vector3L::Zero());
      load(loop.from, -push, Vector3L::Zero());
      return;
    }
    const auto body = [&](model::FrameIndex frame) { return mechanism_.frames[frame.value].body; };
    const auto carrier = model::carrier(mechanism_, body(loop.from), body(loop.to));
    const Vector3L along = lambda.head<3>();
    const Vector3L push = carrier ? Vector3L(-(bodies_[carrier->value].R_WB * along)) : Vector3L(-along);
    const Vector3L w = to.R_WB * unit(loop.to_axis);
    Vector3L moment = Vector3L::Zero();
    if (loop.type == LoopType::kUniversal) moment = -lambda[3] * w.cross(from.R_WB * unit(loop.axis));
    if (loop.type == LoopType::kRevolute) {
      const Vector3L n = unit(loop.axis);
      const auto axes = model::plane_axes({double(n.x()), double(n.y()), double(n.z())});
      for (std::size_t i = 0; i < 2; ++i) {
        const Vector3L a = from.R_WB * Vector3<double>(axes[i].data()).cast<Long>();
        moment -= lambda[3 + Eigen::Index(i)] * w.cross(a);
      }
    }
    load(loop.to, push, moment);
    load(loop.from, -push, -moment);
  }

  void load(model::FrameIndex frame, const Vector3L& force, const Vector3L& moment) {
    model::Load& load = mechanism_.loads.emplace_back();
    load.frame = frame;
    load.axes = model::LoadAxes::kWorld;
    for (Eigen::Index i = 0; i < 3; ++i) {
      load.force[std::size_t(i)] = double(force[i]);
      load.moment[std::size_t(i)] = double(moment[i]);
    }
  }

  model::Mechanism mechanism_;
  std::vector<BodyMotion<Long>> frames_, bodies_;
};

TEST(LoopReactions, LoopsMayBeReplacedByTheForcesFound) {
  int compared = 0, redundant = 0;
  for (std::uint64_t seed = 0; seed < tests::cases(kMechanisms); ++seed) {
    const model::Mechanism mechanism = tests::random_loops(seed);
    if (!Opened::handles(mechanism)) continue;
    const auto states = tests::consistent_states(mechanism, seed, 1);
    ASSERT_TRUE(states) << seed;
    const LoopState& state = states->front();
    const VectorL u =
        VectorL::LinSpaced(Eigen::Index(model::lay_out_coordinates(mechanism).input_count()), -2, 3);
    const auto closed = DescriptorReference<Long>(mechanism).solve(state.t, state.y, state.z, u);
    const Opened opened(mechanism, state, closed.loop_lambda);
    const auto open = DescriptorReference<Long>(opened.mechanism()).solve(state.t, state.y, state.z, u);
    ++compared;
    redundant += closed.rank < closed.size;
    EXPECT_LE((open.zdot - closed.zdot).norm(), kTolerance * (1 + closed.zdot.norm())) << seed;
    for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
      const JointWrench<Long>&one = closed.reactions[j], &other = open.reactions[j];
      const Long scale = kTolerance * (1 + closed.loop_lambda.norm() + one.force.norm() + one.moment.norm());
      EXPECT_LE((one.force - other.force).norm(), scale) << seed << " joint " << j;
      EXPECT_LE((one.moment - other.moment).norm(), scale) << seed << " joint " << j;
    }
  }
  EXPECT_GE(compared, int(tests::cases(kMechanisms)) / 8);
  EXPECT_GE(redundant, int(tests::cases(kMechanisms)) / 12);
}

}  // namespace
}  // namespace jourdain::reference
