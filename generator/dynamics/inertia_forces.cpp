#include "dynamics/inertia_forces.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkTree;
using kinematics::Matrix3;
using kinematics::Statements;
using kinematics::WorkingFrames;

AngularVelocities derive_angular_velocities(const LinkTree& tree, const WorkingFrames& frames,
                                            const std::vector<Ex>& rate, Statements& statements) {
  AngularVelocities omega;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    const std::string w = fmt::format("w{}", i);
    omega.parent.push_back(link.parent == kGround ? kinematics::zero_vector()
                                                  : frames.from_parent(i, omega.own[link.parent], w + "p"));
    omega.own.push_back(omega.parent[i]);
    if (link.revolute) omega.own[i][2] = statements.bind(w + "_z", omega.parent[i][2] + rate[i]);
  }
  return omega;
}

namespace {

/// U = [α] + [ω][ω], so that points of a body at x from its origin have the acceleration a + U x.
Matrix3 acceleration_gradient(const Vector3& omega, const Vector3& alpha, const std::string& name,
                              Statements& statements) {
  Matrix3 products;  // ω ωᵀ, bound in a fixed order
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      products[i][j] = products[j][i] =
          statements.bind(fmt::format("{}w{}{}", name, i, j), omega[i] * omega[j]);
  Matrix3 U;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    U[i][i] = -products[j][j] - products[k][k];
    U[j][k] = products[j][k] - alpha[i];
    U[k][j] = products[j][k] + alpha[i];
  }
  for (std::size_t i = 0; i < 3; ++i) U[i] = statements.bind(fmt::format("{}U{}", name, i), U[i]);
  return U;
}

class InertiaForces {
 public:
  InertiaForces(const LinkTree& tree, const WorkingFrames& frames,
                const std::vector<CompositeBody>& composites, const AngularVelocities& omega,
                const JointMotion& motion, const std::string& name, Statements& statements)
      : tree_(tree),
        frames_(frames),
        composites_(composites),
        omega_(omega),
        motion_(motion),
        name_(name),
        statements_(statements) {}

  std::vector<Ex> derive() {
    for (std::size_t i = 0; i < tree_.links.size(); ++i) outward(i);
    const std::vector<Wrench> totals = accumulate_wrenches(tree_, frames_, relative_, name_, statements_);
    std::vector<Ex> forces;
    for (std::size_t i = 0; i < tree_.links.size(); ++i) {
      const Link& link = tree_.links[i];
      const Ex outer = link.revolute ? totals[i].moment[2] : totals[i].force[2];
      forces.push_back(
          statements_.bind(fmt::format("{}Q{}", name_, i), link.sign * (outer + from_parent_[i])));
    }
    return forces;
  }

 private:
  std::string named(const char* quantity, std::size_t link) const {
    return fmt::format("{}{}{}", name_, quantity, link);
  }

  /// Acceleration of the link's origin as a point of the parent, in W of the link.
  Vector3 origin_acceleration(std::size_t i) {
    const Link& link = tree_.links[i];
    const std::string a = named("a", i);
    if (link.parent == kGround)
      return statements_.bind(a, transpose(link.R_PL) * motion_.ground_acceleration);
    const std::size_t p = link.parent;
    const std::string from = named(link.parallel ? "W" : "L", p);
    const Vector3 omega = link.parallel ? omega_.own[p] : frames_.to_link(p, omega_.own[p], from + "w");
    const Vector3 alpha = link.parallel ? alpha_[p] : frames_.to_link(p, alpha_[p], from + "al");
    const Vector3 acceleration =
        link.parallel ? acceleration_[p] : frames_.to_link(p, acceleration_[p], from + "a");
    const Matrix3 U = acceleration_gradient(omega, alpha, from, statements_);
    const Vector3 sum = statements_.bind(a + "o", acceleration + U * frames_.offset(i));
    return link.parallel ? sum : statements_.bind(a, transpose(link.R_PL) * sum);
  }

