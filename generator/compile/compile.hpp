// The whole compiler as one function: mechanism in, checked sources out.
#pragma once

#include <string>
#include <vector>

#include "compile/articulation.hpp"
#include "dynamics/equations.hpp"
#include "emit/file_text.hpp"
#include "loops/plan/plan.hpp"
#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "passes/pipeline.hpp"
#include "programs/derivatives.hpp"
#include "readback/readback.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "validate/translation.hpp"

namespace jourdain {

struct CompileOptions {
  ir::TextChoices choices;
  std::string name;  ///< namespace and file name; empty: made from the model's name
  std::vector<std::string> functions = programs::default_functions();
  dynamics::DerivationOptions derivation;
  programs::DerivativeTerms derivative_terms = programs::DerivativeTerms::kAll;
  std::vector<std::string> passes_off;  ///< names of passes to leave out
  passes::Watch watch;  ///< is shown the programs as lowered (pass "lower") and after each pass
  std::string path;     ///< of the description, as printed in the emitted files
  std::string sha256;   ///< of the description
  std::vector<support::FileHash>
      imported;  ///< files that it imports, each once, as printed in the emitted files
  std::vector<std::string>
      words;  ///< options of the command line that decide what is emitted, for the manifest
  std::optional<loops::LoopPlan> loops;  ///< of a mechanism with loops; none: planned by `compile`
  bool clock = false;                    ///< states hold the time though nothing depends on it
  bool damping = true;  ///< printed as an assumption when joint damping was switched off on reading

  programs::SceneWishes wishes() const {
    return {clock, derivative_terms == programs::DerivativeTerms::kAll};
  }
};

/// What one simplification saved, counted by switching it off.
struct Omission {
  std::string name;  ///< "base inertial parameters", "gravity", …
  std::string what;  ///< a sentence on what was left out here, and why
  long saved = 0;    ///< operations of forward_dynamics with it off minus with it on
};

struct CompiledModel {
  programs::SceneFacts facts;
  Articulation articulation;
  std::vector<programs::FunctionInfo> functions;
  ir::Module module;
  std::vector<passes::PassRecord> passes;
  std::vector<Omission> omissions;
  std::vector<std::string> assumptions;  ///< sentences, as printed in the emitted header
  validate::Verdict verdict;
  std::string float_misfit;       ///< a sentence on a number that float has no room for; empty: none is known
  std::string weak_in_float;      ///< likewise on constraints that float does not discern
  readback::Expected expected;    ///< of `files`, without the module, which is the one above
  readback::Record readback;      ///< what of `files` was read back and compared
  std::vector<emit::File> files;  ///< empty unless the verdict accepts
};

/// Joints that move no inertia become diagnostics (with loops plan_loops says so); call it before `compile`.
void check_inertia(const model::Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Derives, optimises, validates and emits. A rejected verdict leaves `files` empty. `mechanism` must have passed
/// check_mechanism and check_inertia.
CompiledModel compile(const model::Mechanism& mechanism, const CompileOptions& options);

/// The last stage of `compile`: validates `model.module` against the equations and the references and, if that
/// succeeds, fills in `model.files`, reads them back and compares them with what was validated; where that
/// fails they stay empty and `model.verdict` says why.
void validate_and_emit(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                       const CompileOptions& options, CompiledModel& model);

}  // namespace jourdain
