// A model as a module of Python.
#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <memory>

#include "commands/build_model.hpp"
#include "commands/commands.hpp"
#include "commands/content_hash.hpp"
#include "commands/emission.hpp"
#include "commands/kinematic_choice.hpp"
#include "commands/method_names.hpp"
#include "commands/output_guard.hpp"
#include "commands/python_module.hpp"
#include "commands/python_names.hpp"
#include "commands/report_text.hpp"
#include "commands/shared_library.hpp"
#include "emit/templates.hpp"
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
  std::string cpp_compiler,
      cpp_flags = "-O2 -march=native -ffp-contract=off -fno-math-errno -fno-tree-slp-vectorize";
  bool libm = false, packs = false, turns_sines = false;
};

/// All functions, every step of a cost that is easily compiled, and A, B, C, D where these are not long.
std::vector<std::string> functions_of_modules(const LoadedMechanism& loaded) {
  std::vector<std::string> functions = usual_functions(loaded.mechanism);
  for (const programs::Stepper& stepper : programs::all_steppers())
    if (!stepper.implicit && check_steps({stepper.name}, loaded).empty())
      functions.push_back(stepper.name + "_step");
  if (loaded.velocity_count() <= kMostVelocities) functions.emplace_back(ir::name_of(FunctionId::kLinearize));
  return functions;
}

std::string choose(const PythonArguments& arguments, LoadedMechanism& loaded) {
  EmissionArguments emission;
  emission.functions = arguments.functions.empty() ? functions_of_modules(loaded) : arguments.functions;
  // The module asks whether a state closes its loops, and says how it is closed.
  for (const FunctionId id : {FunctionId::kCloseLoops, FunctionId::kProject, FunctionId::kConstraintResidual})
    emission.functions.emplace_back(ir::name_of(id));
  emission.frames = arguments.frames;
  emission.language = "c";
  emission.real = "double";
  emission.interface = emission.clock = true;
  emission.libm = arguments.libm;
  if (std::string wrong = wrong_module_name(loaded.options.name); !wrong.empty()) return wrong;
  std::string wrong = emission.apply(loaded);
  if (!wrong.empty()) return wrong;
  emission.functions = arguments.functions;
  return emission.tell_absent_functions(loaded);
}

/// The model as C++ of packs: its start, and the steps that ensembles know.
CompileOptions options_of_packs(const CompileOptions& options, const CompiledModel& compiled) {
  CompileOptions result = options;
  result.choices.language = ir::Language::kCpp;
  result.choices.has_interface = false;
  result.choices.packs = true;
  result.functions = {std::string(ir::name_of(FunctionId::kInitialState))};
  for (const programs::FunctionInfo& function : compiled.functions)
    if (function.stepper && !function.stepper->implicit && function.stepper->history == 0)
      result.functions.push_back(function.name);
  return result;
}

std::string library_name(const std::string& name) { return fmt::format("lib{}.so", name); }

/// The library, NAME.py and NAME.pyi, compiled where nobody sees it. With `packs` batches are stepped by them.
std::vector<FileText> module_files(const PythonArguments& arguments, const LoadedMechanism& loaded,
                                   const CompiledModel& compiled, const CompiledModel* packs) {
  const CompileOptions& options = loaded.options;
  const std::string& name = options.name;
  const std::vector<std::string> compiler =
      arguments.compiler.empty() ? machine_c_compiler() : words_of(arguments.compiler);
  std::string all = arguments.flags + batch_text(options, compiled, "");
  std::vector<FileText> sources(compiled.files.begin(), compiled.files.end());
  if (packs) {
    all += arguments.cpp_flags;
    for (const emit::File& file : packs->files)
      if (file.name != name + ".json") sources.push_back({file.name, file.text});
    for (const char* header : {"pack.hpp", "stepping.hpp", "turned_sines.hpp", "ensemble.hpp",
                               "ensemble_interface.hpp", "jourdain_ensemble.h"})
      sources.push_back({header, std::string(emit::template_text(header))});
    sources.push_back({name + "_packs.cpp", packs_text(name, arguments.turns_sines)});
  }
  for (const FileText& source : sources) all += source.text;
  const std::string build = sha256_of(all);
  const support::TemporaryFolder folder;
  sources.push_back({name + "_batch.c", batch_text(options, compiled, build)});
  support::write_files(folder.path(), sources);
  const std::string library = library_name(name);
  const std::vector<std::string> in_c = {name + ".c", name + "_interface.c", name + "_batch.c"};
  if (packs)
    build_shared_library(
        folder.path(), in_c,
        {name + "_packs.cpp",
         arguments.cpp_compiler.empty() ? machine_compiler() : words_of(arguments.cpp_compiler),
         words_of(arguments.cpp_flags)},
        library, compiler, words_of(arguments.flags));
  else
    build_shared_library(folder.path(), in_c, library, compiler, words_of(arguments.flags));
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
  const std::string& name = loaded->options.name;
  std::vector<std::string> outputs;
  for (const std::string& file : {library_name(name), name + ".py", name + ".pyi"})
    outputs.push_back(arguments.folder + "/" + file);
  if (!are_outputs_apart(outputs, loaded->sources)) return kUsage;
  support::check_writable(arguments.folder);
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  std::optional<CompiledModel> packs;
  if (arguments.packs) {
    const CompileOptions of_packs = options_of_packs(loaded->options, compiled);
    if (of_packs.functions.size() == 1) {
      fmt::print(stderr,
                 "error: --packs: none of the functions is a step that takes nothing from earlier ones, as "
                 "rk4_step\n");
      return kUsage;
    }
    packs = compile(loaded->mechanism, of_packs);
    if (!packs->verdict.accepted()) return refuse(*loaded, packs->verdict);
  }
  const std::vector<FileText> files = module_files(arguments, *loaded, compiled, packs ? &*packs : nullptr);
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
  CLI::Option* packs = command->add_flag("--packs", arguments->packs,
                                         "batches are stepped in vectors by euler, semi_implicit_euler, "
                                         "heun, rk4 and rk5; needs a compiler of C++17");
  command->add_flag("--turned-sines", arguments->turns_sines, kTurnedSinesHelp)->needs(packs);
  command
      ->add_option(
          "--cxx-compiler", arguments->cpp_compiler,
          "compiler of C++ for --packs, with options (default: the environment variable CXX, else c++)")
      ->needs(packs);
  command
      ->add_option("--cxx-flags", arguments->cpp_flags,
                   "its options in one word; with sums and products fused, bits are not those of one state")
      ->capture_default_str()
      ->needs(packs);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
