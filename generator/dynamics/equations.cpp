#include "dynamics/equations.hpp"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>

#include "dynamics/absolute_rates.hpp"
#include "dynamics/accelerations.hpp"
#include "dynamics/applied_forces.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/free_root.hpp"
#include "dynamics/initial_state.hpp"
#include "dynamics/joint_equations.hpp"
#include "dynamics/kinematic_functions.hpp"
#include "dynamics/link_forces.hpp"
#include "dynamics/loop_forces.hpp"
#include "dynamics/outputs.hpp"
#include "dynamics/scene.hpp"
#include "dynamics/solver.hpp"
#include "dynamics/wrenches.hpp"
#include "model/motion_sources.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;

namespace {

/// The derivation of one tree.
class Derivation {
 public:
  Derivation(const model::Mechanism& mechanism, const DerivationOptions& options)
      : mechanism_(mechanism),
        options_(options),
        scene_(mechanism, options.link_tree, equations_.statements),
        statements_(scene_.statements),
        count_(scene_.layout.velocity_count()) {}

  Equations derive() {
    const ClosureRates rates = options_.for_derivatives ? ClosureRates::kGiven : ClosureRates::kNone;
    if (options_.closures_only) {
      derive_closures(rates);
      return std::move(equations_);
    }
    const AppliedForces applied = derive_applied_forces(scene_, Inputs::kGiven);
    if (options_.forces_only) {
      derive_forces(applied);
      return std::move(equations_);
    }
    equations_.ydot = position_rate();
    derive_forces(applied);
    if (mechanism_.loops.empty()) equations_.zdot = with_states(accelerations(applied), applied);
    if (options_.for_derivatives) {
      equations_.residual = with_state_balance(inverse_dynamics("r", applied, false), applied);
      equations_.load = with_states(load(applied), applied, -1);
    }
    equations_.potential_energy = derive_potential_energy(scene_);
    derive_samples();
    derive_initial_state(scene_, equations_);
    for (const model::Output& output : mechanism_.outputs) equations_.output_names.push_back(output.name);
    derive_closures(rates);
    equations_.outputs_take_leaves = options_.for_derivatives || !mechanism_.loops.empty();
    if (equations_.outputs_take_leaves)
      equations_.outputs = derive_outputs(scene_, equations_, scene_.leaves.zdot,
                                          with_loop_forces(scene_, applied, equations_.closures));
    else
      equations_.outputs = derive_outputs(scene_, equations_, equations_.zdot, applied);
    equations_.kinematics = derive_kinematic_functions(scene_, [this] { return gravity_forces(); });
    return std::move(equations_);
  }

  const Equations& derive_accelerations(const DerivationOptions& options) {
    if (!applied_) {
      applied_ = derive_applied_forces(scene_, Inputs::kGiven);
      common_statements_ = statements_.all().size();
    }
    statements_.rewind(common_statements_);
    options_ = options;
    equations_.zdot = with_states(accelerations(*applied_), *applied_);
    return equations_;
  }

 private:
  static std::string named(const char* quantity, std::size_t i, std::size_t j) {
    return fmt::format("{}_{}_{}", quantity, i, j);
  }

