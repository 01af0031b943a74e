// Bullet: Featherstone's articulated bodies in double, robots with a fixed root.
#include "bench/compare/library.hpp"

#ifdef JOURDAIN_BULLET
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "bench/compare/principal.hpp"

namespace jourdain::compare {

namespace {

btVector3 vector_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

btQuaternion quaternion_of(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  return {q.x(), q.y(), q.z(), q.w()};
}

class Bullet : public Library {
 public:
  Bullet(const Robot& robot, const std::vector<Sample>& samples)
      : samples_(samples), body_(int(robot.links.size()), 1, btVector3(1, 1, 1), true, false) {
    std::vector<Principal> frames;
    for (const Link& link : robot.links) {
      const auto i = static_cast<int>(frames.size());
      frames.push_back(principal_of(link));
      const Principal& own = frames.back();
      const Principal parent = link.parent < 0 ? Principal{} : frames[static_cast<std::size_t>(link.parent)];
      const Eigen::Matrix3d to_own = own.axes.transpose();
      const btQuaternion turn = quaternion_of(to_own * matrix_of(link.rotation).transpose() * parent.axes);
      const btVector3 axis = vector_of(to_own * eigen_of(link.axis));
      const btVector3 pivot = vector_of(parent.axes.transpose() * (eigen_of(link.position) - parent.center));
      const btVector3 center = vector_of(to_own * own.center);
      if (link.motion == Motion::kTurn)
        body_.setupRevolute(i, link.mass, vector_of(own.moments), link.parent, turn, axis, pivot, center,
                            true);
      else
        body_.setupPrismatic(i, link.mass, vector_of(own.moments), link.parent, turn, axis, pivot, center,
                             true);
      weights_.push_back(link.mass * vector_of(eigen_of(robot.gravity)));
    }
    body_.finalizeMultiDof();
    body_.setLinearDamping(0);
    body_.setAngularDamping(0);
    body_.setMaxCoordinateVelocity(BT_LARGE_FLOAT);
  }

  std::string name() const override { return "Bullet"; }
  std::string calls(Quantity quantity) const override {
    return quantity == Quantity::kForward ? "computeAccelerationsArticulatedBodyAlgorithmMultiDof" : "";
  }

  std::vector<double> result(Quantity, std::size_t sample) override {
    set(samples_[sample]);
    call(samples_[sample]);
    std::vector<double> values;
    for (std::size_t i = 0; i < samples_[sample].z.size(); ++i)
      values.push_back(body_.getJointVel(static_cast<int>(i)) - samples_[sample].z[i]);
    return values;
  }

  void run(Quantity, int times) override {
    for (const Sample& sample : samples_)
      for (int i = 0; i < times; ++i) {
        set(sample);
        call(sample);
      }
  }

 private:
  void set(const Sample& sample) {
    for (std::size_t i = 0; i < sample.y.size(); ++i) body_.setJointPos(static_cast<int>(i), sample.y[i]);
  }

  /// It adds the accelerations, times a step of 1 s, to the velocities.
  void call(const Sample& sample) {
    body_.clearForcesAndTorques();
    for (std::size_t i = 0; i < sample.z.size(); ++i) {
      body_.setJointVel(static_cast<int>(i), sample.z[i]);
      body_.addLinkForce(static_cast<int>(i), weights_[i]);
    }
    body_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(1, numbers_, vectors_, matrices_, false, false,
                                                               false);
  }

  std::vector<Sample> samples_;
  btMultiBody body_;
  std::vector<btVector3> weights_;  ///< N, inertial frame
  btAlignedObjectArray<btScalar> numbers_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
};

}  // namespace

std::unique_ptr<Library> make_bullet(const Robot& robot, const std::vector<Sample>& samples) {
  if (robot.has_free_root()) return nullptr;
  return std::make_unique<Bullet>(robot, samples);
}

}  // namespace jourdain::compare
#else
namespace jourdain::compare {
std::unique_ptr<Library> make_bullet(const Robot&, const std::vector<Sample>&) { return nullptr; }
}  // namespace jourdain::compare
#endif