  void outward(std::size_t i) {
    const Link& link = tree_.links[i];
    const Vector3& w = omega_.parent[i];
    const Vector3 alpha = link.parent == kGround
                              ? kinematics::zero_vector()
                              : frames_.from_parent(i, alpha_[link.parent], named("al", i));
    const Vector3 a = origin_acceleration(i);
    alpha_.push_back(alpha);
    acceleration_.push_back(a);
    relative_.emplace_back();
    from_parent_.emplace_back();
    if (link.revolute)
      turn(i, w, alpha, a);
    else
      slide(i, w, alpha, a);
  }

  void turn(std::size_t i, const Vector3& w, const Vector3& alpha, const Vector3& a) {
    const Ex &rate = motion_.rate[i], &acceleration = motion_.acceleration[i];
    const Vector3& h = composites_[i].moments.first;
    const Matrix3& S = composites_[i].moments.second;
    const Wrench momentum = unit_momentum(tree_.links[i], composites_[i]);
    // Rows of S ω_p serve the parent's gyroscopic moment about z and the moment of the relative field.
    const Ex Kx = statements_.bind(named("Kx", i), w[0] * S[0][0] + w[1] * S[0][1] + w[2] * S[0][2]);
    const Ex Ky = statements_.bind(named("Ky", i), w[0] * S[0][1] + w[1] * S[1][1] + w[2] * S[1][2]);
    const Ex gyroscopic = w[1] * Kx - w[0] * Ky;
    from_parent_[i] = statements_.bind(
        named("Qp", i), dot(momentum.moment, alpha) + (gyroscopic + (h[0] * a[1] - h[1] * a[0])));

    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * rate);
    const Ex square = statements_.bind(fmt::format("zz_{}", i), rate * rate);
    const Ex spin = statements_.bind(fmt::format("zw_{}", i), rate * (w[2] + omega_.own[i][2]));
    const Ex axial = statements_.bind(named("ax", i), w[0] * h[0] + w[1] * h[1]);
    relative_[i].force = statements_.bind(
        named("df", i), Vector3{-spin * h[0], -spin * h[1], twice * axial} + acceleration * momentum.force);
    relative_[i].moment = statements_.bind(
        named("dn", i), Vector3{twice * Ky + square * S[1][2], -(twice * Kx + square * S[0][2]), 0} +
                            acceleration * momentum.moment);
    alpha_[i] =
        statements_.bind(named("al", i) + "o", alpha + Vector3{w[1] * rate, -w[0] * rate, acceleration});
  }

  void slide(std::size_t i, const Vector3& w, const Vector3& alpha, const Vector3& a) {
    const Ex& mass = composites_[i].moments.mass;
    const Vector3& h = composites_[i].moments.first;
    const Matrix3 U = acceleration_gradient(w, alpha, named("V", i), statements_);
    from_parent_[i] = statements_.bind(named("Qp", i), mass * a[2] + dot(U[2], h));
    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * motion_.rate[i]);
    const Vector3 coriolis =
        statements_.bind(named("co", i), Vector3{w[1] * twice, -w[0] * twice, motion_.acceleration[i]});
    relative_[i].force = statements_.bind(named("df", i), mass * coriolis);
    relative_[i].moment = statements_.bind(named("dn", i), cross(h, coriolis));
    acceleration_[i] = statements_.bind(named("a", i) + "c", a + coriolis);
  }

  const LinkTree& tree_;
  const WorkingFrames& frames_;
  const std::vector<CompositeBody>& composites_;
  const AngularVelocities& omega_;
  const JointMotion& motion_;
  std::string name_;
  Statements& statements_;
  std::vector<Vector3> alpha_, acceleration_;  // of the link at its origin, in W
  std::vector<Wrench> relative_;               // of the field that the joint adds, on the composite body
  std::vector<Ex> from_parent_;                // along the joint, of the parent's field on the composite body
};

}  // namespace

std::vector<Ex> derive_inertia_forces(const LinkTree& tree, const WorkingFrames& frames,
                                      const std::vector<CompositeBody>& composites,
                                      const AngularVelocities& omega, const JointMotion& motion,
                                      const std::string& name, Statements& statements) {
  return InertiaForces(tree, frames, composites, omega, motion, name, statements).derive();
}

}  // namespace jourdain::dynamics
