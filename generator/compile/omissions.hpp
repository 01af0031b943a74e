// What an emitted model does not contain because its scene does not need it, and what that saved.
#pragma once

#include <vector>

#include "compile/compile.hpp"

namespace jourdain {

/// Each saving is counted: the operations of forward_dynamics with the simplification off minus those with all on.
/// `equations` are the mechanism's with `options.derivation`.
std::vector<Omission> find_omissions(const model::Mechanism& mechanism, const CompileOptions& options,
                                     const dynamics::Equations& equations, const CompiledModel& compiled);

}  // namespace jourdain
