#include "dynamics/inertia_forces.hpp"

#include <fmt/format.h>

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;
using kinematics::LinkTree;
using kinematics::Matrix3;
using kinematics::Statements;
using kinematics::WorkingFrames;

AngularVelocities derive_angular_velocities(const LinkTree& tree, const WorkingFrames& frames,
                                            const std::vector<kinematics::LinkState>& states,
                                            Statements& statements) {
  AngularVelocities omega;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    const std::string w = fmt::format("w{}", i);
    omega.parent.push_back(link.parent == kGround ? kinematics::zero_vector()
                                                  : frames.from_parent(i, omega.own[link.parent], w + "p"));
    omega.own.push_back(omega.parent[i]);
    if (link.turns_about_z())
      omega.own[i][2] = statements.bind(w + "_z", omega.parent[i][2] + states[i].rate);
    if (link.has_quaternion()) omega.own[i] = statements.bind(w, omega.parent[i] + states[i].spin);
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

bool is_zero(const Vector3& v) { return v[0].is_zero() && v[1].is_zero() && v[2].is_zero(); }

bool is_diagonal(const Matrix3& S) { return S[0][1].is_zero() && S[0][2].is_zero() && S[1][2].is_zero(); }

Vector3 product(const Matrix3& S, const Vector3& w, const std::string& name, Statements& statements) {
  return statements.bind(name, S * w);
}

class Recursion {
 public:
  Recursion(const LinkTree& tree, const WorkingFrames& frames,
            const std::vector<kinematics::LinkState>& states, const std::vector<CompositeBody>& composites,
            const AngularVelocities& omega, const JointAccelerations& accelerations, const std::string& name,
            Statements& statements)
      : tree_(tree),
        frames_(frames),
        states_(states),
        composites_(composites),
        omega_(omega),
        accelerations_(accelerations),
        name_(name),
        statements_(statements) {}

  InertiaForces derive() {
    for (std::size_t i = 0; i < tree_.links.size(); ++i) outward(i);
    return std::move(result_);
  }

 private:
  std::string named(const char* quantity, std::size_t link) const {
    return fmt::format("{}{}{}", name_, quantity, link);
  }

  /// Acceleration of the link's origin as a point of the parent, in W of the link.
  Vector3 origin_acceleration(std::size_t i) {
    const Link& link = tree_.links[i];
    const std::string a = named("a", i);
    if (link.kind == LinkKind::kFree) return kinematics::zero_vector();
    if (link.parent == kGround) return frames_.from_C_to_W(i, accelerations_.ground, a);
    const std::size_t p = link.parent;
    const std::string in_C = named(frames_.meets_in_W(i) ? "W" : "L", p);
    const Vector3 omega_C = frames_.from_parent_to_C(i, omega_.own[p], in_C + "w");
    const Vector3 alpha_C = frames_.from_parent_to_C(i, alpha_[p], in_C + "al");
    const Vector3 a_C = frames_.from_parent_to_C(i, acceleration_[p], in_C + "a");
    const Matrix3 U_C = acceleration_gradient(omega_C, alpha_C, in_C, statements_);
    return frames_.from_C_to_W(i, statements_.bind(a + "o", a_C + U_C * frames_.r_CW(i)), a);
  }

  void outward(std::size_t i) {
    const Link& link = tree_.links[i];
    alpha_.push_back(link.parent == kGround ? kinematics::zero_vector()
                                            : frames_.from_parent(i, alpha_[link.parent], named("al", i)));
    acceleration_.push_back(origin_acceleration(i));
    result_.relative.emplace_back();
    result_.from_parent.emplace_back();
    switch (link.kind) {
      case LinkKind::kTurn:
        turn(i);
        break;
      case LinkKind::kSlide:
      case LinkKind::kCurve:
        slide(i);
        break;
      case LinkKind::kScrew:
        screw(i);
        break;
      case LinkKind::kBall:
        roll(i);
        break;
      case LinkKind::kFree:
        fly(i);
        break;
    }
  }

  Ex scalar_acceleration(std::size_t i) {
    return statements_.bind(named("qdd", i), states_[i].acceleration + accelerations_.scalar[i]);
  }

  void turn(std::size_t i) {
    const Vector3 &w = omega_.parent[i], alpha = alpha_[i], a = acceleration_[i];
    const Ex rate = states_[i].rate, acceleration = scalar_acceleration(i);
    const Vector3& h = composites_[i].moments.first;
    const Matrix3& S = composites_[i].moments.second;
    const Wrench unit = momentum(composites_[i], {{0, 0, 1}, kinematics::zero_vector()});
    // Rows of S ω_p serve the parent's gyroscopic moment about z and the moment of the relative field.
    const Ex Kx = statements_.bind(named("Kx", i), w[0] * S[0][0] + w[1] * S[0][1] + w[2] * S[0][2]);
    const Ex Ky = statements_.bind(named("Ky", i), w[0] * S[0][1] + w[1] * S[1][1] + w[2] * S[1][2]);
    const Ex gyroscopic = w[1] * Kx - w[0] * Ky;
    const Ex along = statements_.bind(named("Qp", i),
                                      dot(unit.moment, alpha) + (gyroscopic + (h[0] * a[1] - h[1] * a[0])));
    result_.from_parent[i] = {tree_.links[i].sign * along};

    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * rate);
    const Ex square = statements_.bind(fmt::format("zz_{}", i), rate * rate);
    const Ex spin = statements_.bind(fmt::format("zw_{}", i), rate * (w[2] + omega_.own[i][2]));
    const Ex axial = statements_.bind(named("ax", i), w[0] * h[0] + w[1] * h[1]);
    result_.relative[i].force = statements_.bind(
        named("df", i), Vector3{-spin * h[0], -spin * h[1], twice * axial} + acceleration * unit.force);
    result_.relative[i].moment = statements_.bind(
        named("dn", i), Vector3{twice * Ky + square * S[1][2], -(twice * Kx + square * S[0][2]), 0} +
                            acceleration * unit.moment);
    alpha_[i] =
        statements_.bind(named("al", i) + "o", alpha + Vector3{w[1] * rate, -w[0] * rate, acceleration});
  }

  /// Along `direction`, of the parent's field.
  Ex parent_pull(std::size_t i, const Vector3& direction, const Vector3& alpha, const Vector3& a) {
    const Matrix3 U = acceleration_gradient(omega_.parent[i], alpha, named("V", i), statements_);
    Ex along = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (direction[k].is_zero()) continue;
      const Ex pull =
          statements_.bind(fmt::format("{}{}", named("Qp", i), k),
                           composites_[i].moments.mass * a[k] + dot(U[k], composites_[i].moments.first));
      along = along + direction[k] * pull;
    }
    return statements_.bind(named("Qp", i), along);
  }

  /// Δa on the composite body; returns Δa.
  Vector3 translate(std::size_t i, Wrench& relative) {
    const Vector3& w = omega_.parent[i];
    const Ex rate = states_[i].rate;
    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * rate);
    Vector3 change = scalar_acceleration(i) * frames_.direction(i);
    if (tree_.links[i].kind == LinkKind::kCurve) {
      const Ex square = statements_.bind(fmt::format("zz_{}", i), rate * rate);
      change = change + square * frames_.curvature(i);
    }
    const Vector3 turned = statements_.bind(named("cd", i), cross(w, frames_.direction(i)));
    const Vector3 coriolis = statements_.bind(named("co", i), twice * turned + change);
    relative.force = relative.force + composites_[i].moments.mass * coriolis;
    relative.moment = relative.moment + cross(composites_[i].moments.first, coriolis);
    relative = {statements_.bind(named("df", i) + "t", relative.force),
                statements_.bind(named("dn", i) + "t", relative.moment)};
    return coriolis;
  }

  void slide(std::size_t i) {
    const Vector3 a = acceleration_[i];
    result_.from_parent[i] = {tree_.links[i].sign * parent_pull(i, frames_.direction(i), alpha_[i], a)};
    acceleration_[i] = statements_.bind(named("a", i) + "c", a + translate(i, result_.relative[i]));
  }

  void screw(std::size_t i) {
    const Vector3 alpha = alpha_[i], a = acceleration_[i];
    turn(i);
    const Ex along = parent_pull(i, frames_.direction(i), alpha, a);
    result_.from_parent[i][0] =
        statements_.bind(named("Qp", i) + "s", result_.from_parent[i][0] + tree_.links[i].sign * along);
    acceleration_[i] = statements_.bind(named("a", i) + "c", a + translate(i, result_.relative[i]));
  }

  /// ΔU of a rotation with all components: force w (u·h) − (u·w) h, moment −w × S u, and those of dw/dt.
  void rotate(std::size_t i) {
    const Vector3 &w = states_[i].spin, &w_p = omega_.parent[i];
    const Vector3& h = composites_[i].moments.first;
    const Matrix3& S = composites_[i].moments.second;
    const Vector3 u = statements_.bind(named("u", i), w + Ex(2) * w_p);
    const Vector3 Su = product(S, u, named("Su", i), statements_);
    const Ex uh = statements_.bind(named("uh", i), dot(u, h));
    const Ex uw = statements_.bind(named("uw", i), dot(u, w));
    const Wrench accelerated = momentum(composites_[i], {accelerations_.spin[i], kinematics::zero_vector()});
    result_.relative[i].force = statements_.bind(named("df", i), uh * w - uw * h + accelerated.force);
    const Vector3 gyroscopic = is_diagonal(S) && is_zero(w_p) ? euler_moment(S, w, i) : cross(Su, w);
    result_.relative[i].moment = statements_.bind(named("dn", i), gyroscopic + accelerated.moment);
    const Vector3 change = statements_.bind(named("cw", i), cross(w_p, w));
    alpha_[i] = statements_.bind(named("al", i) + "o", alpha_[i] + change + accelerations_.spin[i]);
  }

  /// (S_yy − S_zz) ω_y ω_z and so on: in Euler's equations S_yy − S_zz = I_zz − I_yy.
  Vector3 euler_moment(const Matrix3& S, const Vector3& w, std::size_t i) {
    Vector3 moment;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      const Ex difference = statements_.bind(fmt::format("{}{}", named("dS", i), a), S[b][b] - S[c][c]);
      moment[a] = difference * statements_.bind(fmt::format("{}{}", named("ww", i), a), w[b] * w[c]);
    }
    return moment;
  }

  void roll(std::size_t i) {
    const Vector3& w = omega_.parent[i];
    const Vector3& h = composites_[i].moments.first;
    const Vector3 K = product(composites_[i].moments.second, w, named("K", i), statements_);
    const Wrench turned = momentum(composites_[i], {alpha_[i], kinematics::zero_vector()});
    const Vector3 moment =
        statements_.bind(named("Qp", i), turned.moment + cross(K, w) + cross(h, acceleration_[i]));
    result_.from_parent[i] = {moment[0], moment[1], moment[2]};
    rotate(i);
  }

  void fly(std::size_t i) {
    result_.from_parent[i].assign(6, 0);
    rotate(i);
    const Vector3& a = accelerations_.linear[i];
    acceleration_[i] = a;
    Wrench& relative = result_.relative[i];
    relative.force = statements_.bind(
        named("df", i) + "t", relative.force + composites_[i].moments.mass * accelerations_.inside[i]);
    relative.moment =
        statements_.bind(named("dn", i) + "t", relative.moment + cross(composites_[i].moments.first, a));
  }

  const LinkTree& tree_;
  const WorkingFrames& frames_;
  const std::vector<kinematics::LinkState>& states_;
  const std::vector<CompositeBody>& composites_;
  const AngularVelocities& omega_;
  const JointAccelerations& accelerations_;
  std::string name_;
  Statements& statements_;
  std::vector<Vector3> alpha_, acceleration_;  // of the link at its origin, in W
  InertiaForces result_;
};

}  // namespace

