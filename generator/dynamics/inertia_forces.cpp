#include "dynamics/inertia_forces.hpp"

#include <fmt/format.h>

#include "dynamics/accelerations.hpp"
#include "dynamics/wrenches.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;
using kinematics::Matrix3;
using kinematics::Statements;

namespace {

bool is_diagonal(const Matrix3& S) { return S[0][1].is_zero() && S[0][2].is_zero() && S[1][2].is_zero(); }

/// What the inertia forces of a tree do, link by link.
struct InertiaForces {
  /// Wrench on the composite body of the acceleration field that the link adds to its parent's, in W.
  std::vector<Wrench> relative;
  /// Along each column of the link, of the parent's field on the composite body.
  std::vector<std::vector<Ex>> from_parent;
};

class Recursion {
 public:
  Recursion(const Scene& scene, const JointAccelerations& accelerations, const std::string& name)
      : scene_(scene), accelerations_(accelerations), name_(name), statements_(scene.statements) {}

  InertiaForces derive() {
    for (std::size_t i = 0; i < scene_.tree.links.size(); ++i) outward(i);
    return std::move(result_);
  }

 private:
  std::string named(const char* quantity, std::size_t link) const {
    return fmt::format("{}{}{}", name_, quantity, link);
  }

  /// Acceleration of the link's origin as a point of the parent, in W of the link.
  Vector3 origin_acceleration(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    const std::string a = named("a", i);
    if (accelerations_.free[i]) return kinematics::zero_vector();
    if (link.parent == kGround) return scene_.frames.from_C_to_W(i, accelerations_.ground, a);
    const std::size_t p = link.parent;
    const std::string in_C = named(scene_.frames.meets_in_W(i) ? "W" : "L", p);
    const Vector3 omega_C = scene_.frames.from_parent_to_C(i, scene_.omega.own[p], in_C + "w");
    const Vector3 alpha_C = scene_.frames.from_parent_to_C(i, alpha_[p], in_C + "al");
    const Vector3 a_C = scene_.frames.from_parent_to_C(i, acceleration_[p], in_C + "a");
    const Matrix3 U_C = acceleration_gradient(omega_C, alpha_C, in_C, statements_);
    return scene_.frames.from_C_to_W(i, statements_.bind(a + "o", a_C + U_C * scene_.frames.r_CW(i)), a);
  }

  void outward(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    alpha_.push_back(link.parent == kGround
                         ? kinematics::zero_vector()
                         : scene_.frames.from_parent(i, alpha_[link.parent], named("al", i)));
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
    return statements_.bind(named("qdd", i), scene_.states[i].acceleration + accelerations_.scalar[i]);
  }