  /// Z z; quaternions q̇ = ½ q ⊗ (0, ω).
  std::vector<Ex> position_rate() {
    if (scene_.layout.quaternions.empty() && scene_.layout.state_count == 0) return {};
    std::vector<Ex> ydot(scene_.layout.position_count());
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      const Link& link = scene_.tree.links[i];
      const kinematics::LinkState& state = scene_.states[i];
      const model::JointEntries& entries = scene_.layout.joints[link.joint.value];
      if (!link.has_quaternion()) {
        if (state.entry) ydot[*entries.position[link.coordinate]] = link.sign * state.rate;
        continue;
      }
      // A quaternion comes last; before that of a free link is the child's origin.
      const std::size_t first = entries.first_position + entries.position_count - 4;
      for (std::size_t k = 0; entries.first_position + k < first; ++k)
        ydot[entries.first_position + k] = state.velocity[k];
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

  void derive_closures(ClosureRates rates) {
    equations_.closures = derive_closure(scene_, rates);
    if (mechanism_.loops.empty()) return;
    std::set<std::size_t> leading;
    for (const model::Joint& joint : mechanism_.joints)
      for (const model::Coordinate& coordinate : joint.coordinates) {
        if (!coordinate.motion) continue;
        model::MotionSources sources = model::motion_sources(mechanism_, *coordinate.motion);
        leading.merge(sources.first);
        leading.merge(sources.second);
      }
    for (const std::size_t i : leading)
      equations_.leading.push_back(
          {scene_.layout.first_state() + i, general_value(scene_, mechanism_.states[i].name + "_rate",
                                                          mechanism_.states[i].rate, Inputs::kGiven)});
  }

  void derive_samples() {
    for (std::size_t i = 0; i < mechanism_.states.size(); ++i)
      if (const model::StateVariable& state = mechanism_.states[i]; state.sampled)
        equations_.samples.push_back(
            {scene_.layout.first_state() + i,
             general_value(scene_, state.name + "_sampled", *state.sampled, Inputs::kGiven)});
  }

  void derive_forces(const AppliedForces& applied) {
    const FromLinkEquations& from_links = options_.from_links;
    equations_.M = with_state_rows(
        with_rotors(from_links.mass_matrix && links() ? joint_mass_matrix(scene_, *links()) : mass_matrix()));
    equations_.k_bar = k_bar();
    equations_.k_bar.resize(count_, 0);
    equations_.q_bar = with_states(q_bar(applied), applied, -1);
    const AppliedForces passive = derive_applied_forces(scene_, Inputs::kZero);
    equations_.tau = with_state_balance(from_links.tau && links()
                                            ? with_rotors(link_inverse_dynamics(scene_, *links(), passive))
                                            : inverse_dynamics("a", passive, options_.tau_by_links),
                                        passive);
    equations_.kinetic_energy = from_links.kinetic_energy && links() ? link_kinetic_energy(scene_, *links())
                                                                     : derive_kinetic_energy(scene_);
  }

  /// The entries of states are their rates, times `factor`.
  std::vector<Ex> with_states(std::vector<Ex> rows, const AppliedForces& applied, int factor = 1) const {
    rows.resize(count_);
    for (std::size_t i = 0; i < applied.on_states.size(); ++i)
      rows[scene_.layout.first_state() + i] = factor * applied.on_states[i];
    return rows;
  }

  /// The entries of states are ẋ less their rates.
  std::vector<Ex> with_state_balance(std::vector<Ex> rows, const AppliedForces& applied) const {
    rows = with_states(std::move(rows), applied, -1);
    for (std::size_t e = scene_.layout.first_state(); e < count_; ++e)
      rows[e] = statements_.bind(fmt::format("balance_{}", e), scene_.leaves.zdot[e] + rows[e]);
    return rows;
  }

  std::vector<std::vector<Ex>> with_state_rows(std::vector<std::vector<Ex>> M) const {
    M.resize(count_);
    for (std::vector<Ex>& row : M) row.resize(count_, 0);
    for (std::size_t e = scene_.layout.first_state(); e < count_; ++e) M[e][e] = 1;
    return M;
  }

  /// The equations of links, where the scene has them.
  const std::optional<LinkEquations>& links() {
    if (!links_ && has_link_equations(scene_)) links_ = derive_link_equations(scene_, RowScale::kNone);
    return links_;
  }

  /// Momentum of the composite body of each column, and its power on the columns inward of it; v of a free link is in
  /// the inertial frame. Both triangles are filled.
  std::vector<std::vector<Ex>> mass_matrix() {
    std::vector<std::vector<Ex>> M(count_, std::vector<Ex>(count_, 0));
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      for (const Column& column : scene_.columns[i]) {
        if (!column.entry) continue;
        Wrench moving = momentum(scene_.composites[i], column.twist);
        moving.force = statements_.bind(named("pf", i, *column.entry), moving.force);
        moving.moment = statements_.bind(named("pn", i, *column.entry), moving.moment);
        for (std::size_t j = i; j != kGround; j = scene_.tree.links[j].parent) {
          const std::string name = named("p", *column.entry, j);
          const Wrench seen = to_external(scene_, j, moving, name);
          for (const Column& row : scene_.columns[j])
            if (row.entry && *row.entry <= *column.entry)
              M[*row.entry][*column.entry] = M[*column.entry][*row.entry] =
                  statements_.bind(named("M", *row.entry, *column.entry), power(seen, row.twist));
          if (scene_.tree.links[j].parent != kGround) moving = to_parent(scene_, j, moving, name);
        }
      }
    return with_free_blocks(scene_, std::move(M));
  }

  std::vector<std::vector<Ex>> with_rotors(std::vector<std::vector<Ex>> M) {
    for (const model::Actuator& actuator : mechanism_.actuators) {
      if (actuator.rotor_inertia.is_zero()) continue;
      const std::size_t e = *scene_.states[scene_.link_of(actuator.joint, actuator.coordinate)].entry;
      M[e][e] = statements_.bind(named("Mr", e, e), M[e][e] + reflected_inertia(scene_, actuator));
    }
    return M;
  }

  /// Along each column, by ż.
  std::vector<std::vector<Ex>> generalized(const std::vector<Ex>& zdot, Gravity gravity,
                                           const std::vector<Wrench>& applied, const std::string& name,
                                           bool by_links = false) {
    const JointAccelerations motion = joint_accelerations(scene_, zdot, gravity, name);
    if (by_links && has_forces_by_links(scene_)) return derive_forces_by_links(scene_, motion, applied, name);
    return derive_generalized_forces(scene_, motion, applied, name);
  }

  /// Rows per link and column as rows of z.
  std::vector<Ex> external_rows(const std::vector<std::vector<Ex>>& rows, const std::string& name) {
    std::vector<Ex> result(count_);
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      if (!scene_.states[i].entry) continue;
      const std::vector<Ex> row = to_external(scene_, i, rows[i], fmt::format("{}ext{}", name, i));
      for (std::size_t c = 0; c < row.size(); ++c) result[*scene_.states[i].entry + c] = row[c];
    }
    return result;
  }

