#include "readback/compiled_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/read/read.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

namespace jourdain::tests {

readback::Expected CompiledText::expected() const {
  readback::Expected expected = compiled.expected;
  expected.module = &compiled.module;
  return expected;
}

std::vector<std::string> CompiledText::differences(const std::vector<emit::File>& files) const {
  return readback::differences(files, expected());
}

CompiledText compiled_text(const std::string& model, const std::vector<std::string>& functions,
                           const ir::TextChoices& choices) {
  const std::string path = std::string(JOURDAIN_SOURCE_DIR) + "/models/" + model + ".toml";
  return compiled_scene(model, support::read_file(path), functions, choices);
}

CompiledText compiled_scene(const std::string& name, const std::string& scene,
                            const std::vector<std::string>& functions, const ir::TextChoices& choices) {
  support::Diagnostics diagnostics(name + ".toml", scene);
  const auto mechanism = model::read_mechanism(diagnostics);
  JD_CHECK(mechanism.has_value(), "{}", diagnostics.format());
  CompileOptions options;
  options.path = name + ".toml";
  options.choices = choices;
  if (!functions.empty()) {
    options.functions = functions;
    options.words = {fmt::format("--functions={}", fmt::join(functions, ","))};
  }
  CompiledText text = {compile(*mechanism, options)};
  JD_CHECK(text.compiled.verdict.accepted(), "{}", text.compiled.verdict.failures.front());
  return text;
}

std::vector<std::string> every_function() { return programs::function_names(); }

}  // namespace jourdain::tests
