// What is done once all files of a description are read: lock joints, snap rotations, check.
#pragma once

#include <optional>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Applies `options.locked_joints` and `options.snap` and checks what can be checked. Nothing is returned
/// when `diagnostics` has an error.
std::optional<Mechanism> finish_reading(Part part, const ReadOptions& options,
                                        support::Diagnostics& diagnostics);

}  // namespace jourdain::model
