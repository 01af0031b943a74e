// What the finished files must say. Names, sizes and what follows from what are the facts of the scene, which the
// emitter has too (module_check.hpp compares outputs with what was derived); sentences and proofs come from the
// plan and the verdict, not from the emitter's text.
#pragma once

#include "compile/compile.hpp"
#include "readback/expected.hpp"

namespace jourdain {

/// Without the module.
readback::Expected expected_text(const model::Mechanism& mechanism, const CompileOptions& options,
                                 const CompiledModel& compiled);

}  // namespace jourdain
