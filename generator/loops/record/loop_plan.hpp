// The record of what is decided offline about a mechanism's loops: where it starts, which coordinates are
// independent, how loops are closed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loops/record/closed_form.hpp"
#include "loops/record/regularity.hpp"
#include "model/mechanism.hpp"

namespace jourdain::loops {

/// Overconstrained mechanisms whose parts fit to this move, as those that are built do; m, rad.
inline constexpr double kAskew = 2e-3;

/// An initial value that closing the loops changed.
struct Moved {
  std::string coordinate;
  double from = 0, to = 0;  ///< rad, m; rad/s, m/s of a velocity
  bool velocity = false;
};

/// Rows that determine dependent velocities of the tree, once those of earlier blocks are known. Square.
struct Block {
  std::vector<std::size_t> rows, dependents;
  bool in_order = false;        ///< elimination in this order is proven to find no pivot that vanishes
  bool binds_positions = true;  ///< the rows have a position form; all of them or none
};

struct LoopPlan {
  model::LoopTreatment treatment = model::LoopTreatment::kMultipliers;
  bool is_named = false;               ///< the description asks for it, or names the independent coordinates
  std::string reason;                  ///< why not a treatment that comes before it; a phrase
  std::vector<double> y, z;            ///< where the mechanism starts, all coordinates of the tree
  std::vector<bool> kept_y, kept_z;    ///< of them those that start as the description says
  std::vector<Moved> moved;            ///< what closing the loops changed
  bool starts_beside = false;          ///< found from beside the initial positions, which are a dead point
  std::size_t freedom = 0;             ///< degrees of freedom
  std::vector<std::string> redundant;  ///< rows that follow from others, by name
  std::vector<std::size_t> rows;       ///< the others
  /// With multipliers: rows of which one counts, a different one here and there. Those of `rows` and others
  /// that are redundant; see SchurFactors. Empty where `rows` stay independent everywhere.
  std::vector<std::size_t> sharing;
  /// Redundant rows that disagree with the others by more than rounding, and by how much (m, rad) at worst, of
  /// the configurations seen: they stay open.
  std::vector<std::size_t> disagreeing;
  double disagreement = 0;
  double length_unit = 1;                ///< m, in which tolerances of lengths are measured: see Units
  std::vector<std::size_t> independent;  ///< velocities; empty with multipliers
  std::vector<Block> blocks;  ///< of the dependent ones, in the order of solution; empty with multipliers
  /// Smallest singular value of the dependent block over the largest of G, rows and columns scaled; the worst
  /// at the configurations seen. 0 is singular.
  double conditioning = 0;
  std::vector<double> row_length;  ///< m by row: what its multiplier is divided by to be a force
  /// Added to G M⁻¹ Gᵀ of rows with lengths, 1/kg, for accelerations and for what closes, and how often that
  /// is made good; see SchurFactors. Multipliers that were asked for are meant to pass singular
  /// configurations: there more bounds them.
  double regularisation = 0, closing_regularisation = 0;
  /// Weakest constraint that multipliers hold, as a share of the strongest: of singular values of G M⁻¹ Gᵀ, rows
  /// scaled, where it is largest. 1 where it was not looked at.
  double weakest = 1;
  /// A sentence where the rounding of float, as a share of the weakest constraint, leaves less than three digits.
  std::string weak_in_float() const;
  int corrections = 1;
  double determinant = 1;  ///< of what closing solves for, its largest at the configurations seen
  std::optional<ClosedForm> closed_form;  ///< of the dependent positions; kExplicit
  std::optional<RegularityProof> proof;   ///< of the dependent blocks; kPartitioned, none: not proven
  int iterations = 2;
  double stabilisation = 0;  ///< 1/s

  /// Dependent velocities of rows without a position form, in order: the positions are not closed, they move freely.
  std::vector<std::size_t> carried() const;
  /// Calls of close_loops where dependent positions were not integrated along.
  int closings() const { return treatment == model::LoopTreatment::kPartitioned ? 2 : 1; }
  /// For which positions and parameters the treatment is proven; none: not proven, or nothing to prove.
  const ProvenBox* proven() const { return closed_form ? &closed_form->box : proof ? &proof->box : nullptr; }
  /// Rows that multipliers are solved for, in order: `rows` and those that share.
  std::vector<std::size_t> solved_rows() const;
  /// How far rows that disagree may be open on the branch that is meant: a hundred times what was seen.
  double tolerated_disagreement() const { return 100 * disagreement; }
  /// By how much rows that follow from others may be open anywhere, m, rad.
  double most_left_open() const;
  bool is_reduced() const { return treatment != model::LoopTreatment::kMultipliers; }
  /// Below it a state's `regularity` says that what is solved for is singular, or nearly so. Multipliers that
  /// were asked for pass singular configurations straight on: 0.
  double least_regularity() const;
  /// Beyond it a state's `opening` says that closing may have left loops open by more than 1e-10 of the
  /// scene's length. Follows from the proof where there is one, is chosen otherwise.
  double greatest_opening() const;
};

/// "closure.a1_w" and so on, by row.
std::vector<std::string> row_names(const model::Mechanism& mechanism);

}  // namespace jourdain::loops
