// Calls of functions that the user defines are read as what they call and with which arguments.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "model/read/read.hpp"
#include "readback/compiled_text.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

namespace jourdain::tests {
namespace {

CompiledText rig(const ir::TextChoices& choices) {
  const std::string path = std::string(JOURDAIN_SOURCE_DIR) + "/tests/data/external/rig.toml";
  support::Diagnostics diagnostics(path, support::read_file(path));
  model::ReadOptions read;
  read.external = true;
  const auto mechanism = model::read_mechanism(diagnostics, read);
  JD_CHECK(mechanism.has_value(), "{}", diagnostics.format());
  CompileOptions options;
  options.path = "rig.toml";
  options.choices = choices;
  options.functions = {"forward_dynamics", "linearize"};
  options.words = {"--functions=forward_dynamics,linearize"};
  CompiledText text = {compile(*mechanism, options)};
  JD_CHECK(text.compiled.verdict.accepted(), "{}", text.compiled.verdict.failures.front());
  return text;
}

/// In each place of the file where `from` stands, one at a time. There must be `least`.
void expect_seen(const CompiledText& text, const std::string& name, const std::string& from,
                 const std::string& to, int least = 1) {
  for (std::size_t f = 0; f < text.compiled.files.size(); ++f) {
    if (text.compiled.files[f].name != name) continue;
    int count = 0;
    const std::string original = text.compiled.files[f].text;
    for (std::size_t at = original.find(from); at != std::string::npos;
         at = original.find(from, at + 1), ++count) {
      auto files = text.compiled.files;
      files[f].text.replace(at, from.size(), to);
      EXPECT_FALSE(text.differences(files).empty()) << name << ": " << from << " -> " << to << " at " << at;
    }
    EXPECT_GE(count, least) << name << ": " << from;
  }
}

TEST(ExternalFunctionsText, IsReadCallByCallInCpp) {
  const CompiledText text = rig({});
  EXPECT_TRUE(text.differences(text.compiled.files).empty());
  const std::string kernels = "rig_kernels.hpp";
  expect_seen(text, kernels, "functions.grip(", "functions.hardening(");
  expect_seen(text, kernels, "functions.grip_slip(", "functions.grip_load(");
  expect_seen(text, kernels, "functions.hardening(", "functions.hardening_x(");
  expect_seen(text, kernels, "functions.cam_angle(", "functions.cam(");
  expect_seen(text, kernels, "functions.cam_angle_angle(", "functions.cam_angle(");
  expect_seen(text, kernels, "model.functions.grip(", "model.grip(");
  expect_seen(text, kernels, "grip(state.z[0]", "grip(state.z[1]");
  expect_seen(text, kernels, ", Real(0.4))", ", Real(0.5))");
  expect_seen(text, kernels, ", Real(0.4))", ")");
  expect_seen(text, "rig.hpp", "struct Functions;", "struct Function;");
  expect_seen(text, "rig.hpp", "using Functions = rig::Functions<Real>;", "");
  expect_seen(text, "rig.cpp", "rig_functions.hpp", "rig_function.hpp");
  expect_seen(text, "rig.json", R"({"name": "grip", "arguments": ["slip", "load", "width"]})",
              R"({"name": "grip", "arguments": ["load", "slip", "width"]})");
}

TEST(ExternalFunctionsText, IsReadCallByCallInC) {
  ir::TextChoices choices;
  choices.language = ir::Language::kC;
  const CompiledText text = rig(choices);
  EXPECT_TRUE(text.differences(text.compiled.files).empty());
  for (const auto& [source, header] : {std::pair{"rig.c", "rig.h"}, {"rig_f.c", "rig_f.h"}}) {
    expect_seen(text, source, "functions.grip(", "functions.hardening(");
    expect_seen(text, source, "functions.grip_slip(", "functions.grip_load(");
    expect_seen(text, source, "model->functions.context", "model->context");
    expect_seen(text, source, "model->functions.context, ", "");
    expect_seen(text, header, "(*grip)(void *context", "(*grip2)(void *context");
    const std::string real = source == std::string("rig.c") ? "double" : "float";
    expect_seen(text, header, ", " + real + " load", "");
    expect_seen(text, header, real + " slip, " + real + " load", real + " load, " + real + " slip");
    expect_seen(text, header, "functions functions;", "state functions;");
  }
}

}  // namespace
}  // namespace jourdain::tests
