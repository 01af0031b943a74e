// What all readers do once a file is read: lock joints, note snapped rotations, check.
#pragma once

#include <optional>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Which parts of a file could be read; checks that need a missing part are left out, so that one mistake in
/// a file does not show up as several.
struct Completeness {
  bool structure = true;  ///< all bodies and joints, with their names and ends
  bool numbers = true;    ///< all masses, inertias and placements
};

/// Applies `options.locked_joints` and `options.snap` and checks what can be checked. Nothing is returned
/// when `diagnostics` has an error. `triangle`: see `check_mechanism`.
std::optional<Mechanism> finish_reading(Mechanism mechanism, const Completeness& complete,
                                        const ReadOptions& options, support::Severity triangle,
                                        support::Diagnostics& diagnostics);

}  // namespace jourdain::model
