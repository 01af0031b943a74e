// M(y), k̄ and q̄ of a tree, symbolically: composite bodies inward, rates and gravity outward, wrenches inward.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/closure.hpp"
#include "kinematics/link_tree.hpp"
#include "kinematics/statements.hpp"
#include "model/mechanism.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;

/// How accelerations of links in planes are derived.
enum class PlanarForm {
  kWorkingFrames,    ///< solve_planar_accelerations
  kAngles,           ///< derive_link_equations
  kAnglesToUnitRows  ///< the same by RowScale::kUnit
};

/// Functions that are made from the equations of links (joint_equations.hpp) where the scene has those.
struct FromLinkEquations {
  bool mass_matrix = false, k_bar = false, q_bar = false, tau = false, kinetic_energy = false;
};

/// Simplifications that the derivation may use; each can be switched off to count what it saves.
struct DerivationOptions {
  kinematics::LinkTreeOptions link_tree;
  std::vector<bool> articulated;  ///< see ArticulatedLinks; empty: none but free links
  bool planar =
      false;  ///< accelerations of links instead of joints where the scene has them in `planar_form`
  PlanarForm planar_form = PlanarForm::kWorkingFrames;
  FromLinkEquations from_links;
  bool closures_only = false;  ///< nothing but the closures of loops
  bool forces_only = false;    ///< nothing but M, k_bar, q_bar, tau, kinetic_energy
  /// By derive_forces_by_links where no link is free, instead of derive_generalized_forces.
  bool k_bar_by_links = false, tau_by_links = false;
  bool for_derivatives = false;  ///< fills in residual, load, rates of closures; outputs take ż, λ
};

/// One requested output; entries are numbered row by row.
struct OutputValues {
  std::string member;  ///< of the output's struct ("position"), or empty where the output is a scalar
  int rows = 1, columns = 1;
  bool is_matrix = false;  ///< otherwise a vector or a scalar
  std::vector<Ex> values;
};

/// An array of a function of the kinematics: entries row by row.
struct KinematicValues {
  std::string name;
  int rows = 3;
  int columns = 0;  ///< 0: a vector
  std::vector<Ex> values;
};

/// What a state is in the step that begins; h is a leaf.
struct SampledState {
  std::size_t entry = 0;  ///< in z
  Ex value;
};

/// A state that motions follow, or their velocities.
struct LeadingState {
  std::size_t entry = 0;  ///< in z
  Ex rate;
};

/// The symbolic equations of motion M ż = k̄ − q̄ (signs as printed; generator/README.md) and what belongs to
/// them. Entries are numbers, leaves or names bound in `statements`. y and z as in model::CoordinateLayout; rows of
/// states are those of unit inertias, ẋ = −q̄, without kinetic energy.
struct Equations {
  kinematics::Statements statements;
  std::vector<Ex> ydot;            ///< Z z; empty where ẏ = z
  std::vector<std::vector<Ex>> M;  ///< nz × nz, full and symmetric; entries between different branches are 0
  std::vector<Ex> k_bar;           ///< Coriolis, centrifugal and rheonomic terms; no gravity
  std::vector<Ex> q_bar;           ///< applied forces; a force along z makes it negative
  std::vector<Ex> zdot;            ///< M⁻¹ (k̄ − q̄); none where there are loops
  std::vector<Ex> tau;             ///< M ż − k̄ + q̄ at u = 0, with ż a leaf (inverse dynamics)
  std::vector<Ex> residual;        ///< M ż − k̄ + q̄, with ż a leaf; only for derivatives
  std::vector<Ex> load;            ///< of q̄ all but gravity; only for derivatives
  std::vector<LoopClosure> closures;  ///< by loop
  std::vector<LeadingState> leading;  ///< where there are loops: g_t has a share of their rates
  Ex kinetic_energy;                  ///< J
  Ex potential_energy;                ///< J; gravity (zero at the inertial origin), springs, force elements
  std::vector<SampledState> samples;  ///< in the order of their entries
  std::vector<Ex> initial_position;
  std::vector<Ex> initial_velocity;
  std::vector<std::string> output_names;
  std::vector<std::vector<OutputValues>> outputs;        ///< for each output of the mechanism its members
  std::vector<std::vector<KinematicValues>> kinematics;  ///< for each function of the kinematics its arrays
  bool outputs_take_leaves = false;  ///< ż and λ of the outputs are leaves; otherwise ż is `zdot`
};

Equations derive_equations(const model::Mechanism& mechanism, const DerivationOptions& options = {});

/// Accelerations of a tree by one way after another; links, frames and applied forces are derived once.
class AccelerationWays {
 public:
  AccelerationWays(const model::Mechanism& mechanism, const kinematics::LinkTreeOptions& options);
  ~AccelerationWays();

  /// Nothing but zdot and its statements, until the next call. Options of the links are those of the first.
  const Equations& by(const DerivationOptions& options);

 private:
  struct Derived;
  std::unique_ptr<Derived> derived_;
};

/// The values of `samples`.
std::vector<Ex> sampled_values(const Equations& equations);

}  // namespace jourdain::dynamics
