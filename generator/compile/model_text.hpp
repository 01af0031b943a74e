// What the emitted files say of a model beside its programs, in words.
#pragma once

#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "emit/file_text.hpp"

namespace jourdain {

/// What is taken for granted, sentences; `compiled` as far as its programs.
std::vector<std::string> assumptions(const model::Mechanism& mechanism, const CompileOptions& options,
                                     const CompiledModel& compiled);

std::vector<std::string> left_out_sentences(const std::vector<Omission>& omissions);

/// What was compared with what, a sentence each; first how well.
std::vector<std::string> validation_sentences(const validate::Verdict& verdict);

/// All of it. `compiled` as far as its verdict.
emit::ModelText model_text(const model::Mechanism& mechanism, const CompileOptions& options,
                           const CompiledModel& compiled);

}  // namespace jourdain
