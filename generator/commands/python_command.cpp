// A model as a module of Python.
#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <memory>

#include "commands/commands.hpp"
#include "commands/content_hash.hpp"
#include "commands/emission.hpp"
#include "commands/kinematic_choice.hpp"
#include "commands/memory_checks.hpp"
#include "commands/method_names.hpp"
#include "commands/python_module.hpp"
#include "commands/python_names.hpp"
#include "commands/report_text.hpp"
#include "commands/shared_library.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

namespace {

using ir::FunctionId;
using support::FileText;

struct PythonArguments {
  ModelArguments model;
  std::string folder;
  std::vector<std::string> functions, frames;
  std::string compiler, flags = "-O2";
  bool libm = false;
};

/// All functions, every step of a cost that is easily compiled, and A, B, C, D where these are not long.
std::vector<std::string> usual_functions(const LoadedMechanism& loaded) {
  std::vector<std::string> functions = programs::default_functions();
  for (const programs::Stepper& stepper : programs::all_steppers())
    if (!stepper.implicit && check_multistep({stepper.name}, loaded.mechanism).empty())
      functions.push_back(stepper.name + "_step");
  if (loaded.velocity_count() <= kMostVelocities) functions.emplace_back(ir::name_of(FunctionId::kLinearize));
  return functions;
}

std::string choose(const PythonArguments& arguments, LoadedMechanism& loaded) {
  EmissionArguments emission;
  emission.functions = arguments.functions.empty() ? usual_functions(loaded) : arguments.functions;
  // The module asks whether a state closes its loops, and says how it is closed.
  for (const FunctionId id : {FunctionId::kCloseLoops, FunctionId::kProject, FunctionId::kConstraintResidual})
    emission.functions.emplace_back(ir::name_of(id));
  emission.frames = arguments.frames;
  emission.language = "c";
  emission.real = "double";
  emission.interface = emission.clock = true;
  emission.libm = arguments.libm;
  if (std::string wrong = wrong_module_name(loaded.options.name); !wrong.empty()) return wrong;
  return emission.apply(loaded);
}

/// The library, NAME.py and NAME.pyi, compiled where nobody sees it.
std::vector<FileText> module_files(const PythonArguments& arguments, const LoadedMechanism& loaded,
                                   const CompiledModel& compiled) {
  const CompileOptions& options = loaded.options;
  const std::string& name = options.name;
  const std::vector<std::string> compiler =
      arguments.compiler.empty() ? machine_c_compiler() : words_of(arguments.compiler);
  std::string all = arguments.flags + batch_text(options, compiled, "");
  for (const emit::File& file : compiled.files) all += file.text;
  const std::string build = sha256_of(all);
  const support::TemporaryFolder folder;
  std::vector<FileText> sources(compiled.files.begin(), compiled.files.end());
  sources.push_back({name + "_batch.c", batch_text(options, compiled, build)});
  support::write_files(folder.path(), sources);
  const std::string library = fmt::format("lib{}.so", name);
  build_shared_library(folder.path(), {name + ".c", name + "_interface.c", name + "_batch.c"}, library,
                       compiler, words_of(arguments.flags));
  return {{library, support::read_file(folder.path() + "/" + library)},
          {name + ".py", module_text(options, loaded.mechanism.name, build)},
          {name + ".pyi", stub_text(compiled, loaded.mechanism.name)}};
}

int run(const PythonArguments& arguments) {
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  if (const std::string wrong = choose(arguments, *loaded); !wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  support::check_writable(arguments.folder);
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  const std::vector<FileText> files = module_files(arguments, *loaded, compiled);
  support::write_files(arguments.folder, files);
  fmt::print("{}: {}\n", loaded->options.name, freedom_text(*loaded));
  for (const FileText& file : files) fmt::print("  wrote {}/{}\n", arguments.folder, file.name);
  fmt::print("{}{}{}", operations_table(compiled.module), verdict_text(compiled.verdict),
             readback_text(compiled.readback));
  return kSuccess;
}

}  // namespace

void add_python(CLI::App& app, int& status) {
  auto arguments = std::make_shared<PythonArguments>();
  CLI::App* command =
      app.add_subcommand("python", "write a module for Python and numpy: jourdain python arm.toml -o arm");
  arguments->model.add_to(*command);
  command->add_option("-o,--output", arguments->folder, "folder to write into")->required();
  command
      ->add_option(
          "--functions", arguments->functions,
          "functions to have (default: all, explicit steps, and linearize where the scene is not large)")
      ->delimiter(',');
  command->add_option("--frame", arguments->frames, kFrameHelp)->expected(1)->take_all();
  command->add_option("--compiler", arguments->compiler,
                      "compiler of C, with options (default: the environment variable CC, else cc)");
  command
      ->add_option("--flags", arguments->flags, "options of the compiler, in one word: \"-O3 -march=native\"")
      ->capture_default_str();
  command->add_flag("--libm", arguments->libm, kLibmHelp);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
