// Against MuJoCo itself, where it is installed (Debian: libmujoco-dev): accelerations of every file of tests/data/mjcf
// at random states, without and with its equality constraints, and how far those are open. Contacts, limits and
// friction are switched off.
#include <gtest/gtest.h>

#ifndef JOURDAIN_MUJOCO

namespace jourdain::model {
namespace {

TEST(MuJoCo, AgreesInAccelerationsAndConstraints) {
  GTEST_SKIP() << "mujoco/mujoco.h was not found: install libmujoco-dev and configure again";
}

}  // namespace
}  // namespace jourdain::model

#else

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>

#include "agreement/shared_data.hpp"
#include "model/read/read.hpp"
#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

using Vector = Eigen::VectorXd;

constexpr int kStates = 10;
/// Of accelerations and constraints, of their norm: both sides sum a few hundred products in double.
constexpr double kSame = 1e-10;
constexpr double kTheirMoments = 5e-6;  // of an inertia tensor's norm

struct Free {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

std::vector<std::filesystem::path> files() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(tests::data_path("mjcf")))
    if (entry.path().extension() == ".xml") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// One file, read by both.
class Pair {
 public:
  explicit Pair(const std::filesystem::path& file) {
    char error[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof error));
    if (!model_) throw std::runtime_error(error);
    mechanism_ = tests::read_model(file, {.snap = 0});
    model_->opt.disableflags |=
        mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS | mjDSBL_CLAMPCTRL | mjDSBL_WARMSTART;
    // Equality constraints make a quadratic problem, which Newton's method solves as far as double goes.
    model_->opt.solver = mjSOL_NEWTON;
    model_->opt.tolerance = 0;
    model_->opt.noslip_iterations = 0;
    for (int i = 0; i < model_->nu; ++i) {
      model_->actuator_forcelimited[i] = 0;
      // Those of tendons are not read.
      if (model_->actuator_trntype[i] != mjTRN_JOINT)
        std::fill_n(model_->actuator_biasprm + i * mjNBIAS, mjNBIAS, 0.0);
    }
    take_tensors();
    data_.reset(mj_makeData(model_.get()));
  }

  const Mechanism& mechanism() const { return mechanism_; }
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

  /// A state, and inputs by name, that both have. ż of MuJoCo's open tree, or with its equality constraints.
  struct Sample {
    reference::State<double> state;
    Vector u;
    Vector zdot;
  };
  Sample sample(std::mt19937& random, bool constrained) {
    std::normal_distribution<double> number;
    mj_resetData(model_.get(), data_.get());
    for (int i = 0; i < model_->nq; ++i) data_->qpos[i] = model_->qpos0[i] + number(random);
    mj_normalizeQuat(model_.get(), data_->qpos);
    for (int i = 0; i < model_->nv; ++i) data_->qvel[i] = number(random);
    const CoordinateLayout layout = lay_out_coordinates(mechanism_);
    Sample result;
    result.u = Vector::Zero(Eigen::Index(layout.input_count()));
    for (std::size_t i = 0; i < layout.input_count(); ++i) {
      const int id = mj_name2id(model_.get(), mjOBJ_ACTUATOR, layout.input_names[i].c_str());
      if (id >= 0) data_->ctrl[id] = result.u[Eigen::Index(i)] = number(random);
    }
    const int kept = model_->opt.disableflags;
    if (!constrained) model_->opt.disableflags |= mjDSBL_CONSTRAINT;
    mj_forward(model_.get(), data_.get());
    model_->opt.disableflags = kept;
    result.state.y = Eigen::Map<const Vector>(data_->qpos, model_->nq);
    result.state.z = Eigen::Map<const Vector>(data_->qvel, model_->nv);
    result.zdot = Eigen::Map<const Vector>(data_->qacc, model_->nv);
    return result;
  }

 private:
  /// MuJoCo finds principal moments to six digits or so: from here on both have the tensors that these make.
  void take_tensors() {
    for (Body& body : mechanism_.bodies) {
      const int id = mj_name2id(model_.get(), mjOBJ_BODY, body.name.c_str());
      Inertia& I = body.inertia;
      if (id < 0 || (I.xy.is_zero() && I.xz.is_zero() && I.yz.is_zero())) continue;
      const mjtNum* q = model_->body_iquat + 4 * id;
      const Eigen::Matrix3d axes = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      const Eigen::Map<Eigen::Vector3d> moments(model_->body_inertia + 3 * id);
      const Eigen::Matrix3d theirs = axes * moments.asDiagonal() * axes.transpose();
      Eigen::Matrix3d ours;
      ours << I.xx.constant(), I.xy.constant(), I.xz.constant(), I.xy.constant(), I.yy.constant(),
          I.yz.constant(), I.xz.constant(), I.yz.constant(), I.zz.constant();
      EXPECT_LE((theirs - ours).norm(), kTheirMoments * ours.norm()) << body.name;
      I = {theirs(0, 0), theirs(1, 1), theirs(2, 2), theirs(0, 1), theirs(0, 2), theirs(1, 2)};
    }
  }

  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  Mechanism mechanism_;
};

