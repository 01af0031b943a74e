// M(y), k̄ and q̄ of a tree, symbolically: composite bodies inward, rates and gravity outward, wrenches inward.
#pragma once

#include <vector>

#include "kinematics/link_tree.hpp"
#include "kinematics/statements.hpp"
#include "model/mechanism.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;

/// Simplifications that the derivation may use; each can be switched off to count what it saves.
struct DerivationOptions {
  kinematics::LinkTreeOptions link_tree;
  bool branch_sparsity = true;  ///< factor M visiting ancestors only
};

/// The symbolic equations of motion M ż = k̄ − q̄ (design section 1; printed signs) and what belongs to them. Entries
/// are numbers, leaves or names bound in `statements`. nz = number of moving joints.
struct Equations {
  kinematics::Statements statements;
  std::vector<std::vector<Ex>> M;  ///< nz × nz, full and symmetric; entries between different branches are 0
  std::vector<Ex> k_bar;           ///< Coriolis and centrifugal terms; no gravity
  std::vector<Ex> q_bar;           ///< gravity, springs, dampers, inputs; a force along z makes it negative
  std::vector<Ex> zdot;            ///< M⁻¹ (k̄ − q̄)
  std::vector<Ex> tau;             ///< M ż − k̄ + q̄ at u = 0, with ż a leaf (inverse dynamics)
  Ex kinetic_energy;               ///< J
  Ex potential_energy;             ///< J; gravity (zero at the inertial origin) and joint springs
  std::vector<Ex> initial_position;  ///< rad or m
  std::vector<Ex> initial_velocity;
};

Equations derive_equations(const model::Mechanism& mechanism, const DerivationOptions& options = {});

}  // namespace jourdain::dynamics
