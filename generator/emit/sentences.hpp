// What emitted headers say of structs and functions in words, in any language.
#pragma once

#include <string>
#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit {

/// What a State holds, and which of its positions depend on others.
std::vector<std::string> state_sentences(const ModelText& model);

/// Of a parameter: description, unit, range; may be empty. Printable ASCII.
std::string parameter_remark(const model::Parameter& parameter);

/// What a Linearization holds.
std::string linearization_sentence(const programs::SceneFacts& scene);

/// Of State's members that tell how its loops were closed, and of what judges them. `limits` is what stands in front of
/// the names of the limits, e.g. "Model::".
std::vector<std::string> regularity_sentences(const ModelText& model, const std::string& limits);
std::string opening_sentence(const ModelText& model, const std::string& limits);
std::string beyond_sentence(const ModelText& model);
std::string closed_sentence();
std::string proven_sentence();

/// "13 operations (7 mul, 6 add and sub, 0 div), 4 sin and cos."
std::string operations_sentence(const ir::Operations& count);

}  // namespace jourdain::emit
