// Bodies of functions as C.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emit/c/spelling.hpp"
#include "emit/model_code.hpp"

namespace jourdain::emit::c {

/// What the text may take for granted, whichever function it is of.
struct CContext {
  CNames names;
  std::map<std::string, const Function*> functions;  ///< of the model, by name
  std::map<std::string, const Function*> support;    ///< what the source alone uses; parts of functions too
  std::size_t ranges = 0;                            ///< entries of State's member `beyond`
  bool has_guards = false;                           ///< State tells how its loops were closed
};

/// Whether some argument may be a function that samples the inputs.
bool may_sample(const Function& function);

/// How a function gets its inputs: a struct that is held over the step, or a function and its context.
enum class CInputs { kHeld, kSampled };

/// "void panda_rk4_step(const panda_model *model, …)", broken to lines; `storage` is in front of it, e.g. "static ",
/// `closing` behind it: ";" or " {".
std::string c_signature(const CContext& context, const Function& function, CInputs inputs,
                        const std::string& name, const std::string& closing, const char* storage = "");

/// Declarations and statements, in this order, and the lines that mention parameters that are not used.
/// `of_model`: names that stand for members of what the parameter `model` points to.
std::string c_body(const CContext& context, const Function& function, CInputs inputs,
                   const std::vector<std::string>& of_model = {});

}  // namespace jourdain::emit::c
