// What joints transmit, what prescribed motions need and the Jacobians of mechanisms with loops, against the
// descriptor form, which has every body and every constraint apart.
#include "programs/loop_outputs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "agreement/shared_data.hpp"
#include "loops/plan/plan.hpp"
#include "loops/plan/scales.hpp"
#include "programs/closed_system.hpp"
#include "programs/loop_functions.hpp"
#include "properties/consistent_state.hpp"
#include "properties/effort.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_rolling.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;
using model::LoopTreatment;
using model::OutputKind;
using Vector = reference::VectorX<long double>;

// Double against long double at regular configurations; relative to the largest number of the kind.
constexpr double kTolerance = 1e-11;
// What regularisation takes away at such states.
constexpr double kLargestShare = 1e-8;
constexpr std::size_t kStates = 4;

/// Five bars with the first one turned at will: one degree of freedom is left, and everything depends on time.
constexpr const char* kDriven = R"toml(
[model]
name = "driven"
gravity = [0, -9.81, 0]
[[body]]
name = "crank"
mass = 1.5
center_of_mass = [0.1, 0.02, 0]
inertia = [0.01, 0.02, 0.025]
[[body]]
name = "coupler"
mass = 1
center_of_mass = [0.3, -0.01, 0.1]
inertia = [0.01, 0.03, 0.03]
[[body]]
name = "link"
mass = 0.8
center_of_mass = [0.2, 0, 0]
inertia = [0.01, 0.03, 0.03]
[[body]]
name = "rocker"
mass = 1.2
center_of_mass = [0.25, 0, 0]
inertia = [0.02, 0.05, 0.06]
[[joint]]
name = "drive"
type = "revolute"
parent = "world"
child = "crank"
motion = "1 + 0.3*sin(2*t)"
[[joint]]
name = "knee"
type = "revolute"
parent = "crank"
child = "coupler"
position = [0.3, 0, 0]
initial_position = -0.4
range = [-0.8, 0.6]
[[joint]]
name = "pivot"
type = "revolute"
parent = "world"
child = "rocker"
position = [1, 0, 0]
initial_position = 1.9
range = [1.3, 2.3]
[[joint]]
name = "elbow"
type = "revolute"
parent = "rocker"
child = "link"
position = [0.5, 0, 0]
initial_position = 0.9
range = [0.4, 1.5]
[[frame]]
name = "coupler_end"
body = "coupler"
position = [0.5, 0, 0]
[[frame]]
name = "link_end"
body = "link"
position = [0.45, 0, 0]
[[loop]]
name = "pin"
type = "planar_pin"
from = "coupler_end"
to = "link_end"
)toml";

model::Mechanism read_text(const std::string& text) {
  support::Diagnostics diagnostics("text.toml", text);
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return mechanism.value_or(model::Mechanism());
}

model::Output output_of(OutputKind kind, std::size_t number) {
  model::Output output;
  output.name = fmt::format("out{}", number);
  output.kind = kind;
  return output;
}

/// The mechanism with what its joints transmit and need, and the Jacobians of its frames, as outputs.
model::Mechanism with_outputs(model::Mechanism mechanism) {
  std::vector<model::Output>& outputs = mechanism.outputs;
  outputs.clear();
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    outputs.push_back(output_of(OutputKind::kReaction, outputs.size()));
    outputs.back().joint = model::JointIndex(j);
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c) {
      if (!mechanism.joints[j].coordinates[c].motion) continue;
      outputs.push_back(output_of(OutputKind::kDrive, outputs.size()));
      outputs.back().joint = model::JointIndex(j);
      outputs.back().coordinate = c;
    }
  }
  for (std::size_t f = 0; f < mechanism.frames.size(); ++f) {
    outputs.push_back(output_of(OutputKind::kJacobian, outputs.size()));
    outputs.back().frame = model::FrameIndex(f);
  }
  return mechanism;
}

/// The program "outputs" at states of the mechanism, against the descriptor form.
class Outputs {
 public:
  Outputs(const model::Mechanism& mechanism, const loops::LoopPlan& plan)
      : mechanism_(mechanism),
        plan_(plan),
        closed_(mechanism, {}, plan),
        outputs_(programs::loop_program(closed_.system(), ir::FunctionId::kOutputs)),
        accelerations_(programs::loop_program(closed_.system(), ir::FunctionId::kForwardDynamics)),
        form_(mechanism),
        frames_(mechanism) {}

  void compare(const LoopState& state) {
    const ir::LeafValues<double> leaves = leaves_of(state);
    const reference::DescriptorSolution<long double> solution =
        form_.solve(state.t, state.y, state.z, vector(leaves[LeafKind::kInput]));
    const auto frames = frames_.frame_motion(state);
    const Vector z = vector(leaves[LeafKind::kVelocity]),
                 zdot = vector(ir::interpret(accelerations_, leaves));
    const Vector values = vector(ir::interpret(outputs_, leaves));
    Eigen::Index next = 0;
    const auto take = [&](Eigen::Index count) {
      return Vector(values.segment((next += count) - count, count));
    };
    for (const model::Output& output : mechanism_.outputs) {
      const std::size_t j = output.joint.value;
      if (output.kind == OutputKind::kDrive)
        note(forces_, take(1), Vector::Constant(1, *solution.drives[j][output.coordinate]));
      else if (output.kind == OutputKind::kReaction)
        note(forces_, take(6), transmitted(solution.reactions[j], solution.rotor_wrenches[j]));
      else
        compare_jacobian(take(6 * z.size() + 12), z, zdot, frames[output.frame.value], solution.zdot);
    }
    EXPECT_EQ(next, values.size());
  }

