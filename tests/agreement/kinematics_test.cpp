// Functions of the kinematics and of momentum: every quantity in every choice of axes on random scenes with and without
// loops, what they are the derivatives of, and how many operations they take.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "model/kinematic_kinds.hpp"
#include "model/read/frames.hpp"
#include "properties/effort.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_scene.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {
namespace {

using model::Axes;
using model::KinematicQuantity;
using Long = long double;
using Vector = reference::VectorX<Long>;
using Matrix = reference::MatrixX<Long>;

enum class Alone { kNo, kToo };

/// All quantities of the last body's frame together in all axes, and all of the whole mechanism; those of the frame
/// alone, too, or not.
void add_everything(model::Mechanism& mechanism, Alone alone = Alone::kNo) {
  const model::FrameIndex frame = model::frame_of(mechanism, model::BodyIndex(mechanism.bodies.size() - 1));
  std::vector<KinematicQuantity> of_frame, of_all;
  for (const std::string& name : model::quantity_names()) {
    const KinematicQuantity quantity = *model::quantity_named(name);
    (model::quantity_row(quantity).of_frame ? of_frame : of_all).push_back(quantity);
  }
  for (const KinematicQuantity quantity : of_all)
    EXPECT_EQ(model::add_kinematic_function(mechanism, "", {}, Axes::kFrame, {quantity}), "");
  for (const Axes axes : {Axes::kWorldAligned, Axes::kFrame, Axes::kWorld}) {
    const std::string prefix = model::axes_names()[static_cast<std::size_t>(axes)];
    EXPECT_EQ(model::add_kinematic_function(mechanism, prefix, frame, axes, of_frame), "");
    if (alone == Alone::kNo) continue;
    for (const KinematicQuantity quantity : of_frame)
      EXPECT_EQ(model::add_kinematic_function(mechanism, prefix, frame, axes, {quantity}), "");
  }
}

/// Nothing but the functions of the kinematics.
CompiledModel compiled(const model::Mechanism& mechanism) {
  CompileOptions options;
  options.functions = {};
  return compile(mechanism, options);
}

void expect_accepted(const model::Mechanism& mechanism, const std::string& name) {
  const CompiledModel result = compiled(mechanism);
  EXPECT_THAT(result.verdict.failures, testing::IsEmpty()) << name;
  EXPECT_FALSE(result.files.empty()) << name;
  EXPECT_EQ(result.functions.size(), mechanism.kinematics.size()) << name;
}

bool moves(const model::Mechanism& mechanism) {
  return model::lay_out_coordinates(mechanism).velocity_count() > 0;
}

/// Programs and text are what an independent sum over bodies says, at eight states in 77 digits.
TEST(Kinematics, OfRandomScenesAgreesWithTheReference) {
  int scenes = 0;
  for (std::uint64_t seed = 0; seed < cases(30); ++seed) {
    model::Mechanism mechanism = random_scene(seed);
    if (!moves(mechanism)) continue;
    add_everything(mechanism, Alone::kToo);
    expect_accepted(mechanism, fmt::format("scene {}", seed));
    ++scenes;
  }
  EXPECT_GE(2 * static_cast<std::uint64_t>(scenes), cases(30));
}

TEST(Kinematics, WithLoopsAgreesWithDenseAlgebra) {
  for (std::uint64_t seed = 0; seed < cases(10); ++seed) {
    model::Mechanism mechanism = random_loops(seed);
    add_everything(mechanism);
    expect_accepted(mechanism, fmt::format("loops {}", seed));
  }
}

TEST(Kinematics, IsAcceptedInEveryTreatmentOfLoops) {
  for (const model::LoopTreatment treatment :
       {model::LoopTreatment::kExplicit, model::LoopTreatment::kPartitioned,
        model::LoopTreatment::kMultipliers}) {
    model::Mechanism mechanism = read_model(model_path("spring_four_bar.toml"));
    mechanism.loop_options.treatment = treatment;
    add_everything(mechanism, Alone::kToo);
    expect_accepted(mechanism, fmt::format("treatment {}", static_cast<int>(treatment)));
  }
}

/// Arrays of the reference by function and name, along the motion y + z s + ż s²/2 of a scene of scalar coordinates.
class Along {
 public:
  explicit Along(model::Mechanism mechanism) : reference_(mechanism), mechanism_(std::move(mechanism)) {
    const auto n = Eigen::Index(reference_.coordinate_count());
    y_ = Vector::LinSpaced(n, -0.7L, 1.1L);
    z_ = Vector::LinSpaced(n, 0.9L, -0.4L);
    zdot_ = Vector::LinSpaced(n, 0.3L, 1.7L);
  }

