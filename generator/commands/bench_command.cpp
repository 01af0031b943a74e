#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <memory>

#include "commands/bench_text.hpp"
#include "commands/build_model.hpp"
#include "commands/commands.hpp"
#include "commands/emission.hpp"
#include "commands/method_names.hpp"
#include "commands/number_checks.hpp"
#include "commands/progress.hpp"
#include "commands/shared_library.hpp"

namespace jourdain::commands {

namespace {

struct BenchArguments {
  ModelArguments model;
  std::vector<std::string> functions;
  std::string real = "double";
  std::string compiler;  ///< empty: the machine's
  std::string flags = "-O2";
  BenchChoices choices;
  bool json = false;
};

/// What is emitted and measured where nothing is asked for: derivatives too, unless they take long to compile.
std::vector<std::string> functions_to_measure(const LoadedMechanism& loaded) {
  std::vector<std::string> functions = usual_functions(loaded.mechanism);
  if (loaded.velocity_count() <= kMostVelocities)
    functions.emplace_back(ir::name_of(ir::FunctionId::kForwardDynamicsDerivatives));
  return functions;
}

/// Adds what draws states: the start, and what closes loops.
std::vector<std::string> with_states(std::vector<std::string> functions) {
  for (const ir::FunctionId id :
       {ir::FunctionId::kInitialState, ir::FunctionId::kCloseLoops, ir::FunctionId::kProject})
    functions.emplace_back(ir::name_of(id));
  return functions;
}

int run(BenchArguments arguments) {
  BenchChoices& choices = arguments.choices;
  choices.is_float = arguments.real == "float";
  choices.compiler = arguments.compiler.empty() ? machine_compiler() : words_of(arguments.compiler);
  choices.flags = words_of(arguments.flags);
  if (choices.compiler.empty()) {
    fmt::print(stderr, "error: --compiler is empty\n");
    return kUsage;
  }
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  EmissionArguments emission;
  emission.functions =
      with_states(arguments.functions.empty() ? functions_to_measure(*loaded) : arguments.functions);
  emission.real = arguments.real;
  std::string wrong = emission.apply(*loaded);
  emission.functions = arguments.functions;
  if (wrong.empty()) wrong = emission.tell_absent_functions(*loaded);
  if (!wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  ProgressBar bar;
  bar.show("deriving the equations", 0);
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  bar.show("compiling and measuring", 0);
  const BenchResult result = measure_functions(*loaded, compiled, choices);
  bar.clear();
  const BenchReport report{*loaded, compiled, choices, result};
  fmt::print("{}", arguments.json ? bench_json(report) : bench_text(report));
  return kSuccess;
}

}  // namespace

void add_bench(CLI::App& app, int& status) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = app.add_subcommand(
      "bench", "times, instructions and code of every emitted function: jourdain bench arm.toml");
  BenchChoices& choices = arguments->choices;
  arguments->model.add_to(*command);
  command
      ->add_option(
          "--functions", arguments->functions,
          "functions to measure (default: all, of the steps rk4_step, and derivatives of scenes that "
          "are not large)")
      ->delimiter(',');
  command->add_option("--real", arguments->real, "number type")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  command->add_option("--compiler", arguments->compiler,
                      "C++ compiler (default: environment variable CXX, else c++)");
  command
      ->add_option("--flags", arguments->flags,
                   "options of the compiler for the emitted code, in one word: "
                   "\"-O3 -march=native\"")
      ->capture_default_str();
  command->add_option("--states", choices.states, "states that are drawn")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--seed", choices.seed, "of the states")->check(seed_number())->capture_default_str();
  command->add_option("--blocks", choices.blocks, "blocks of calls of each function")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--step", choices.step, "s, of steps")->check(positive_number())->capture_default_str();
  command->add_flag("--json", arguments->json, "the same as one JSON document");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
