#include "commands/build_model.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "emit/templates.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

namespace {

std::string shim(const std::string& name, const std::string& real, bool has_inputs) {
  return emit::fill(
      emit::template_text("shim.cpp.in"),
      {{"NAME", name},
       {"REAL", real},
       {"READ_INPUT",
        has_inputs ? "for (int i = 0; i < Model::input_count; ++i) input.u[i] = static_cast<Real>(u[i]);"
                   : "static_cast<void>(u);"}});
}

}  // namespace

studies::LoadedModel build_model(const std::string& name, const CompiledModel& compiled,
                                 const std::string& real) {
  const support::TemporaryFolder folder;
  const auto in_folder = [&folder](const std::string& file) { return folder.path() + "/" + file; };
  bool has_inputs = false;
  for (const emit::File& file : compiled.files) {
    support::write_file(in_folder(file.name), file.text);
    has_inputs = has_inputs || file.text.find("Real u[") != std::string::npos;
  }
  support::write_file(in_folder("model_table.h"), emit::template_text("model_table.h"));
  support::write_file(in_folder("shim.cpp"), shim(name, real, has_inputs));
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