  void turn(std::size_t i) {
    const Vector3 &w = scene_.omega.parent[i], alpha = alpha_[i], a = acceleration_[i];
    const Ex rate = scene_.states[i].rate, acceleration = scalar_acceleration(i);
    const Vector3& h = scene_.composites[i].moments.first;
    const Matrix3& S = scene_.composites[i].moments.second;
    const Wrench unit = momentum(scene_.composites[i], {{0, 0, 1}, kinematics::zero_vector()});
    // Rows of S ω_p serve the parent's gyroscopic moment about z and the moment of the relative field.
    const Ex Kx = statements_.bind(named("Kx", i), w[0] * S[0][0] + w[1] * S[0][1] + w[2] * S[0][2]);
    const Ex Ky = statements_.bind(named("Ky", i), w[0] * S[0][1] + w[1] * S[1][1] + w[2] * S[1][2]);
    const Ex gyroscopic = w[1] * Kx - w[0] * Ky;
    const Ex along = statements_.bind(named("Qp", i),
                                      dot(unit.moment, alpha) + (gyroscopic + (h[0] * a[1] - h[1] * a[0])));
    result_.from_parent[i] = {scene_.tree.links[i].sign * along};

    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * rate);
    const Ex square = statements_.bind(fmt::format("zz_{}", i), rate * rate);
    const Ex spin = statements_.bind(fmt::format("zw_{}", i), rate * (w[2] + scene_.omega.own[i][2]));
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
    const Matrix3 U = acceleration_gradient(scene_.omega.parent[i], alpha, named("V", i), statements_);
    Ex along = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (direction[k].is_zero()) continue;
      const Ex pull = statements_.bind(
          fmt::format("{}{}", named("Qp", i), k),
          scene_.composites[i].moments.mass * a[k] + dot(U[k], scene_.composites[i].moments.first));
      along = along + direction[k] * pull;
    }
    return statements_.bind(named("Qp", i), along);
  }

  /// Δa on the composite body; returns Δa.
  Vector3 translate(std::size_t i, Wrench& relative) {
    const Vector3& w = scene_.omega.parent[i];
    const Ex rate = scene_.states[i].rate;
    const Ex twice = statements_.bind(fmt::format("z2_{}", i), 2 * rate);
    Vector3 change = scalar_acceleration(i) * scene_.frames.direction(i);
    if (scene_.tree.links[i].kind == LinkKind::kCurve) {
      const Ex square = statements_.bind(fmt::format("zz_{}", i), rate * rate);
      change = change + square * scene_.frames.curvature(i);
    }
    const Vector3 turned = statements_.bind(named("cd", i), cross(w, scene_.frames.direction(i)));
    Vector3 coriolis = statements_.bind(named("co", i), twice * turned + change);
    relative.force = relative.force + scene_.composites[i].moments.mass * coriolis;
    relative.moment = relative.moment + cross(scene_.composites[i].moments.first, coriolis);
    relative = {statements_.bind(named("df", i) + "t", relative.force),
                statements_.bind(named("dn", i) + "t", relative.moment)};
    return coriolis;
  }

  void slide(std::size_t i) {
    const Vector3 a = acceleration_[i];
    result_.from_parent[i] = {scene_.tree.links[i].sign *
                              parent_pull(i, scene_.frames.direction(i), alpha_[i], a)};
    acceleration_[i] = statements_.bind(named("a", i) + "c", a + translate(i, result_.relative[i]));
  }

  void screw(std::size_t i) {
    const Vector3 alpha = alpha_[i], a = acceleration_[i];
    turn(i);
    const Ex along = parent_pull(i, scene_.frames.direction(i), alpha, a);
    result_.from_parent[i][0] =
        statements_.bind(named("Qp", i) + "s", result_.from_parent[i][0] + scene_.tree.links[i].sign * along);
    acceleration_[i] = statements_.bind(named("a", i) + "c", a + translate(i, result_.relative[i]));
  }

  /// ΔU of a rotation with all components: force w (u·h) − (u·w) h, moment −w × S u, and those of dw/dt.
  void rotate(std::size_t i) {
    const Vector3 &w = scene_.states[i].spin, &w_p = scene_.omega.parent[i];
    const Vector3& h = scene_.composites[i].moments.first;
    const Matrix3& S = scene_.composites[i].moments.second;
    const Vector3 u = statements_.bind(named("u", i), w + Ex(2) * w_p);
    const Vector3 Su = statements_.bind(named("Su", i), S * u);
    const Ex uh = statements_.bind(named("uh", i), dot(u, h));
    const Ex uw = statements_.bind(named("uw", i), dot(u, w));
    const Wrench accelerated =
        momentum(scene_.composites[i], {accelerations_.spin[i], kinematics::zero_vector()});
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
    const Vector3& w = scene_.omega.parent[i];
    const Vector3& h = scene_.composites[i].moments.first;
    const Vector3 K = statements_.bind(named("K", i), scene_.composites[i].moments.second * w);
    const Wrench turned = momentum(scene_.composites[i], {alpha_[i], kinematics::zero_vector()});
    const Vector3 moment =
        statements_.bind(named("Qp", i), turned.moment + cross(K, w) + cross(h, acceleration_[i]));
    result_.from_parent[i] = {moment[0], moment[1], moment[2]};
    rotate(i);
  }

  void fly(std::size_t i) {
    result_.from_parent[i].assign(6, 0);
    rotate(i);
    const FreeAcceleration& own = *accelerations_.free[i];
    acceleration_[i] = own.linear;
    Wrench& relative = result_.relative[i];
    relative.force = statements_.bind(named("df", i) + "t",
                                      relative.force + scene_.composites[i].moments.mass * own.inside);
    relative.moment = statements_.bind(
        named("dn", i) + "t", relative.moment + cross(scene_.composites[i].moments.first, own.linear));
  }

  const Scene& scene_;
  const JointAccelerations& accelerations_;
  std::string name_;
  Statements& statements_;
  std::vector<Vector3> alpha_, acceleration_;  // of the link at its origin, in W
  InertiaForces result_;
};

}  // namespace

std::vector<std::vector<Ex>> derive_generalized_forces(const Scene& scene,
                                                       const JointAccelerations& accelerations,
                                                       const std::vector<Wrench>& applied,
                                                       const std::string& name) {
  const InertiaForces inertia = Recursion(scene, accelerations, name).derive();
  std::vector<Wrench> own = inertia.relative;
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i].force = scene.statements.bind(fmt::format("{}ef{}", name, i), own[i].force - applied[i].force);
    own[i].moment = scene.statements.bind(fmt::format("{}en{}", name, i), own[i].moment - applied[i].moment);
  }
  const std::vector<Wrench> totals = accumulate_wrenches(scene, own, name);
  std::vector<std::vector<Ex>> forces(own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
    for (std::size_t c = 0; c < scene.columns[i].size(); ++c)
      forces[i].push_back(
          scene.statements.bind(fmt::format("{}Q{}_{}", name, i, c),
                                power(totals[i], scene.columns[i][c].twist) + inertia.from_parent[i][c]));
  return forces;
}

std::vector<Wrench> derive_relative_inertia_forces(const Scene& scene,
                                                   const JointAccelerations& accelerations,
                                                   const std::string& name) {
  std::vector<Wrench> forces = Recursion(scene, accelerations, name).derive().relative;
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (const auto& free = accelerations.free[i]) {
      const Vector3 outside = scene.composites[i].moments.mass * (free->linear - free->inside);
      forces[i].force = scene.statements.bind(fmt::format("{}of{}", name, i), forces[i].force + outside);
    }
  return forces;
}

}  // namespace jourdain::dynamics
