// What the finished files must say, taken from the facts of the scene and the plan; not from what was handed
// to the emitter.
#pragma once

#include "compile/compile.hpp"
#include "readback/expected.hpp"

namespace jourdain {

/// Without the module.
readback::Expected expected_text(const model::Mechanism& mechanism, const CompileOptions& options,
                                 const CompiledModel& compiled);

}  // namespace jourdain
