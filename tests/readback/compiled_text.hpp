// Models of models/ with their finished text and what it must say.
#pragma once

#include <string>
#include <vector>

#include "compile/compile.hpp"

namespace jourdain::tests {

/// A compiled model, which holds its files.
struct CompiledText {
  CompiledModel compiled;

  readback::Expected expected() const;
  /// What reading back finds in these files.
  std::vector<std::string> differences(const std::vector<emit::File>& files) const;
};

/// `functions`: none for those that are emitted unless told otherwise. Fails with JD_CHECK where the model is refused.
CompiledText compiled_text(const std::string& model, const std::vector<std::string>& functions = {},
                           const ir::TextChoices& choices = {});

/// The same of a scene's text.
CompiledText compiled_scene(const std::string& name, const std::string& scene,
                            const std::vector<std::string>& functions = {},
                            const ir::TextChoices& choices = {});

/// All functions, all steps.
std::vector<std::string> every_function();

}  // namespace jourdain::tests