InertiaForces derive_inertia_forces(const LinkTree& tree, const WorkingFrames& frames,
                                    const std::vector<kinematics::LinkState>& states,
                                    const std::vector<CompositeBody>& composites,
                                    const AngularVelocities& omega, const JointAccelerations& accelerations,
                                    const std::string& name, Statements& statements) {
  return Recursion(tree, frames, states, composites, omega, accelerations, name, statements).derive();
}

std::vector<std::vector<Ex>> derive_generalized_forces(const WorkingFrames& frames,
                                                       const std::vector<std::vector<Column>>& columns,
                                                       const InertiaForces& inertia,
                                                       const std::vector<Wrench>& applied,
                                                       const std::string& name, Statements& statements) {
  std::vector<Wrench> own = inertia.relative;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i].force = statements.bind(fmt::format("{}ef{}", name, i), own[i].force - applied[i].force);
    own[i].moment = statements.bind(fmt::format("{}en{}", name, i), own[i].moment - applied[i].moment);
  }
  const std::vector<Wrench> totals = accumulate_wrenches(frames, own, name, statements);
  std::vector<std::vector<Ex>> forces(own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t c = 0; c < columns[i].size(); ++c)
      forces[i].push_back(statements.bind(fmt::format("{}Q{}_{}", name, i, c),
                                          power(totals[i], columns[i][c].twist) + inertia.from_parent[i][c]));
  return forces;
}

}  // namespace jourdain::dynamics