  std::vector<Ex> k_bar() {
    if (options_.from_links.k_bar && links()) return joint_forces(scene_, links()->inertia, "lk");
    const std::vector<Ex> at_rest(count_, 0);
    const std::vector<Wrench> none(scene_.link_count());
    std::vector<Ex> k =
        external_rows(generalized(at_rest, Gravity::kNone, none, "k", options_.k_bar_by_links), "k");
    for (Ex& entry : k) entry = -entry;
    return k;
  }

  /// What the applied forces do along each column, in internal coordinates, without gravity.
  std::vector<std::vector<Ex>> pushes(const AppliedForces& applied, const std::string& name) {
    std::vector<std::vector<Ex>> rows = applied.along;
    const std::vector<Wrench> totals = accumulate_wrenches(scene_, applied.on_link, name + "load");
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
    return with_weights(external_rows(pushes(applied, "q"), "q"), "q");
  }

  /// q̄ of gravity alone.
  std::vector<Ex> gravity_forces() { return with_weights(std::vector<Ex>(count_, 0), "qg"); }

  /// Less the forces `q`.
  std::vector<Ex> with_weights(std::vector<Ex> q, const std::string& name) {
    if (options_.from_links.q_bar && links()) {
      const std::vector<Ex> weights = joint_forces(scene_, links()->weight_alone, "lg");
      for (std::size_t e = 0; e < weights.size(); ++e)
        q[e] = statements_.bind(fmt::format("{}_{}", name, e), -weights[e] - q[e]);
      return q;
    }
    std::vector<Vector3> gravity;
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      const Link& link = scene_.tree.links[i];
      const Vector3& outer = link.parent == kGround ? scene_.tree.gravity : gravity[link.parent];
      gravity.push_back(scene_.frames.from_parent(i, outer, fmt::format("g{}", i)));
      if (!scene_.states[i].entry) continue;
      const CompositeBody& body = scene_.composites[i];
      const Wrench weight{body.moments.mass * gravity[i], kinematics::cross(body.moments.first, gravity[i])};
      const Wrench seen = external_weight(scene_, i, weight);
      for (const Column& column : scene_.columns[i])
        q[*column.entry] = statements_.bind(fmt::format("{}_{}", name, *column.entry),
                                            -power(seen, column.twist) - q[*column.entry]);
    }
    return q;
  }

