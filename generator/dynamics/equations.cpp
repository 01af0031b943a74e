#include "dynamics/equations.hpp"

#include <fmt/format.h>

#include "dynamics/composite.hpp"
#include "dynamics/factorisation.hpp"
#include "dynamics/inertia_forces.hpp"
#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Leaf;
using kinematics::LeafKind;
using kinematics::Link;
using kinematics::LinkTree;
using kinematics::Statements;
using kinematics::WorkingFrames;

namespace {

std::vector<Ex> declare_parameters(const model::Mechanism& mechanism, Statements& statements) {
  std::vector<Ex> symbols;
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i)
    symbols.push_back(statements.leaf(LeafKind::kParameter, i, mechanism.parameters[i].name));
  return symbols;
}

std::vector<Ex> declare(LeafKind kind, const char* name, std::size_t count, Statements& statements) {
  std::vector<Ex> symbols;
  for (std::size_t i = 0; i < count; ++i)
    symbols.push_back(statements.leaf(kind, i, fmt::format("{}{}", name, i)));
  return symbols;
}

/// The derivation of one tree. Members are the stages' results, filled in by the constructor in order.
class Derivation {
 public:
  Derivation(const model::Mechanism& mechanism, const DerivationOptions& options)
      : mechanism_(mechanism),
        options_(options),
        joints_(model::moving_joints(mechanism)),
        parameters_(declare_parameters(mechanism, statements_)),
        y_(declare(LeafKind::kPosition, "y", joints_.size(), statements_)),
        z_(declare(LeafKind::kVelocity, "z", joints_.size(), statements_)),
        zdot_(declare(LeafKind::kAcceleration, "zdot", joints_.size(), statements_)),
        u_(declare(LeafKind::kInput, "u", mechanism.actuators.size(), statements_)),
        tree_(kinematics::build_link_tree(mechanism, parameters_, statements_, options.link_tree)),
        frames_(tree_, y_, statements_),
        composites_(derive_composites(tree_, frames_, statements_)) {}

  Equations derive() {
    Equations equations;
    for (std::size_t i = 0; i < count(); ++i) rate_.push_back(tree_.links[i].sign * z_[i]);
    omega_ = derive_angular_velocities(tree_, frames_, rate_, statements_);
    equations.M = mass_matrix();
    equations.k_bar = k_bar();
    equations.q_bar = q_bar();
    equations.zdot = accelerations(equations.M);
    equations.tau = inverse_dynamics();
    equations.kinetic_energy = kinetic_energy();
    equations.potential_energy = potential_energy();
    for (model::JointIndex index : joints_) {
      const model::Joint& joint = mechanism_.joints[index.value];
      equations.initial_position.push_back(bound("y_initial", joint.coordinates[0].initial_position));
      equations.initial_velocity.push_back(bound("z_initial", joint.coordinates[0].initial_velocity));
    }
    equations.statements = std::move(statements_);
    return equations;
  }

 private:
  std::size_t count() const { return tree_.links.size(); }

  Ex bound(const std::string& name, const model::Expression& expression) {
    return statements_.bind(name, kinematics::to_symbolic(expression, parameters_, statements_));
  }

  /// M_ji = (momentum of the composite body i per unit of ż_i) · (axis j), for each ancestor j of i.
  std::vector<std::vector<Ex>> mass_matrix() {
    std::vector<std::vector<Ex>> M(count(), std::vector<Ex>(count(), 0));
    for (std::size_t i = 0; i < count(); ++i) {
      Wrench momentum = unit_momentum(tree_.links[i], composites_[i]);
      for (std::size_t j = i;;) {
        const Ex component = tree_.links[j].revolute ? momentum.moment[2] : momentum.force[2];
        M[i][j] = M[j][i] = statements_.bind(fmt::format("M_{}_{}", j, i),
                                             tree_.links[i].sign * tree_.links[j].sign * component);
        if (tree_.links[j].parent == kGround) break;
        momentum = to_parent(tree_, frames_, j, momentum, fmt::format("p{}_{}", i, j), statements_);
        j = tree_.links[j].parent;
      }
    }
    return M;
  }

  /// Generalized inertia forces; gravity counts as one where `gravity` is set, ż where `accelerated`.
  std::vector<Ex> inertia_forces(const std::string& name, bool gravity, bool accelerated) {
    JointMotion motion;
    motion.rate = rate_;
    motion.ground_acceleration = gravity ? Ex(-1) * tree_.gravity : kinematics::zero_vector();
    for (std::size_t i = 0; i < count(); ++i)
      motion.acceleration.push_back(accelerated ? Ex(tree_.links[i].sign * zdot_[i]) : Ex(0));
    return derive_inertia_forces(tree_, frames_, composites_, omega_, motion, name, statements_);
  }

  /// Springs and dampers of the joints, as part of q̄.
  Ex joint_element(std::size_t i) {
    const model::Joint& joint = mechanism_.joints[joints_[i].value];
    const Ex stretch =
        statements_.bind(fmt::format("stretch{}", i), y_[i] - bound("rest", joint.coordinates[0].rest));
    const Ex stiffness = bound("stiffness", joint.coordinates[0].stiffness);
    const Ex damping = bound("damping", joint.coordinates[0].damping);
    return stiffness * stretch + damping * z_[i];
  }

  Ex input_sum(std::size_t i) {
    Ex sum = 0;
    for (std::size_t k = 0; k < u_.size(); ++k)
      if (mechanism_.actuators[k].joint == joints_[i]) sum = sum + u_[k];
    return sum;
  }

