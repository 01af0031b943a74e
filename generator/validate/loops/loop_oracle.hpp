// What the functions of a mechanism with loops should compute at one state: dense algebra on the symbolic
// equations of its tree and on its constraints, in 77 digits.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "loops/record/loop_plan.hpp"
#include "validate/loops/exact_state.hpp"

namespace jourdain::validate {

/// What oracles are made from; refers to it.
struct LoopScene {
  const model::Mechanism& mechanism;
  const dynamics::Equations& equations;  ///< of the tree
  const loops::LoopPlan& plan;
  const ExactClosure& closure;
};

/// z = B z_i + b and ż = B ż_i + β of the tree, with M, k̄, q̄, constraints and energies there.
struct ExactMotion {
  ExactMatrix M, B, G;
  ExactVector k, q, q_without_inputs, z, b, beta, g, rate, gamma;
  ScaledReal kinetic_energy, potential_energy;
};

ExactMotion exact_motion(const LoopScene& scene, const ir::LeafValues<ScaledReal>& state);

class LoopOracle {
 public:
  /// With reduced treatments the state must be closed.
  LoopOracle(const LoopScene& scene, const Point& point);

  /// For all functions but those that close loops.
  std::vector<Expected> operator()(const ir::Program& program) const;

  const ExactMotion& motion() const { return e_; }
  /// ż of the state's velocities.
  ExactVector accelerations() const;

 private:
  struct Constrained {
    ExactVector zdot, lambda;
  };
  Constrained constrained(const std::vector<std::size_t>& rows) const;

  /// S and c of S λ = c over some rows, and what they follow from.
  struct Schur {
    ExactMatrix back, S;  ///< M⁻¹ Gᵀ, G M⁻¹ Gᵀ
    ExactVector free, c;  ///< M⁻¹ (k̄ − q̄), G M⁻¹ (k̄ − q̄) + γ + 2 s ġ + s² g
  };
  Schur schur(const std::vector<std::size_t>& rows) const;

  /// A state beside which the multipliers of the rows that are solved for change as S λ = c does to first order: by
  /// what is missing in it, with the regularised inverse of S there.
  struct Beside {
    Schur schur;
    ExactVector lambda;
  };
  /// λ over all rows at accelerations of the tree.
  ExactVector multipliers(const ExactVector& zdot) const;
  ExactVector of_tree(const ExactVector& zdot) const { return e_.B * zdot + e_.beta; }
  ExactVector residual() const;
  std::vector<Expected> linearization() const;
  std::vector<Expected> kinematics(const ir::Program& program, std::size_t k) const;
  ExactMatrix inverse_inertia(const ExactMatrix& J) const;
  std::vector<ScaledReal> position_rate() const;
  std::vector<ScaledReal> outputs() const;
  std::vector<ScaledReal> samples() const;
  std::vector<ScaledReal> mass_entries(const ir::Program& program) const;
  std::vector<ScaledReal> start(const ir::Program& program) const;
  std::vector<ScaledReal> displacement_rate() const;
  /// How numbers change along the point's direction, by central differences; inputs and time too, or not.
  template <class Numbers>
  std::vector<ScaledReal> change(const Numbers& numbers, bool with_inputs_and_time,
                                 const Beside* beside = nullptr) const;
  /// That, or, as well, with multipliers that change to first order as S λ = c does.
  template <class Numbers>
  Expected change_of(const char* what, const Numbers& numbers, bool with_inputs_and_time) const;

  const LoopScene& scene_;
  const Point& point_;
  ExactMotion e_;
  const Beside* beside_ = nullptr;
};

}  // namespace jourdain::validate
