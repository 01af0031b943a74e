// Orocos KDL: recursions for chains with a fixed root.
#include "bench/compare/library.hpp"

#ifdef JOURDAIN_KDL
#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

namespace jourdain::compare {

namespace {

KDL::Vector vector_of(const model::Numbers3& v) { return {v[0], v[1], v[2]}; }

KDL::Rotation rotation_of(const model::Matrix3& R) {
  return {R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]};
}

KDL::Chain chain_of(const Robot& robot) {
  KDL::Chain chain;
  for (const Link& link : robot.links) {
    const KDL::Frame frame(rotation_of(link.rotation), vector_of(link.position));
    const model::Matrix3& I = link.inertia;
    const KDL::RigidBodyInertia inertia(
        link.mass, vector_of(link.center),
        KDL::RotationalInertia(I[0][0], I[1][1], I[2][2], I[0][1], I[0][2], I[1][2]));
    const KDL::Joint joint(link.name, frame.p, frame.M * vector_of(link.axis),
                           link.motion == Motion::kTurn ? KDL::Joint::RotAxis : KDL::Joint::TransAxis);
    chain.addSegment(KDL::Segment(link.name, joint, frame, inertia));
  }
  return chain;
}

KDL::JntArray array_of(const std::vector<double>& values) {
  KDL::JntArray array(static_cast<unsigned>(values.size()));
  for (unsigned i = 0; i < array.rows(); ++i) array(i) = values[i];
  return array;
}

class Kdl : public Library {
 public:
  Kdl(const Robot& robot, const std::vector<Sample>& samples)
      : chain_(chain_of(robot)),
        forward_(chain_, vector_of(robot.gravity)),
        inverse_(chain_, vector_of(robot.gravity)),
        parameters_(chain_, vector_of(robot.gravity)),
        no_force_(chain_.getNrOfSegments()),
        zero_(chain_.getNrOfJoints()),
        filled_(chain_.getNrOfJoints()),
        mass_(chain_.getNrOfJoints()) {
    for (const Sample& sample : samples)
      samples_.push_back({array_of(sample.y), array_of(sample.z), array_of(sample.zdot)});
  }

  std::string name() const override { return "Orocos KDL"; }
  std::string calls(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kForward:
        return "ChainFdSolver_RNE";
      case Quantity::kInverse:
        return "ChainIdSolver_RNE";
      case Quantity::kMass:
        return "ChainDynParam";
      case Quantity::kStep:
        return "";
    }
    return "";
  }

  std::vector<double> result(Quantity quantity, std::size_t sample) override {
    call(quantity, samples_[sample]);
    std::vector<double> values;
    if (quantity == Quantity::kMass)
      for (unsigned i = 0; i < mass_.rows(); ++i)
        for (unsigned j = 0; j < mass_.columns(); ++j) values.push_back(mass_(i, j));
    else
      for (unsigned i = 0; i < filled_.rows(); ++i) values.push_back(filled_(i));
    return values;
  }

  void run(Quantity quantity, int times) override {
    for (int i = 0; i < times; ++i)
      for (const Arrays& sample : samples_) call(quantity, sample);
  }

 private:
  struct Arrays {
    KDL::JntArray y, z, zdot;
  };

  void call(Quantity quantity, const Arrays& s) {
    if (quantity == Quantity::kForward) forward_.CartToJnt(s.y, s.z, zero_, no_force_, filled_);
    if (quantity == Quantity::kInverse) inverse_.CartToJnt(s.y, s.z, s.zdot, no_force_, filled_);
    if (quantity == Quantity::kMass) parameters_.JntToMass(s.y, mass_);
  }

  KDL::Chain chain_;
  KDL::ChainFdSolver_RNE forward_;
  KDL::ChainIdSolver_RNE inverse_;
  KDL::ChainDynParam parameters_;
  KDL::Wrenches no_force_;
  KDL::JntArray zero_, filled_;
  KDL::JntSpaceInertiaMatrix mass_;
  std::vector<Arrays> samples_;
};

}  // namespace

std::unique_ptr<Library> make_kdl(const Robot& robot, const std::vector<Sample>& samples) {
  if (!robot.is_chain()) return nullptr;
  return std::make_unique<Kdl>(robot, samples);
}

}  // namespace jourdain::compare
#else
namespace jourdain::compare {
std::unique_ptr<Library> make_kdl(const Robot&, const std::vector<Sample>&) { return nullptr; }
}  // namespace jourdain::compare
#endif
