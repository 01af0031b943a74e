#include "dynamics/equations.hpp"

#include <fmt/format.h>

#include "dynamics/absolute_rates.hpp"
#include "dynamics/accelerations.hpp"
#include "dynamics/applied_forces.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/loop_forces.hpp"
#include "dynamics/outputs.hpp"
#include "dynamics/scene.hpp"
#include "dynamics/solver.hpp"
#include "model/joint_kinds.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkKind;

namespace {

using Matrix = std::vector<std::vector<Ex>>;

/// The derivation of one tree.
class Derivation {
 public:
  Derivation(const model::Mechanism& mechanism, const DerivationOptions& options)
      : mechanism_(mechanism),
        options_(options),
        scene_(mechanism, options.link_tree),
        statements_(scene_.statements),
        count_(scene_.layout.velocity_count()) {}

  Equations derive() {
    Equations equations;
    const ClosureRates rates = options_.for_derivatives ? ClosureRates::kGiven : ClosureRates::kNone;
    if (options_.closures_only) {
      equations.closures = derive_closure(scene_, rates);
      equations.statements = std::move(scene_.statements);
      return equations;
    }
    const AppliedForces applied = derive_applied_forces(scene_, Inputs::kGiven);
    if (options_.accelerations_only) {
      equations.zdot = accelerations(applied);
      equations.statements = std::move(scene_.statements);
      return equations;
    }
    equations.ydot = position_rate();
    equations.M = mass_matrix();
    equations.k_bar = k_bar();
    equations.q_bar = q_bar(applied);
    if (mechanism_.loops.empty()) equations.zdot = accelerations(applied);
    equations.tau = inverse_dynamics("a", derive_applied_forces(scene_, Inputs::kZero));
    if (options_.for_derivatives) {
      equations.residual = inverse_dynamics("r", applied);
      equations.load = load(applied);
    }
    equations.kinetic_energy = derive_kinetic_energy(scene_);
    equations.potential_energy = derive_potential_energy(scene_);
    set_initial_state(equations);
    for (const model::Output& output : mechanism_.outputs) equations.output_names.push_back(output.name);
    equations.closures = derive_closure(scene_, rates);
    equations.outputs_take_leaves = options_.for_derivatives || !mechanism_.loops.empty();
    if (equations.outputs_take_leaves)
      equations.outputs = derive_outputs(scene_, equations, scene_.leaves.zdot,
                                         with_loop_forces(scene_, applied, equations.closures));
    else
      equations.outputs = derive_outputs(scene_, equations, equations.zdot, applied);
    equations.statements = std::move(scene_.statements);
    return equations;
  }

 private:
  static std::string named(const char* quantity, std::size_t i, std::size_t j) {
    return fmt::format("{}_{}_{}", quantity, i, j);
  }

