// The order in which the values of a program leave its graph of partial derivatives.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "ir/compose.hpp"
#include "ir/fingerprints.hpp"
#include "ir/fixed_values.hpp"

namespace jourdain::ir {

/// What the program is part of, so that an order of elimination is found that takes few operations there.
struct Surroundings {
  std::function<bool(LeafKind, std::size_t)> is_fixed = is_made_with_the_model;  ///< leaves
  LeafFingerprint leaf;             ///< of what stands for leaves
  std::vector<Fingerprint> values;  ///< of what is computed anyway
  bool is_thorough = false;         ///< orders are looked for longer, from several that begin differently
  /// This share of the program leaves operands first, then the others results first: nothing is looked for.
  std::optional<double> forward;
};

/// Within a program where what `leaf` gives stands for leaves.
Surroundings within(const Program& program, const LeafValue& leaf);

/// Whether values are taken where signs say so. Which factors stand inside such choices depends on the order, and with
/// it where derivatives have values (ir/jacobian.cpp): nothing but prefixes is tried then.
bool takes_by_signs(const Program& program);

/// The partial derivatives of a vertex by its operands.
using Partials = std::map<std::size_t, Signed>;

/// Of vertices 0 ... `inner` - 1, which are values of the program; the others are columns and rows. Partials are values
/// of the program, too.
std::vector<std::uint32_t> elimination_order(const Program& program, std::size_t inner,
                                             const std::vector<Partials>& operands,
                                             const Surroundings& surroundings);

}  // namespace jourdain::ir