TEST(MuJoCo, NamesTheSameCoordinatesInTheSameOrder) {
  for (const auto& file : files()) {
    const Pair pair(file);
    const CoordinateLayout layout = lay_out_coordinates(pair.mechanism());
    EXPECT_EQ(layout.position_count(), std::size_t(pair.model().nq)) << file;
    EXPECT_EQ(layout.velocity_count(), std::size_t(pair.model().nv)) << file;
    std::vector<std::string> ours;
    for (const JointIndex joint : moving_joints(pair.mechanism()))
      ours.push_back(pair.mechanism().joints[joint.value].name);
    ASSERT_EQ(ours.size(), std::size_t(pair.model().njnt)) << file;
    for (int j = 0; j < pair.model().njnt; ++j) {
      const char* name = mj_id2name(&pair.model(), mjOBJ_JOINT, j);
      if (name && name[0]) {
        EXPECT_EQ(ours[std::size_t(j)], name) << file;
      }
    }
  }
}

TEST(MuJoCo, AcceleratesTheSame) {
  std::mt19937 random(1);
  for (const auto& file : files()) {
    Pair pair(file);
    double worst = 0;
    const reference::Reference<double> ours(pair.mechanism());
    for (int i = 0; i < kStates; ++i) {
      const auto at = pair.sample(random, false);
      const Vector zdot = reference::forward_dynamics(ours.evaluate(at.state, at.u));
      worst = tests::larger_error(worst, tests::normwise_error(zdot, at.zdot));
    }
    fmt::print("{:<20} {:.1e}\n", file.stem().string(), worst);
    EXPECT_LE(worst, kSame) << file;
  }
}

/// Residuals of the equalities as MuJoCo has them, and their rates per unit of z. Of a connect the way from the second
/// point to the first, in world axes; ours is the way back, in axes of the carrier.
struct Equalities {
  Vector residual;
  Eigen::MatrixXd J;
};

Equalities in_their_axes(const Mechanism& mechanism, const reference::State<double>& state) {
  const auto ours = reference::DescriptorReference<double>(mechanism).loop_constraints(0, state.y, state.z);
  const auto motion = reference::Reference<double>(mechanism).motion(state);
  Equalities theirs{ours.g, ours.G};
  Eigen::Index row = 0;
  for (const Loop& loop : mechanism.loops) {
    if (loop.type == LoopType::kResidual) {
      ++row;
      continue;
    }
    EXPECT_EQ(loop.type, LoopType::kBall) << loop.name;
    auto way = theirs.residual.segment<3>(row);
    auto J = theirs.J.middleRows<3>(row);
    if (const auto on = carrier(mechanism, mechanism.frames[loop.from.value].body,
                                mechanism.frames[loop.to.value].body)) {
      const auto& turning = motion[on->value];
      way = (turning.R_WB * way).eval();
      J = (turning.R_WB * J).eval();
      // d/dt (R g) = R ġ + ω × R g: the states are not closed.
      const Eigen::MatrixXd omega = turning.R_WB * turning.J_r;
      for (Eigen::Index i = 0; i < J.cols(); ++i)
        J.col(i) += Eigen::Vector3d(omega.col(i)).cross(Eigen::Vector3d(way));
    }
    way = -way.eval();
    J = -J.eval();
    row += 3;
  }
  EXPECT_EQ(row, theirs.residual.size());
  return theirs;
}

/// For every file with loops, the worst of `error(pair, sample, equalities)` at random states.
template <class Error>
void compare_equalities(unsigned seed, const Error& error) {
  std::mt19937 random(seed);
  int compared = 0;
  for (const auto& file : files()) {
    Pair pair(file);
    if (pair.mechanism().loops.empty()) continue;
    double worst = 0;
    for (int i = 0; i < kStates; ++i) {
      const Pair::Sample at = pair.sample(random, true);
      const Equalities equalities = in_their_axes(pair.mechanism(), at.state);
      ASSERT_EQ(equalities.residual.size(), pair.data().nefc) << file;
      worst = tests::larger_error(worst, error(pair, at, equalities));
      ++compared;
    }
    fmt::print("{:<20} {:.1e}\n", file.stem().string(), worst);
    EXPECT_LE(worst, kSame) << file;
  }
  EXPECT_GE(compared, 2 * kStates);
}

TEST(MuJoCo, OpensEqualitiesAsFar) {
  compare_equalities(2, [](const Pair& pair, const Pair::Sample&, const Equalities& ours) {
    const Eigen::Map<const Vector> residual(pair.data().efc_pos, pair.data().nefc);
    return (ours.residual - residual).norm() / (1 + residual.norm());
  });
}

/// MuJoCo's equalities give way: M ż = k̄ − q̄ + Jᵀ f with J ż + R f = a_ref ("Computation" of its documentation).
/// R and a_ref, which are its own choice, are taken from it, and nothing else.
TEST(MuJoCo, AcceleratesTheSameWithEqualities) {
  compare_equalities(3, [](const Pair& pair, const Pair::Sample& at, const Equalities& ours) {
    const mjData& data = pair.data();
    const Eigen::Map<const Vector> give(data.efc_R, data.nefc), a_ref(data.efc_aref, data.nefc);
    const auto terms = reference::Reference<double>(pair.mechanism()).evaluate(at.state, at.u);
    const auto M = terms.M.ldlt();
    const Vector open = M.solve(terms.k_bar - terms.q_bar);
    Eigen::MatrixXd A = ours.J * M.solve(ours.J.transpose());
    A.diagonal() += give;
    const Vector f = A.ldlt().solve(a_ref - ours.J * open);
    const Vector zdot = open + M.solve(ours.J.transpose() * f);
    // The equalities must matter.
    EXPECT_GT(tests::normwise_error(open, at.zdot), 1e-3);
    return tests::normwise_error(zdot, at.zdot);
  });
}

}  // namespace
}  // namespace jourdain::model

#endif