  double force_error() const { return forces_.difference / forces_.size; }
  double motion_error() const {
    return std::max(velocities_.difference / velocities_.size,
                    accelerations_of_frames_.difference / accelerations_of_frames_.size);
  }

 private:
  struct Error {
    double difference = 0, size = 1e-3;
  };

  ir::LeafValues<double> leaves_of(const LoopState& state) const {
    ir::LeafValues<double> leaves;
    for (const model::Parameter& parameter : mechanism_.parameters)
      leaves[LeafKind::kParameter].push_back(parameter.value);
    for (const long double y : state.y) leaves[LeafKind::kPosition].push_back(static_cast<double>(y));
    for (std::size_t k = 0; k < form_.layout().velocity_count(); ++k)
      if (is_independent(k))
        leaves[LeafKind::kVelocity].push_back(static_cast<double>(state.z[Eigen::Index(k)]));
    for (std::size_t k = 0; k < form_.layout().input_count(); ++k)
      leaves[LeafKind::kInput].push_back(1 + 0.5 * static_cast<double>(k));
    leaves[LeafKind::kTime] = {static_cast<double>(state.t)};
    return leaves;
  }

  static Vector transmitted(const reference::JointWrench<long double>& own,
                            const reference::JointWrench<long double>& rotor) {
    Vector wrench(6);
    wrench << own.force + rotor.force, own.moment + rotor.moment;
    return wrench;
  }

  /// v = J_t z + v_bar and a = J_t zdot + a_bar with what `values` holds (J_t, J_r, v_bar, omega_bar, a_bar,
  /// zeta_bar), rotations alike, against the motion of the frame in the tree.
  void compare_jacobian(const Vector& values, const Vector& z, const Vector& zdot,
                        const reference::BodyMotion<long double>& frame, const Vector& tree_zdot) {
    const Eigen::Index n = z.size();
    const auto matrix = [&](Eigen::Index first) {
      return Eigen::Matrix<long double, 3, Eigen::Dynamic, Eigen::RowMajor>(
          Eigen::Map<const Eigen::Matrix<long double, 3, Eigen::Dynamic, Eigen::RowMajor>>(
              values.data() + first, 3, n));
    };
    const auto bar = [&](Eigen::Index k) { return values.segment<3>(6 * n + 3 * k); };
    note(velocities_, matrix(0) * z + bar(0), frame.v);
    note(velocities_, matrix(3 * n) * z + bar(1), frame.omega);
    note(accelerations_of_frames_, matrix(0) * zdot + bar(2), frame.J_t * tree_zdot + frame.a_bar);
    note(accelerations_of_frames_, matrix(3 * n) * zdot + bar(3), frame.J_r * tree_zdot + frame.zeta_bar);
  }

  static void note(Error& error, const Vector& actual, const Vector& expected) {
    error.difference =
        larger_error(error.difference, static_cast<double>((actual - expected).lpNorm<Eigen::Infinity>()));
    error.size = std::max(error.size, static_cast<double>(expected.lpNorm<Eigen::Infinity>()));
  }

  static Vector vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size())).cast<long double>();
  }

  bool is_independent(std::size_t k) const {
    return !plan_.is_reduced() ||
           std::find(plan_.independent.begin(), plan_.independent.end(), k) != plan_.independent.end();
  }

  const model::Mechanism& mechanism_;
  const loops::LoopPlan& plan_;
  programs::ClosedSystem closed_;
  ir::Program outputs_, accelerations_;
  reference::DescriptorReference<long double> form_;
  reference::Reference<long double> frames_;
  Error forces_, velocities_, accelerations_of_frames_;
};

/// Is each multiplier determined, and far from where the regularisation of multipliers shows?
bool is_regular(const model::Mechanism& mechanism, const LoopState& state) {
  const LoopFreedom freedom = loop_freedom(
      reference::DescriptorReference<long double>(mechanism).loop_constraints(state.t, state.y, state.z));
  return freedom.rank == freedom.rows && freedom.weakest > 0.05L;
}