  /// M⁻¹ (k̄ − q̄), with gravity as an inertia force: that costs less than k̄ and q̄ apart. A free link is solved in
  /// its own axes, falling with gravity.
  std::vector<Ex> accelerations(const AppliedForces& applied) {
    if (options_.planar && options_.planar_form != PlanarForm::kWorkingFrames && has_link_equations(scene_)) {
      const bool unit = options_.planar_form == PlanarForm::kAnglesToUnitRows;
      return solve_link_equations(
          scene_, derive_link_equations(scene_, unit ? RowScale::kUnit : RowScale::kNone), applied);
    }
    if (options_.planar && moves_in_planes(scene_))
      return solve_planar_accelerations(scene_, planar_forces(scene_, applied));
    const std::vector<std::vector<Ex>> inertia =
        generalized({}, Gravity::kAsAcceleration, applied.on_link, "b");
    std::vector<Ex> b(count_);
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      for (std::size_t c = 0; c < scene_.columns[i].size(); ++c)
        if (const auto entry = scene_.columns[i][c].entry)
          b[*entry] = statements_.bind(fmt::format("b_{}", *entry), applied.along[i][c] - inertia[i][c]);
    ArticulatedLinks articulated = options_.articulated;
    articulated.resize(scene_.link_count());
    for (std::size_t i = 0; i < scene_.link_count(); ++i)
      articulated[i] = articulated[i] || is_free(scene_.tree.links[i]);
    return with_external_accelerations(scene_, solve_accelerations(scene_, articulated, b));
  }

  /// M ż − k̄ + q̄ with ż a leaf.
  std::vector<Ex> inverse_dynamics(const std::string& name, const AppliedForces& applied, bool by_links) {
    std::vector<std::vector<Ex>> rows =
        generalized(scene_.leaves.zdot, Gravity::kAsAcceleration, applied.on_link, name, by_links);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t c = 0; c < rows[i].size(); ++c)
        rows[i][c] = statements_.bind(named("tau", i, c), rows[i][c] - applied.along[i][c]);
    return with_rotors(with_falling_mass(scene_, external_rows(rows, name)));
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

  const model::Mechanism& mechanism_;
  DerivationOptions options_;
  Equations equations_;
  const Scene scene_;
  kinematics::Statements& statements_;
  std::size_t count_;
  std::optional<LinkEquations> links_;
  std::optional<AppliedForces> applied_;  ///< of all ways
  std::size_t common_statements_ = 0;
};

}  // namespace

Equations derive_equations(const model::Mechanism& mechanism, const DerivationOptions& options) {
  return Derivation(mechanism, options).derive();
}

struct AccelerationWays::Derived {
  std::function<const Equations&(const DerivationOptions&)> by;
};

AccelerationWays::AccelerationWays(const model::Mechanism& mechanism,
                                   const kinematics::LinkTreeOptions& links)
    : derived_(new Derived) {
  DerivationOptions options;
  options.link_tree = links;
  derived_->by = [derivation = std::make_shared<Derivation>(mechanism, options)](
                     const DerivationOptions& way) -> const Equations& {
    return derivation->derive_accelerations(way);
  };
}

AccelerationWays::~AccelerationWays() = default;

const Equations& AccelerationWays::by(const DerivationOptions& way) { return derived_->by(way); }

std::vector<Ex> sampled_values(const Equations& equations) {
  std::vector<Ex> values;
  for (const SampledState& state : equations.samples) values.push_back(state.value);
  return values;
}

}  // namespace jourdain::dynamics