  Vector at(const std::string& function, const std::string& array, Long s = 0) const {
    const reference::State<Long> state{s, y_ + s * z_ + s * s / 2 * zdot_, z_ + s * zdot_};
    const auto k = *model::kinematic_function_named(mechanism_, function);
    const Vector none = Vector::Zero(z_.size());
    const auto functions = reference_.kinematics(state, zdot_, none);
    for (const auto& [name, values] : functions[k])
      if (name == array) return Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
    ADD_FAILURE() << function << " has no " << array;
    return {};
  }

  /// Row by row.
  Matrix matrix(const std::string& function, const std::string& array, Long s = 0) const {
    const Vector values = at(function, array, s);
    const Eigen::Index columns = array == "rotation" ? 3 : z_.size();
    return Eigen::Map<const Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        values.data(), values.size() / columns, columns);
  }

  /// By central differences.
  Vector rate(const std::string& function, const std::string& array) const {
    constexpr Long h = 1e-6L;
    return (at(function, array, h) - at(function, array, -h)) / (2 * h);
  }

  const Vector& z() const { return z_; }
  const Vector& zdot() const { return zdot_; }
  const reference::Reference<Long>& reference() const { return reference_; }

 private:
  reference::Reference<Long> reference_;
  model::Mechanism mechanism_;
  Vector y_, z_, zdot_;
};

void expect_near(const Vector& a, const Vector& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  EXPECT_LT((a - b).norm(), 1e-9L * (1 + b.norm())) << what;
}

Vector unskewed(const Matrix& W) { return reference::Vector3<Long>(W(2, 1), W(0, 2), W(1, 0)); }

/// The oracle's own formulas: velocities are rates of poses, accelerations of velocities, momentum and its rate belong
/// to their matrix.
TEST(Kinematics, ReferenceIsItsOwnDerivative) {
  for (const char* name : {"panda.toml", "shaking_cart.toml", "elastic_arm.toml"}) {
    model::Mechanism mechanism = read_model(model_path(name));
    add_everything(mechanism, Alone::kToo);
    const Along along(mechanism);
    const bool driven = model::time_dependence(mechanism).positions;
    const Matrix R = along.matrix("world_pose", "rotation");
    constexpr Long h = 1e-6L;
    const Matrix turning =
        (along.matrix("world_pose", "rotation", h) - along.matrix("world_pose", "rotation", -h)) / (2 * h) *
        R.transpose();
    const Vector v = along.at("world_aligned_velocity", "velocity");
    expect_near(v.head(3), along.rate("world_pose", "position"), name);
    expect_near(v.tail(3), unskewed(turning), name);
    const Vector a = along.rate("world_aligned_velocity", "velocity");
    expect_near(along.at("world_aligned_acceleration", "acceleration"), a, name);
    expect_near(along.at("world_acceleration", "acceleration"), along.rate("world_velocity", "velocity"),
                name);
    const Vector own = along.at("frame_acceleration", "acceleration");
    expect_near(own.head(3), R.transpose() * a.head(3), name);
    expect_near(own.tail(3), R.transpose() * a.tail(3), name);
    const Vector p = along.at("world_pose", "position");
    const reference::Vector3<Long> arm = p, omega = v.tail(3);
    expect_near(along.at("world_velocity", "velocity").head(3), Vector(v.head(3) + Vector(arm.cross(omega))),
                name);
    for (const char* axes : {"world_aligned", "frame", "world"}) {
      const std::string prefix = std::string(axes) + "_";
      const Matrix J = along.matrix(prefix + "jacobian", "J");
      Vector velocity = J * along.z(),
             acceleration = J * along.zdot() + along.at(prefix + "jacobian_bias", "bias");
      if (driven) velocity += along.at(prefix + "jacobian", "drift");
      expect_near(velocity, along.at(prefix + "velocity", "velocity"), name);
      expect_near(acceleration, along.at(prefix + "acceleration", "acceleration"), name);
    }
    const Vector momentum = along.at("momentum", "momentum");
    const Matrix A = along.matrix("centroidal_momentum_matrix", "A");
    Vector by_matrix = A * along.z();
    if (driven) by_matrix += along.at("centroidal_momentum_matrix", "drift_momentum");
    expect_near(by_matrix, momentum, name);
    expect_near(A * along.zdot() + along.at("centroidal_momentum_bias", "bias_momentum"),
                along.rate("momentum", "momentum"), name);
    Vector of_center = along.matrix("center_of_mass_jacobian", "J_com") * along.z();
    if (driven) of_center += along.at("center_of_mass_jacobian", "drift_com");
    expect_near(of_center, along.rate("center_of_mass", "center_of_mass"), name);
  }
}

