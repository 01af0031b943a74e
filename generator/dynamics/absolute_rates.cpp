#include "dynamics/absolute_rates.hpp"

#include <fmt/format.h>

#include "dynamics/energy.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;
using kinematics::LinkTree;

bool moves_in_planes(const Scene& scene) {
  std::size_t beside = 0;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const Link& link = scene.tree.links[i];
    const bool is_beside = scene.tree.turns_beside_parent(i);
    const bool on_slides = link.parent == kGround || scene.tree.links[link.parent].kind == LinkKind::kSlide;
    const bool is_plain = link.kind == LinkKind::kTurn || link.kind == LinkKind::kSlide;
    if (!is_plain || !scene.states[i].entry || !(is_beside || on_slides)) return false;
    beside += is_beside;
  }
  return beside > 0;
}

namespace {

/// Inward sums of forces, and moments about each link's origin of its own body and of what its children pull with.
class PlanarForces {
 public:
  PlanarForces(const Scene& scene, const AppliedForces& applied)
      : scene_(scene), applied_(applied), total_(scene.link_count()), moment_(scene.link_count(), 0) {}

  std::vector<Ex> derive() {
    for (std::size_t i = 0; i < scene_.link_count(); ++i) accelerate(i);
    for (std::size_t i = scene_.link_count(); i-- > 0;) load(i);
    std::vector<Ex> u(scene_.layout.velocity_count());
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      const Link& link = scene_.tree.links[i];
      const Ex resisting =
          link.kind == LinkKind::kSlide ? dot(total_[i], scene_.frames.direction(i)) : moment_[i];
      u[*scene_.states[i].entry] = scene_.statements.bind(named("u", i), link.sign * (along(i) - resisting));
    }
    return u;
  }

 private:
  static std::string named(const char* quantity, std::size_t i) { return fmt::format("pl{}{}", quantity, i); }

  Vector3 from_parent(std::size_t i) const {
    const std::size_t p = scene_.tree.links[i].parent;
    return p == kGround ? Ex(-1) * scene_.tree.gravity : acceleration_[p];
  }

  /// What a link's turning does to a vector fixed to it, per rate squared.
  static Vector3 inward(const Ex& square, const Vector3& v) { return {-square * v[0], -square * v[1], 0}; }

  /// Of the link's origin, in W; gravity as that of the ground.
  void accelerate(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    const Ex& rate = scene_.omega.own[i][2];
    square_.push_back(link.kind == LinkKind::kTurn ? scene_.statements.bind(named("ww", i), rate * rate)
                                                   : Ex(0));
    Vector3 a = scene_.frames.from_parent(i, from_parent(i), named("g", i));
    if (scene_.tree.turns_beside_parent(i)) a = a + inward(square_[link.parent], scene_.frames.r_CW(i));
    acceleration_.push_back(scene_.statements.bind(named("a", i), a));
  }

  void load(std::size_t i) {
    const Link& link = scene_.tree.links[i];
    const Wrench& given = applied_.on_link[i];
    const Vector3 h = scene_.frames.to_working(i, link.moments.first, fmt::format("h{}b", i));
    total_[i] = scene_.statements.bind(named("f", i), total_[i] + link.moments.mass * acceleration_[i] +
                                                          inward(square_[i], h) - given.force);
    const Ex own = h[0] * acceleration_[i][1] - h[1] * acceleration_[i][0];
    moment_[i] = scene_.statements.bind(named("n", i), moment_[i] + (own - given.moment[2]));
    if (link.parent == kGround) return;
    const std::size_t p = link.parent;
    const Vector3 pull = scene_.frames.to_parent(i, total_[i], named("fp", i));
    total_[p] = scene_.statements.bind(named("fc", i), total_[p] + pull);
    if (!scene_.tree.turns_beside_parent(i)) return;
    const Vector3& r = scene_.frames.r_CW(i);
    moment_[p] = scene_.statements.bind(named("nc", i), moment_[p] + (r[0] * pull[1] - r[1] * pull[0]));
  }

  /// Joint forces, along z: that of a joint acts back on the parent.
  Ex along(std::size_t i) const {
    Ex sum = scene_.tree.links[i].sign * applied_.along[i][0];
    for (std::size_t c = i + 1; c < scene_.link_count(); ++c)
      if (scene_.tree.links[c].parent == i && scene_.tree.turns_beside_parent(c))
        sum = sum - scene_.tree.links[c].sign * applied_.along[c][0];
    return sum;
  }

  const Scene& scene_;
  const AppliedForces& applied_;
  std::vector<Ex> square_;
  std::vector<Vector3> acceleration_, total_;
  std::vector<Ex> moment_;
};

/// Of the rate of a link beside its parent and the parent's: 1, or −1 where their axes point against each other.
int relative_sign(const LinkTree& tree, std::size_t i) {
  return tree.links[i].sign * tree.links[tree.links[i].parent].sign;
}

}  // namespace

std::vector<Ex> planar_forces(const Scene& scene, const AppliedForces& applied) {
  return PlanarForces(scene, applied).derive();
}

void add_planar_rotors(const Scene& scene, std::vector<std::vector<Ex>>& M) {
  for (const model::Actuator& actuator : scene.mechanism.actuators) {
    if (actuator.rotor_inertia.is_zero()) continue;
    const std::size_t i = scene.link_of(actuator.joint, actuator.coordinate), e = *scene.states[i].entry;
    const Ex inertia = reflected_inertia(scene, actuator);
    const auto add = [&](std::size_t row, std::size_t column, const Ex& value) {
      M[row][column] =
          scene.statements.bind(fmt::format("Mr{}_{}_{}", e, row, column), M[row][column] + value);
    };
    add(e, e, inertia);
    if (!scene.tree.turns_beside_parent(i)) continue;
    const std::size_t p = *scene.states[scene.tree.links[i].parent].entry;
    add(p, p, inertia);
    add(e, p, -relative_sign(scene.tree, i) * inertia);
  }
}

std::vector<Ex> joint_rates_of(const Scene& scene, const std::vector<Ex>& x) {
  std::vector<Ex> zdot = x;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    if (!scene.tree.turns_beside_parent(i)) continue;
    const std::size_t e = *scene.states[i].entry, p = *scene.states[scene.tree.links[i].parent].entry;
    zdot[e] = scene.statements.bind(fmt::format("zdotr_{}", e), x[e] - relative_sign(scene.tree, i) * x[p]);
  }
  return zdot;
}

}  // namespace jourdain::dynamics