/// The share of multipliers and accelerations that the plan says regularisation may take away: (d/(s + d))^n, s the
/// smallest singular value of G M^-1 G^T, whose rows are forces.
double left_out(const model::Mechanism& mechanism, const loops::LoopPlan& plan, const LoopState& state) {
  using Matrix = reference::MatrixX<long double>;
  if (plan.treatment != LoopTreatment::kMultipliers) return 0;
  const Matrix G =
      reference::DescriptorReference<long double>(mechanism).loop_constraints(state.t, state.y, state.z).G;
  Matrix S = loops::schur_matrix(mechanism, {state.t, state.y}, G);
  for (Eigen::Index r = 0; r < S.rows(); ++r) {
    const long double length = plan.row_length[static_cast<std::size_t>(r)];
    S.row(r) *= length;
    S.col(r) *= length;
  }
  const long double s = Eigen::JacobiSVD<Matrix>(S).singularValues().tail(1)[0], d = plan.regularisation;
  return static_cast<double>(std::pow(d / (s + d), plan.corrections + 1));
}

/// Compares where the treatment is possible; the number of states compared.
std::size_t compare(model::Mechanism mechanism, LoopTreatment treatment, std::uint64_t seed) {
  mechanism = with_outputs(std::move(mechanism));
  mechanism.loop_options.treatment = treatment;
  if (treatment == LoopTreatment::kMultipliers) mechanism.loop_options.independent.clear();
  support::Diagnostics diagnostics("model", "");
  const auto plan = loops::plan_loops(mechanism, diagnostics);
  const auto states = consistent_states(mechanism, seed, kStates);
  if (!plan || !states) return 0;
  Outputs outputs(mechanism, *plan);
  std::size_t compared = 0;
  double share = 0;
  for (const LoopState& state : *states)
    if (is_regular(mechanism, state)) {
      outputs.compare(state);
      share = std::max(share, left_out(mechanism, *plan, state));
      ++compared;
    }
  if (compared > 0)
    fmt::print("{:<22} {} {:>9.1e} {:>9.1e} of {:>9.1e}\n", mechanism.name,
               plan->is_reduced() ? "reduced    " : "multipliers", outputs.force_error(),
               outputs.motion_error(), share);
  EXPECT_LE(share, kLargestShare) << mechanism.name << ", seed " << seed;
  EXPECT_LE(outputs.force_error(), kTolerance + 10 * share) << mechanism.name << ", seed " << seed;
  EXPECT_LE(outputs.motion_error(), kTolerance + 10 * share) << mechanism.name << ", seed " << seed;
  return compared;
}

TEST(LoopOutputs, AgreeWithTheDescriptorForm) {
  for (const char* name :
       {"four_bar", "slider_crank", "squeezer", "spatial_slider_crank", "double_wishbone", "parallel_robot"})
    for (const LoopTreatment treatment : {LoopTreatment::kPartitioned, LoopTreatment::kMultipliers})
      EXPECT_GT(compare(read_model(model_path(fmt::format("{}.toml", name))), treatment, 1), 0u) << name;
}

TEST(LoopOutputs, AgreeWhereAMotionIsPrescribed) {
  for (const LoopTreatment treatment : {LoopTreatment::kPartitioned, LoopTreatment::kMultipliers})
    EXPECT_EQ(compare(read_text(kDriven), treatment, 2), kStates);
}

/// The same with a second motion: nothing is free.
std::string determined() {
  std::string text = kDriven;
  const std::string free = "initial_position = 1.9\nrange = [1.3, 2.3]\n";
  text.replace(text.find(free), free.size(), "motion = \"1.9 + 0.2*sin(3*t)\"\n");
  return text;
}

TEST(LoopOutputs, AgreeWhereMotionsDetermineEverything) {
  for (const LoopTreatment treatment : {LoopTreatment::kPartitioned, LoopTreatment::kMultipliers})
    EXPECT_EQ(compare(read_text(determined()), treatment, 3), kStates);
}

TEST(LoopOutputs, AgreeForLoopsOfEveryType) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    const model::Mechanism mechanism = random_loops(seed);
    const bool residual =
        std::any_of(mechanism.loops.begin(), mechanism.loops.end(),
                    [](const model::Loop& loop) { return loop.type == model::LoopType::kResidual; });
    if (residual) continue;
    for (const LoopTreatment treatment : {LoopTreatment::kPartitioned, LoopTreatment::kMultipliers})
      compared += compare(mechanism, treatment, seed);
  }
  fmt::print("{} states\n", compared);
  EXPECT_GE(compared, cases(60));
}

TEST(LoopOutputs, AgreeForWhatRolls) {
  std::size_t compared = 0;
  const auto add = [&](const model::Mechanism& mechanism, std::uint64_t seed) {
    if (std::none_of(mechanism.loops.begin(), mechanism.loops.end(), [](const model::Loop& loop) {
          return loop.type == model::LoopType::kResidual || loop.type == model::LoopType::kVelocity;
        }))
      compared += compare(mechanism, LoopTreatment::kMultipliers, seed);
  };
  for (const char* name : {"bicycle", "rolling_disc", "rolling_hills", "sleigh"})
    add(read_model(model_path(fmt::format("{}.toml", name))), 1);
  const std::size_t of_models = compared;
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) add(random_rolling(seed), seed);
  fmt::print("{} states\n", compared);
  EXPECT_GE(of_models, 2 * kStates);
  // Of a few none may be regular enough.
  if (cases(60) >= 15) {
    EXPECT_GT(compared, of_models);
  }
}

}  // namespace
}  // namespace jourdain::tests
