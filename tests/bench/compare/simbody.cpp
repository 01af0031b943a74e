// Simbody: articulated bodies, order n.
#include "bench/compare/library.hpp"

#ifdef JOURDAIN_SIMBODY
#include <Simbody.h>

namespace jourdain::compare {

namespace {

using SimTK::Vec3;
using SimTK::Vector;

Vec3 vector_of(const model::Numbers3& v) { return {v[0], v[1], v[2]}; }

SimTK::Rotation rotation_of(const model::Matrix3& R) {
  return SimTK::Rotation(
      SimTK::Mat33(R[0][0], R[0][1], R[0][2], R[1][0], R[1][1], R[1][2], R[2][0], R[2][1], R[2][2]));
}

SimTK::MassProperties mass_of(const Link& link) {
  const model::Matrix3& I = link.inertia;
  const SimTK::Inertia central(I[0][0], I[1][1], I[2][2], I[0][1], I[0][2], I[1][2]);
  return {link.mass, vector_of(link.center), central.shiftFromMassCenter(-vector_of(link.center), link.mass)};
}

class Simbody : public Library {
 public:
  Simbody(const Robot& robot, const std::vector<Sample>& samples)
      : robot_(robot),
        matter_(system_),
        forces_(system_),
        gravity_(forces_, matter_, vector_of(robot.gravity)),
        samples_(samples) {
    std::vector<SimTK::MobilizedBody> bodies;
    for (const Link& link : robot.links) {
      SimTK::MobilizedBody& parent = link.parent < 0 ? static_cast<SimTK::MobilizedBody&>(matter_.updGround())
                                                     : bodies[index(link.parent)];
      const SimTK::Body::Rigid body(mass_of(link));
      const SimTK::Rotation R_PJ = rotation_of(link.rotation);
      // Pins turn about z, sliders move along x.
      const SimTK::Rotation along(SimTK::UnitVec3(vector_of(link.axis)),
                                  SimTK::CoordinateAxis(link.motion == Motion::kTurn ? 2 : 0));
      const SimTK::Transform in(R_PJ * along, vector_of(link.position)), out(along, Vec3(0));
      if (link.motion == Motion::kTurn)
        bodies.push_back(SimTK::MobilizedBody::Pin(parent, in, body, out));
      else if (link.motion == Motion::kSlide)
        bodies.push_back(SimTK::MobilizedBody::Slider(parent, in, body, out));
      else
        bodies.push_back(SimTK::MobilizedBody::Free(parent, {R_PJ, vector_of(link.position)}, body, {}));
    }
    state_ = system_.realizeTopology();
    for (const Sample& sample : samples) states_.push_back(converted(sample));
  }

  std::string name() const override { return "Simbody"; }
  std::string calls(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kForward:
        return "realize(Acceleration)";
      case Quantity::kInverse:
        return "calcResidualForceIgnoringConstraints";
      case Quantity::kMass:
        return "calcM";
      case Quantity::kStep:
        return "four of realize(Acceleration)";
    }
    return "";
  }

  std::vector<double> result(Quantity quantity, std::size_t sample) override {
    set(states_[sample]);
    call(quantity, states_[sample]);
    switch (quantity) {
      case Quantity::kForward:
        return velocities(filled_, sample);
      case Quantity::kInverse:
        return forces(filled_, sample);
      case Quantity::kMass: {
        std::vector<double> values;
        const SimTK::Matrix T = change(sample), M = ~T * mass_ * T;
        for (int i = 0; i < M.nrow(); ++i)
          for (int j = 0; j < M.ncol(); ++j) values.push_back(M(i, j));
        return values;
      }
      case Quantity::kStep: {
        std::vector<double> values(robot_.positions());
        const Vector& q = state_.getQ();
        for (int i = 0; i < q.size(); ++i) values[index(place(i))] = q[i];
        const SimTK::Quaternion turned(quaternion(values));
        for (const double v : velocities_at(state_.getU(), turned)) values.push_back(v);
        return values;
      }
    }
    return {};
  }

  void run(Quantity quantity, int times) override {
    for (const Converted& sample : states_) {
      set(sample);
      for (int i = 0; i < times; ++i) {
        if (quantity != Quantity::kStep) set(sample);
        call(quantity, sample);
      }
    }
  }

 private:
  struct Converted {
    Vector q, u, udot;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  /// Entry in y of q's entry: quaternions come first here.
  int place(int i) const {
    if (!robot_.has_free_root() || i >= 7) return i;
    return i < 4 ? i + 3 : i - 4;
  }

