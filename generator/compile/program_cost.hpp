// What one call of a program costs, sines and cosines included: by it ways to derive the same function are compared.
#pragma once

#include <cstddef>

#include "ir/module.hpp"

namespace jourdain {

/// Scenes of more velocities do not go by angles between links: there are as many as pairs of links.
inline constexpr std::size_t kMostLinkEquations = 12;

struct ProgramCost {
  /// Sine and cosine of one angle take about as long as that many operations (of Panda's accelerations: seven
  /// angles at once 15 ns, a thousand operations 140 ns).
  static constexpr std::size_t kAngle = 12;

  std::size_t arithmetic = 0;
  std::size_t angles = 0;  ///< of which a sine or a cosine is taken

  std::size_t total() const { return arithmetic + kAngle * angles; }
  /// Is it cheaper without taking more arithmetic?
  bool saves_on(const ProgramCost& other) const {
    return arithmetic <= other.arithmetic && total() < other.total();
  }
};

ProgramCost cost_of(const ir::Program& program);

/// Behind all passes but dear ones; a large program goes through them once. What depends on parameters alone costs
/// nothing.
ProgramCost cost_behind_passes(ir::Program program);

}  // namespace jourdain
