// Structs of the emitted header that depend on the scene: outputs, linearisation.
#pragma once

#include <string>
#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit::cpp {

/// Empty where the model asks for no outputs.
std::string output_struct(const ModelText& model);

/// Members of State that tell how its loops were closed; none without loops.
std::string guard_members(const ModelText& model);

/// Constants of Model that limit them.
std::string guard_limits(const ModelText& model);

/// Functions of Model that judge a State by them, and Parameters by what is proven.
std::string guard_functions(const ModelText& model);

bool linearizes(const std::vector<programs::FunctionInfo>& functions);

/// Empty where no function fills one.
std::string linearization_struct(const std::vector<programs::FunctionInfo>& functions,
                                 const programs::SceneFacts& scene);

}  // namespace jourdain::emit::cpp
