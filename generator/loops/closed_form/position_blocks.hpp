// Solves blocks of dependent coordinates in closed form: intersections of circles, lines and spheres.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ir/program.hpp"
#include "loops/record/closed_form.hpp"

namespace jourdain::loops {

/// A part of g(y, t) = 0 that determines some coordinates once those of earlier blocks are known.
struct PositionBlock {
  std::vector<std::size_t> rows;             ///< of g
  std::vector<std::size_t> dependents;       ///< entries of y, scalar coordinates
  std::optional<std::size_t> rotation = {};  ///< entry of y of the w of a quaternion, for three of the rows
};

/// Rows and columns of a Jacobian in an order of elimination.
struct Elimination {
  std::vector<std::size_t> rows, columns;
};

/// Rows of G without a position form, and the velocities that they determine.
struct VelocityBlock {
  std::vector<std::size_t> rows, dependents;
  std::string names;  ///< of the dependents
};

struct ClosedFormRequest {
  ir::Program g;  ///< outputs ("g", row); leaves: positions, time and parameters
  std::vector<PositionBlock> blocks;
  std::vector<double> initial_y;  ///< where g = 0 at t = 0: selects one of the two solutions of each block
  std::vector<double> parameters;
  std::vector<bool> angular;                                ///< by entry of y
  std::vector<std::optional<std::array<double, 2>>> range;  ///< by entry of y: what it stays within
  std::vector<std::string> names;                           ///< by entry of y, for messages; or empty
  std::vector<std::optional<std::array<double, 2>>> parameter_range =
      {};  ///< none, or empty: as in `parameters`
  std::vector<std::string> parameter_names = {};
  ir::Program spans = {};     ///< as in ConstraintPrograms; of no row: rods are seen as other rows
  ir::Program jacobian = {};  ///< outputs ("G", row, column)
  std::vector<Elimination> eliminations = {};  ///< whose pivots are to be proven
  std::vector<VelocityBlock> velocities = {};  ///< whose determinants must not vanish
  double nothing = 1e-45;  ///< of a row's largest coefficient, computed with 60 digits: smaller ones are zero
};

/// Solves blocks of one coordinate (linear, or α cos + β sin = γ) and of two: two angles of which the rows are
/// k + A e_a + B e_b or k + R(a) (u + R(b) w), an angle and a slide of which they are k + A e_a + v s or k +
/// R(a) (u + v s), two slides; three slides between three spheres; a rotation in space with at most one
/// coordinate (see solve_rotation). e is (cos, sin); rows may be combined by any regular matrix that the
/// unknowns do not change. Every root is proven to stay off zero over the range of the independent coordinates
/// that matter: an angle without range may take any value; so are the determinants of `velocities`, as shares of those
/// at the start. Otherwise the reason, a phrase for the user.
std::variant<ClosedForm, std::string> closed_form(const ClosedFormRequest& request);

}  // namespace jourdain::loops