  static SimTK::Vec4 quaternion(const std::vector<double>& y) {
    return y.size() < 7 ? SimTK::Vec4(1, 0, 0, 0) : SimTK::Vec4(y[3], y[4], y[5], y[6]);
  }

  /// u = T z: of a free root angular before linear velocity, both in the inertial frame.
  SimTK::Matrix change_at(const SimTK::Quaternion& turned) const {
    const int n = static_cast<int>(robot_.velocities());
    SimTK::Matrix T(n, n, 0.0);
    for (int i = 0; i < n; ++i) T(i, i) = 1;
    if (!robot_.has_free_root()) return T;
    const SimTK::Rotation R(turned);
    for (int i = 0; i < 6; ++i) T(i, i) = 0;
    for (int i = 0; i < 3; ++i) {
      T(i + 3, i) = 1;
      for (int j = 0; j < 3; ++j) T(i, j + 3) = R.asMat33()(i, j);
    }
    return T;
  }
  SimTK::Matrix change(std::size_t sample) const {
    return change_at(SimTK::Quaternion(quaternion(samples_[sample].y)));
  }

  static std::vector<double> numbers(const Vector& v) {
    std::vector<double> values;
    for (int i = 0; i < v.size(); ++i) values.push_back(v[i]);
    return values;
  }
  /// T is orthogonal.
  std::vector<double> velocities_at(const Vector& u, const SimTK::Quaternion& turned) const {
    return numbers(~change_at(turned) * u);
  }
  std::vector<double> velocities(const Vector& u, std::size_t sample) const {
    return numbers(~change(sample) * u);
  }
  std::vector<double> forces(const Vector& f, std::size_t sample) const {
    return numbers(~change(sample) * f);
  }

  Converted converted(const Sample& sample) const {
    Converted c{Vector(static_cast<int>(robot_.positions())), Vector(), Vector()};
    for (int i = 0; i < c.q.size(); ++i) c.q[i] = sample.y[index(place(i))];
    const SimTK::Matrix T = change_at(SimTK::Quaternion(quaternion(sample.y)));
    const int n = static_cast<int>(robot_.velocities());
    c.u = T * Vector(n, sample.z.data());
    c.udot = T * Vector(n, sample.zdot.data());
    return c;
  }

  void set(const Converted& c) {
    state_.updQ() = c.q;
    state_.updU() = c.u;
  }

  const Vector& rate() {
    system_.realize(state_, SimTK::Stage::Acceleration);
    return state_.getYDot();
  }

  void call(Quantity quantity, const Converted& c) {
    switch (quantity) {
      case Quantity::kForward:
        system_.realize(state_, SimTK::Stage::Acceleration);
        filled_ = state_.getUDot();
        return;
      case Quantity::kInverse:
        system_.realize(state_, SimTK::Stage::Velocity);
        matter_.calcResidualForceIgnoringConstraints(state_, Vector(), gravity_.getBodyForces(state_), c.udot,
                                                     filled_);
        return;
      case Quantity::kMass:
        system_.realize(state_, SimTK::Stage::Position);
        matter_.calcM(state_, mass_);
        return;
      case Quantity::kStep:
        return step();
    }
  }

  void step() {
    const Vector begin = state_.getY(), k1 = rate();
    state_.updY() = begin + 0.5 * kStepLength * k1;
    const Vector k2 = rate();
    state_.updY() = begin + 0.5 * kStepLength * k2;
    const Vector k3 = rate();
    state_.updY() = begin + kStepLength * k3;
    const Vector& k4 = rate();
    const Vector end = begin + kStepLength / 6 * (k1 + 2.0 * (k2 + k3) + k4);
    state_.updY() = end;
  }

  Robot robot_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::Gravity gravity_;
  std::vector<Sample> samples_;
  SimTK::State state_;
  std::vector<Converted> states_;
  Vector filled_;
  SimTK::Matrix mass_;
};

}  // namespace

std::unique_ptr<Library> make_simbody(const Robot& robot, const std::vector<Sample>& samples) {
  return std::make_unique<Simbody>(robot, samples);
}

}  // namespace jourdain::compare
#else
namespace jourdain::compare {
std::unique_ptr<Library> make_simbody(const Robot&, const std::vector<Sample>&) { return nullptr; }
}  // namespace jourdain::compare
#endif
