#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <filesystem>
#include <memory>

#include "commands/commands.hpp"
#include "commands/dependencies.hpp"
#include "commands/emission.hpp"
#include "commands/load.hpp"
#include "commands/output_guard.hpp"
#include "commands/report_text.hpp"

namespace jourdain::commands {

namespace {

struct CompileArguments {
  ModelArguments model;
  EmissionArguments emission;
  std::string folder;
  std::string depfile;  ///< of a build system; empty: none
  bool explain = false;
  std::string dump;  ///< pass whose programs are printed, or kAllPasses; empty: none
};

constexpr const char* kLowered = "lower";
constexpr const char* kAllPasses = "all";

std::string check_pass(const std::string& pass) {
  std::vector<std::string> known = passes::pass_names();
  known.insert(known.begin(), {kAllPasses, kLowered});
  if (std::find(known.begin(), known.end(), pass) != known.end()) return "";
  return fmt::format("no pass '{}'; there are {}", pass, fmt::join(known, ", "));
}

int run(const CompileArguments& arguments, const CLI::App& command) {
  std::optional<LoadedMechanism> loaded = load(arguments.model, External::kCalled);
  if (!loaded) return kModelWrong;
  std::string wrong = arguments.emission.apply(*loaded);
  if (wrong.empty()) wrong = arguments.emission.tell_absent_functions(*loaded);
  if (!wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  if (!are_outputs_apart({arguments.depfile}, loaded->sources)) return kUsage;
  loaded->options.words = emission_words(command);
  if (!arguments.dump.empty())
    loaded->options.watch = [&](const passes::PassRecord& pass, const ir::Module& module) {
      if (arguments.dump == kAllPasses || arguments.dump == pass.name)
        fmt::print("{}", programs_text(pass, module));
    };
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  tell_float_misfit(compiled);
  std::vector<std::string> outputs = paths_in(arguments.folder, compiled.files);
  outputs.push_back(arguments.depfile);
  if (!are_outputs_apart(outputs, loaded->sources)) return kUsage;
  support::write_files(arguments.folder, compiled.files);
  std::vector<std::string> written;
  for (const emit::File& file : compiled.files)
    written.push_back((std::filesystem::path(arguments.folder) / file.name).generic_string());
  if (!arguments.depfile.empty())
    support::write_file(arguments.depfile, dependency_rule(written, loaded->sources));
  fmt::print("{}: {}\n", loaded->options.name, freedom_text(*loaded));
  for (const std::string& path : written) fmt::print("  wrote {}\n", path);
  fmt::print("{}{}{}", operations_table(compiled.module), verdict_text(compiled.verdict),
             readback_text(compiled.readback));
  if (arguments.explain)
    fmt::print("{}{}{}{}", oracles_text(compiled.verdict), passes_text(compiled.passes),
               lanes_text(compiled.module), omissions_text(compiled.omissions));
  return kSuccess;
}

}  // namespace

void add_compile(CLI::App& app, int& status) {
  auto arguments = std::make_shared<CompileArguments>();
  CLI::App* command =
      app.add_subcommand("compile", "emit C++ or C for a model: jourdain compile arm.toml -o src/arm");
  arguments->model.add_to(*command);
  command->add_option("-o,--output", arguments->folder, "folder to write into")->required();
  arguments->emission.add_to(*command);
  command->add_option("--depfile", arguments->depfile,
                      "write a rule for make or Ninja: what the files are made from, imports too");
  command->add_flag("--explain", arguments->explain,
                    "print what was compared with what, what each pass did and what was left out");
  command
      ->add_flag(
          fmt::format("--dump-ir{{{}}}", kAllPasses), arguments->dump,
          fmt::format("print programs, operations and time after each pass; --dump-ir=PASS: after that "
                      "one of {}, {}",
                      kLowered, fmt::join(passes::pass_names(), ", ")))
      ->check(check_pass);
  command->callback([arguments, command, &status] { status = run(*arguments, *command); });
}

}  // namespace jourdain::commands