  std::vector<Ex> k_bar() {
    std::vector<Ex> k = inertia_forces("k", false, false);
    for (Ex& entry : k) entry = -entry;
    return k;
  }

  /// Gravity on composite bodies, springs, dampers and inputs.
  std::vector<Ex> q_bar() {
    std::vector<Vector3> gravity;
    std::vector<Ex> q;
    for (std::size_t i = 0; i < count(); ++i) {
      const Link& link = tree_.links[i];
      const Vector3& outer = link.parent == kGround ? tree_.gravity : gravity[link.parent];
      gravity.push_back(link.parent == kGround
                            ? statements_.bind(fmt::format("g{}", i), transpose(link.R_PL) * outer)
                            : frames_.from_parent(i, outer, fmt::format("g{}", i)));
      const Vector3 &h = composites_[i].moments.first, &g = gravity[i];
      const Ex pull = link.revolute ? Ex(h[0] * g[1] - h[1] * g[0]) : Ex(composites_[i].moments.mass * g[2]);
      q.push_back(
          statements_.bind(fmt::format("q_{}", i), -link.sign * pull + joint_element(i) - input_sum(i)));
    }
    return q;
  }

  /// M⁻¹ (k̄ − q̄), with gravity as an inertia force: that costs less than k̄ and q̄ apart.
  std::vector<Ex> accelerations(const std::vector<std::vector<Ex>>& M) {
    std::vector<Ex> b = inertia_forces("b", true, false);
    std::vector<std::size_t> parent;
    for (std::size_t i = 0; i < count(); ++i) {
      b[i] = statements_.bind(fmt::format("b_{}", i), input_sum(i) - joint_element(i) - b[i]);
      const std::size_t previous = i == 0 ? kGround : i - 1;
      parent.push_back(options_.branch_sparsity ? tree_.links[i].parent : previous);
    }
    return solve_mass_matrix(M, b, parent, statements_);
  }

  std::vector<Ex> inverse_dynamics() {
    std::vector<Ex> tau = inertia_forces("a", true, true);
    for (std::size_t i = 0; i < count(); ++i)
      tau[i] = statements_.bind(fmt::format("tau_{}", i), tau[i] + joint_element(i));
    return tau;
  }

  /// ½ ∫ |Σ v_i|² dm with v_i the velocity field of joint i on its composite body: each joint's own half square and
  /// its product with the velocity of the parent.
  Ex kinetic_energy() {
    std::vector<Vector3> velocity;  // of the link's origin, in W
    Ex energy = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      const Link& link = tree_.links[i];
      const std::string v = fmt::format("v{}", i);
      Vector3 origin = kinematics::zero_vector();
      if (link.parent != kGround) {
        const bool parallel = link.parallel;
        const Vector3 omega_P = parallel ? omega_.own[link.parent]
                                         : frames_.to_link(link.parent, omega_.own[link.parent], v + "w");
        const Vector3 velocity_P =
            parallel ? velocity[link.parent] : frames_.to_link(link.parent, velocity[link.parent], v + "p");
        origin = statements_.bind(v + "o", velocity_P + kinematics::cross(omega_P, frames_.offset(i)));
        if (!parallel) origin = statements_.bind(v, transpose(link.R_PL) * origin);
      }
      const Wrench momentum = unit_momentum(link, composites_[i]);
      const Ex own = (link.revolute ? momentum.moment[2] : momentum.force[2]) / 2 * rate_[i];
      const Ex with_parent =
          kinematics::dot(momentum.moment, omega_.parent[i]) + kinematics::dot(momentum.force, origin);
      energy =
          statements_.bind(fmt::format("T{}", i),
                           energy + rate_[i] * statements_.bind(fmt::format("P{}", i), own + with_parent));
      if (!link.revolute) origin[2] = statements_.bind(v + "_z", origin[2] + rate_[i]);
      velocity.push_back(origin);
    }
    return energy;
  }

  Ex potential_energy() {
    Vector3 first = tree_.ground.first;
    Ex springs = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      const Link& link = tree_.links[i];
      if (link.parent == kGround) {
        const kinematics::MassMoments& moments = composites_[i].moments;
        const std::string name = fmt::format("hg{}", i);
        first =
            statements_.bind(name, first + (link.R_PL * moments.first + moments.mass * frames_.offset(i)));
      }
      const model::Joint& joint = mechanism_.joints[joints_[i].value];
      const Ex stretch =
          statements_.bind(fmt::format("stretch{}", i), y_[i] - bound("rest", joint.coordinates[0].rest));
      springs = springs + bound("half_stiffness", joint.coordinates[0].stiffness) / 2 * stretch * stretch;
    }
    return statements_.bind("V", springs - kinematics::dot(tree_.gravity, first));
  }

  const model::Mechanism& mechanism_;
  DerivationOptions options_;
  std::vector<model::JointIndex> joints_;
  Statements statements_;
  std::vector<Ex> parameters_, y_, z_, zdot_, u_;
  LinkTree tree_;
  WorkingFrames frames_;
  std::vector<CompositeBody> composites_;
  std::vector<Ex> rate_;
  AngularVelocities omega_;
};

}  // namespace

Equations derive_equations(const model::Mechanism& mechanism, const DerivationOptions& options) {
  return Derivation(mechanism, options).derive();
}

}  // namespace jourdain::dynamics
