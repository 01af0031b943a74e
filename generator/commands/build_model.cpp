#include "commands/build_model.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "emit/templates.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

namespace {

/// Arrays of length zero are no members of the emitted structs.
std::string shim(const std::string& name, const std::string& real, const CompiledModel& compiled) {
  const auto copy = [](std::size_t count, const char* line) { return std::string(count > 0 ? line : ""); };
  const emit::SceneShape& shape = compiled.shape;
  return emit::fill(
      emit::template_text("shim.cpp.in"),
      {{"NAME", name},
       {"REAL", real},
       {"READ_STATE", copy(shape.positions, "  to_model(state.y, y, Model::position_count);\n") +
                          copy(shape.velocities, "  to_model(state.z, z, Model::velocity_count);\n")},
       {"WRITE_STATE", copy(shape.positions, "  from_model(state.y, y, Model::position_count);\n") +
                           copy(shape.velocities, "  from_model(state.z, z, Model::velocity_count);\n")},
       {"READ_INPUT", copy(compiled.input_count, "  to_model(input.u, u, Model::input_count);\n")}});
}

}  // namespace

studies::LoadedModel build_model(const std::string& name, const CompiledModel& compiled,
                                 const std::string& real) {
  const support::TemporaryFolder folder;
  const auto in_folder = [&folder](const std::string& file) { return folder.path() + "/" + file; };
  for (const emit::File& file : compiled.files) support::write_file(in_folder(file.name), file.text);
  support::write_file(in_folder("model_table.h"), emit::template_text("model_table.h"));
  support::write_file(in_folder("shim.cpp"), shim(name, real, compiled));
  const char* chosen = std::getenv("CXX");
  const std::string compiler = chosen && *chosen ? chosen : "c++";
  const std::vector<std::string> command = {compiler,
                                            "-std=c++17",
                                            "-O2",
                                            "-fPIC",
                                            "-shared",
                                            in_folder("shim.cpp"),
                                            in_folder(name + ".cpp"),
                                            "-o",
                                            in_folder("model.so")};
  const support::ProcessResult result = support::run_process(command);
  if (result.status != 0)
    throw support::EnvironmentError(fmt::format("'{}' cannot compile the emitted code (exit status {}):\n{}",
                                                compiler, result.status, result.output.substr(0, 2000)));
  return studies::LoadedModel(in_folder("model.so"));
}

}  // namespace jourdain::commands
