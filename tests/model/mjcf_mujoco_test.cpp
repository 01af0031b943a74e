// Against MuJoCo itself, where it is installed (Debian: libmujoco-dev): accelerations of every file of tests/data/mjcf
// at random states, and how far its equality constraints are open. Contacts, limits and friction are switched off.
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

/// MuJoCo's residuals of a connect, in world axes, and of a joint equality, against the rows of the loops.
TEST(MuJoCo, OpensEqualitiesAsFar) {
  std::mt19937 random(2);
  int compared = 0;
  for (const auto& file : files()) {
    Pair pair(file);
    const Mechanism& mechanism = pair.mechanism();
    if (mechanism.loops.empty()) continue;
    double worst = 0;
    const reference::DescriptorReference<double> descriptor(mechanism);
    const reference::Reference<double> ours(mechanism);
    for (int i = 0; i < kStates; ++i) {
      const auto at = pair.sample(random, true);
      const Vector g = descriptor.loop_constraints(0, at.state.y, at.state.z).g;
      const auto motion = ours.motion(at.state);
      ASSERT_NE(pair.data().efc_pos, nullptr) << file;
      int row = 0;  // MuJoCo's and ours, in the order of the file
      for (const Loop& loop : mechanism.loops) {
        const bool ball = loop.type == LoopType::kBall;
        ASSERT_LE(row + (ball ? 3 : 1), pair.data().nefc) << file << ' ' << loop.name;
        Vector theirs = Eigen::Map<const Vector>(pair.data().efc_pos + row, ball ? 3 : 1);
        if (ball) {
          theirs = -theirs;  // from the second point to the first, in world axes
          const auto on = carrier(mechanism, mechanism.frames[loop.from.value].body,
                                  mechanism.frames[loop.to.value].body);
          if (on) theirs = (motion[on->value].R_WB.transpose() * theirs).eval();
        }
        const Vector difference = g.segment(row, theirs.size()) - theirs;
        worst = tests::larger_error(worst, difference.norm() / (1 + theirs.norm()));
        row += int(theirs.size());
        ++compared;
      }
    }
    fmt::print("{:<20} {:.1e}\n", file.stem().string(), worst);
    EXPECT_LE(worst, kSame) << file;
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace jourdain::model

#endif