  /// Z z; quaternions q̇ = ½ q ⊗ (0, ω).
  std::vector<Ex> position_rate() {
    if (scene_.layout.quaternions.empty()) return {};
    std::vector<Ex> ydot(scene_.layout.position_count());
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      const Link& link = scene_.tree.links[i];
      const kinematics::LinkState& state = scene_.states[i];
      const model::JointEntries& entries = scene_.layout.joints[link.joint.value];
      if (!link.has_quaternion()) {
        if (state.entry) ydot[*entries.position[link.coordinate]] = link.sign * state.rate;
        continue;
      }
      const bool free = link.kind == LinkKind::kFree;
      for (std::size_t k = 0; free && k < 3; ++k) ydot[entries.first_position + k] = state.velocity[k];
      const std::size_t first = entries.first_position + (free ? 3 : 0);
      const auto& q = state.quaternion;
      Vector3 half;
      for (std::size_t k = 0; k < 3; ++k) half[k] = statements_.bind(named("half", i, k), state.spin[k] / 2);
      ydot[first] = -(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]);
      ydot[first + 1] = q[0] * half[0] + q[2] * half[2] - q[3] * half[1];
      ydot[first + 2] = q[0] * half[1] + q[3] * half[0] - q[1] * half[2];
      ydot[first + 3] = q[0] * half[2] + q[1] * half[1] - q[2] * half[0];
      for (std::size_t k = 0; k < 4; ++k)
        ydot[first + k] = statements_.bind(named("qdot", i, k), ydot[first + k]);
    }
    return ydot;
  }

  /// Momentum of the composite body of each column, and its power on the columns inward of it; v of a free link is in
  /// the inertial frame. Both triangles are filled.
  std::vector<std::vector<Ex>> mass_matrix() {
    Matrix M(count_, std::vector<Ex>(count_, 0));
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      for (const Column& column : scene_.columns[i]) {
        if (!column.entry) continue;
        Wrench moving = momentum(scene_.composites[i], column.twist);
        moving.force = statements_.bind(named("pf", i, *column.entry), moving.force);
        moving.moment = statements_.bind(named("pn", i, *column.entry), moving.moment);
        for (std::size_t j = i; j != kGround; j = scene_.tree.links[j].parent) {
          const std::string name = named("p", *column.entry, j);
          const bool free = scene_.tree.links[j].kind == LinkKind::kFree;
          const Wrench seen = free ? to_external(scene_, j, moving, name) : moving;
          for (const Column& row : scene_.columns[j])
            if (row.entry && *row.entry <= *column.entry)
              M[*row.entry][*column.entry] = M[*column.entry][*row.entry] =
                  statements_.bind(named("M", *row.entry, *column.entry), power(seen, row.twist));
          if (scene_.tree.links[j].parent != kGround)
            moving = to_parent(scene_.tree, scene_.frames, j, moving, name, statements_);
        }
      }
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      if (scene_.tree.links[i].kind == LinkKind::kFree) replace_free_block(M, i);
    for (const model::Actuator& actuator : mechanism_.actuators) {
      if (actuator.rotor_inertia.is_zero()) continue;
      const std::size_t e = *scene_.states[scene_.link_of(actuator.joint, actuator.coordinate)].entry;
      M[e][e] = statements_.bind(named("Mr", e, e), M[e][e] + reflected_inertia(scene_, actuator));
    }
    return M;
  }

  /// The block of a free link's own velocities: m 1, R (ω × h) with h from the child's origin, and J about that origin.
  void replace_free_block(Matrix& M, std::size_t i) {
    const std::size_t first = *scene_.states[i].entry;
    const CompositeBody& body = scene_.composites[i];
    const Vector3& d = scene_.tree.links[i].shift;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) M[first + r][first + c] = r == c ? body.moments.mass : Ex(0);
    for (std::size_t c = 0; c < 3; ++c) {
      Vector3 axis = kinematics::zero_vector();
      axis[c] = 1;
      const std::string name = named("pfree", i, c);
      const Wrench moving = momentum(body, {axis, kinematics::cross(axis, d)});
      const Wrench seen =
          to_external(scene_, i, {statements_.bind(name + "f", moving.force), moving.moment}, name);
      for (std::size_t r = 0; r < 3; ++r) {
        M[first + r][first + 3 + c] = M[first + 3 + c][first + r] = seen.force[r];
        if (r <= c) M[first + 3 + r][first + 3 + c] = M[first + 3 + c][first + 3 + r] = seen.moment[r];
      }
    }
  }

  InertiaForces inertia_forces(const std::string& name, const std::vector<Ex>& zdot, Gravity gravity) {
    return derive_inertia_forces(scene_.tree, scene_.frames, scene_.states, scene_.composites, scene_.omega,
                                 joint_accelerations(scene_, zdot, gravity, name), name, statements_);
  }

  std::vector<Wrench> no_wrenches() const { return std::vector<Wrench>(scene_.link_count()); }

  std::vector<std::vector<Ex>> generalized(const InertiaForces& inertia, const std::vector<Wrench>& applied,
                                           const std::string& name) {
    return derive_generalized_forces(scene_.tree, scene_.frames, scene_.columns, inertia, applied, name,
                                     statements_);
  }

  /// Rows per link and column as rows of z; those of free links in external coordinates.
  std::vector<Ex> external_rows(std::vector<std::vector<Ex>> rows, const std::string& name) {
    std::vector<Ex> result(count_);
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      if (!scene_.states[i].entry) continue;
      if (scene_.tree.links[i].kind == LinkKind::kFree) {
        const Wrench seen = to_external(
            scene_, i, {{rows[i][0], rows[i][1], rows[i][2]}, {rows[i][3], rows[i][4], rows[i][5]}},
            fmt::format("{}ext{}", name, i));
        for (std::size_t k = 0; k < 3; ++k) {
          rows[i][k] = seen.force[k];
          rows[i][k + 3] = seen.moment[k];
        }
      }
      for (std::size_t c = 0; c < rows[i].size(); ++c) result[*scene_.states[i].entry + c] = rows[i][c];
    }
    return result;
  }

  std::vector<Ex> k_bar() {
    std::vector<Ex> k = external_rows(
        generalized(inertia_forces("k", std::vector<Ex>(count_, 0), Gravity::kNone), no_wrenches(), "k"),
        "k");
    for (Ex& entry : k) entry = -entry;
    return k;
  }

  /// What the applied forces do along each column, in internal coordinates, without gravity.
  std::vector<std::vector<Ex>> pushes(const AppliedForces& applied, const std::string& name) {
    std::vector<std::vector<Ex>> rows = applied.along;
    const std::vector<Wrench> totals =
        accumulate_wrenches(scene_.tree, scene_.frames, applied.on_link, name + "load", statements_);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t c = 0; c < rows[i].size(); ++c)
        rows[i][c] =
            statements_.bind(named("load", i, c), rows[i][c] + power(totals[i], scene_.columns[i][c].twist));
    return rows;
  }

  /// q̄ without gravity.
  std::vector<Ex> load(const AppliedForces& applied) {
    std::vector<Ex> forces = external_rows(pushes(applied, "l"), "l");
    for (Ex& force : forces) force = -force;
    return forces;
  }

  std::vector<Ex> q_bar(const AppliedForces& applied) {
    std::vector<Ex> q = external_rows(pushes(applied, "q"), "q");
    std::vector<Vector3> gravity;
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      const Link& link = scene_.tree.links[i];
      const Vector3& outer = link.parent == kGround ? scene_.tree.gravity : gravity[link.parent];
      gravity.push_back(scene_.frames.from_parent(i, outer, fmt::format("g{}", i)));
      if (!scene_.states[i].entry) continue;
      const CompositeBody& body = scene_.composites[i];
      const Wrench weight{body.moments.mass * gravity[i], kinematics::cross(body.moments.first, gravity[i])};
      Wrench seen = weight;
      if (link.kind == LinkKind::kFree) {
        seen.force = body.moments.mass * scene_.tree.gravity;
        seen.moment = weight.moment + kinematics::cross(link.shift, weight.force);
      }
      for (const Column& column : scene_.columns[i])
        q[*column.entry] = statements_.bind(fmt::format("q_{}", *column.entry),
                                            -power(seen, column.twist) - q[*column.entry]);
    }
    return q;
  }

  /// M⁻¹ (k̄ − q̄), with gravity as an inertia force: that costs less than k̄ and q̄ apart. A free link is solved in
  /// its own axes, falling with gravity.
  std::vector<Ex> accelerations(const AppliedForces& applied) {
    if (options_.planar && moves_in_planes(scene_))
      return solve_planar_accelerations(scene_, planar_forces(scene_, applied));
    const std::vector<std::vector<Ex>> inertia =
        generalized(inertia_forces("b", {}, Gravity::kAsAcceleration), applied.on_link, "b");
    std::vector<Ex> b(count_);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      for (std::size_t c = 0; c < scene_.columns[i].size(); ++c)
        if (const auto entry = scene_.columns[i][c].entry)
          b[*entry] = statements_.bind(fmt::format("b_{}", *entry), applied.along[i][c] - inertia[i][c]);
    ArticulatedLinks articulated = options_.articulated;
    if (articulated.empty()) articulated.assign(scene_.link_count(), false);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      if (scene_.tree.links[i].kind == LinkKind::kFree) articulated[i] = true;
    std::vector<Ex> zdot = solve_accelerations(scene_, articulated, b);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      if (scene_.tree.links[i].kind == LinkKind::kFree) turn_free_acceleration(zdot, i);
    return zdot;
  }

  void turn_free_acceleration(std::vector<Ex>& zdot, std::size_t i) {
    const std::size_t first = *scene_.states[i].entry;
    const Vector3 spin = {zdot[first + 3], zdot[first + 4], zdot[first + 5]};
    const Vector3 at_origin =
        statements_.bind(fmt::format("ao{}", i), Vector3{zdot[first], zdot[first + 1], zdot[first + 2]} -
                                                     shift_acceleration(scene_, i, spin));
    const Vector3 turned = statements_.bind(fmt::format("vdot{}", i), scene_.frames.rotation(i) * at_origin);
    for (std::size_t k = 0; k < 3; ++k)
      zdot[first + k] =
          statements_.bind(fmt::format("zdot_{}", first + k), turned[k] + scene_.tree.gravity[k]);
  }

  /// M ż − k̄ + q̄ with ż a leaf.
  std::vector<Ex> inverse_dynamics(const std::string& name, const AppliedForces& applied) {
    std::vector<std::vector<Ex>> rows = generalized(
        inertia_forces(name, scene_.leaves.zdot, Gravity::kAsAcceleration), applied.on_link, name);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t c = 0; c < rows[i].size(); ++c)
        rows[i][c] = statements_.bind(named("tau", i, c), rows[i][c] - applied.along[i][c]);
    std::vector<Ex> tau = external_rows(rows, name);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      if (scene_.tree.links[i].kind == LinkKind::kFree) add_falling_mass(tau, i);
    return with_rotors(std::move(tau));
  }

  std::vector<Ex> with_rotors(std::vector<Ex> tau) {
    for (const model::Actuator& actuator : mechanism_.actuators) {
      if (actuator.rotor_inertia.is_zero()) continue;
      const std::size_t e = *scene_.states[scene_.link_of(actuator.joint, actuator.coordinate)].entry;
      tau[e] = statements_.bind(fmt::format("taur_{}", e),
                                tau[e] + reflected_inertia(scene_, actuator) * scene_.leaves.zdot[e]);
    }
    return tau;
  }

  /// m (v̇ − gravity) of everything that a free link carries, about the child's origin.
  void add_falling_mass(std::vector<Ex>& tau, std::size_t i) {
    const std::size_t first = *scene_.states[i].entry;
    const Ex& mass = scene_.composites[i].moments.mass;
    const Vector3 fall = falling(scene_, i, scene_.leaves.zdot, Gravity::kAsAcceleration);
    const Vector3 fall_W =
        statements_.bind(fmt::format("fallm{}", i), transpose(scene_.frames.rotation(i)) * fall);
    const Vector3 lever = kinematics::cross(mass * scene_.tree.links[i].shift, fall_W);
    for (std::size_t k = 0; k < 3; ++k) {
      tau[first + k] = statements_.bind(fmt::format("tauf{}", first + k), tau[first + k] + mass * fall[k]);
      tau[first + 3 + k] =
          statements_.bind(fmt::format("tauf{}", first + 3 + k), tau[first + 3 + k] + lever[k]);
    }
  }

  void set_initial_state(Equations& equations) {
    std::vector<Ex>&y = equations.initial_position, &z = equations.initial_velocity;
    const auto push = [&](std::vector<Ex>& list, const model::Expression& value) {
      list.push_back(scene_.value(&list == &y ? "y_initial" : "z_initial", value));
    };
    for (model::JointIndex index : model::moving_joints(mechanism_)) {
      const model::Joint& joint = mechanism_.joints[index.value];
      for (const model::Coordinate& coordinate : joint.coordinates) {
        if (coordinate.motion) continue;
        push(y, coordinate.initial_position);
        push(z, coordinate.initial_velocity);
      }
      if (model::joint_kind(joint).has_origin())
        for (std::size_t k = 0; k < 3; ++k) {
          push(y, joint.initial_origin[k]);
          push(z, joint.initial_origin_velocity[k]);
        }
      if (!model::joint_kind(joint).has_quaternion()) continue;
      for (const model::Expression& component : joint.initial_orientation) push(y, component);
      for (const model::Expression& component : joint.initial_spin) push(z, component);
    }
  }

  const model::Mechanism& mechanism_;
  DerivationOptions options_;
  Scene scene_;
  kinematics::Statements& statements_;
  std::size_t count_;
};

}  // namespace

Equations derive_equations(const model::Mechanism& mechanism, const DerivationOptions& options) {
  return Derivation(mechanism, options).derive();
}

}  // namespace jourdain::dynamics