/// Weight is the gradient of its potential, which a scene without springs has alone.
TEST(Kinematics, GravityCompensationIsTheGradientOfThePotential) {
  model::Mechanism mechanism = read_model(model_path("panda.toml"));
  add_everything(mechanism);
  const reference::Reference<Long> reference(mechanism);
  const auto n = Eigen::Index(reference.coordinate_count());
  const Vector y = Vector::LinSpaced(n, -0.7L, 1.1L), none = Vector::Zero(n);
  const auto k = *model::kinematic_function_named(mechanism, "gravity_compensation");
  const auto tau = reference.kinematics({0, y, none}, none, none)[k][0].second;
  for (Eigen::Index i = 0; i < n; ++i) {
    constexpr Long h = 1e-6L;
    const auto potential = [&](Long step) {
      return reference.evaluate({0, y + step * Vector::Unit(n, i), none}, none).potential_energy;
    };
    EXPECT_NEAR(double(tau[std::size_t(i)]), double((potential(h) - potential(-h)) / (2 * h)), 1e-8);
  }
}

std::size_t operations(const model::Mechanism& mechanism, const std::string& frame, Axes axes,
                       const std::vector<KinematicQuantity>& quantities) {
  model::Mechanism scene = mechanism;
  const std::optional<model::FrameIndex> index =
      frame.empty() ? std::nullopt : model::frame_named(scene, frame);
  EXPECT_EQ(model::add_kinematic_function(scene, "f", index, axes, quantities), "");
  const CompiledModel result = compiled(scene);
  EXPECT_TRUE(result.verdict.accepted());
  return ir::count_operations(result.module.functions.at(0)).arithmetic();
}

TEST(Kinematics, TakesAsManyOperationsAsItDid) {
  const model::Mechanism panda = read_model(model_path("panda.toml"));
  const auto count = [&](Axes axes, const std::vector<KinematicQuantity>& quantities) {
    return operations(panda, "link7", axes, quantities);
  };
  using Kind = KinematicQuantity;
  EXPECT_EQ(count(Axes::kWorldAligned, {Kind::kPose}), 100u);
  EXPECT_EQ(count(Axes::kWorldAligned, {Kind::kJacobian}), 119u);
  EXPECT_EQ(count(Axes::kWorldAligned, {Kind::kPose, Kind::kJacobian}), 147u);
  EXPECT_EQ(count(Axes::kFrame, {Kind::kJacobian}), 160u);
  EXPECT_EQ(count(Axes::kWorldAligned, {Kind::kVelocity}), 117u);
  EXPECT_EQ(count(Axes::kFrame, {Kind::kVelocity}), 77u);
  EXPECT_EQ(operations(panda, "", Axes::kFrame, {Kind::kGravityCompensation}), 75u);
  EXPECT_EQ(operations(panda, "", Axes::kFrame, {Kind::kCentroidalMomentumMatrix}), 527u);
  EXPECT_EQ(operations(panda, "", Axes::kFrame, {Kind::kCentroidalMomentumBias}), 528u);
}

}  // namespace
}  // namespace jourdain::tests
