#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <filesystem>
#include <memory>

#include "commands/commands.hpp"
#include "commands/kinematic_choice.hpp"
#include "commands/load.hpp"
#include "commands/method_names.hpp"
#include "commands/report_text.hpp"

namespace jourdain::commands {

namespace {

struct Arguments {
  ModelArguments model;
  std::string folder;
  std::vector<std::string> functions, frames;
  bool clock = false, explain = false, packs = false;
  std::string language = "c++", real = "both";
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

ir::TextChoices choices(const Arguments& arguments) {
  ir::TextChoices chosen;
  if (arguments.language == "c") chosen.language = ir::Language::kC;
  chosen.packs = arguments.packs;
  chosen.has_double = arguments.real != "float";
  chosen.has_float = arguments.real != "double";
  return chosen;
}

int run(const Arguments& arguments) {
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  const std::string conflict = check_derivative_terms(arguments.functions, loaded->options.derivative_terms);
  if (!conflict.empty()) {
    fmt::print(stderr, "error: {}\n", conflict);
    return kUsage;
  }
  std::vector<std::string> functions = arguments.functions;
  if (const std::string wrong = choose_kinematics(arguments.frames, functions, loaded->mechanism);
      !wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  if (arguments.packs && arguments.language == "c") {
    fmt::print(stderr, "error: --packs is of C++, and the language is c\n");
    return kUsage;
  }
  loaded->options.clock = arguments.clock;
  loaded->options.choices = choices(arguments);
  if (!arguments.functions.empty()) loaded->options.functions = functions;
  if (!arguments.dump.empty())
    loaded->options.watch = [&](const passes::PassRecord& pass, const ir::Module& module) {
      if (arguments.dump == kAllPasses || arguments.dump == pass.name)
        fmt::print("{}", programs_text(pass, module));
    };
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  support::write_files(arguments.folder, compiled.files);
  fmt::print("{}: {}\n", loaded->options.name, freedom_text(*loaded));
  for (const emit::File& file : compiled.files)
    fmt::print("  wrote {}\n", (std::filesystem::path(arguments.folder) / file.name).generic_string());
  fmt::print("{}{}{}", operations_table(compiled.module), verdict_text(compiled.verdict),
             readback_text(compiled.readback));
  if (arguments.explain)
    fmt::print("{}{}{}", oracles_text(compiled.verdict), passes_text(compiled.passes),
               omissions_text(compiled.omissions));
  return kSuccess;
}

}  // namespace

void add_compile(CLI::App& app, int& status) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("compile", "emit C++ or C for a model: jourdain compile arm.toml -o src/arm");
  arguments->model.add_to(*command);
  command->add_option("-o,--output", arguments->folder, "folder to write into")->required();
  command
      ->add_option(
          "--functions", arguments->functions,
          "functions to emit (default: all, of the steps rk4_step), those of momentum and weight too: "
          "gravity_compensation, centroidal_momentum_matrix, …")
      ->delimiter(',');
  command->add_option("--frame", arguments->frames, kFrameHelp)->expected(1)->take_all();
  command->add_option("--language", arguments->language, "language of the files: C++, or C99")
      ->check(CLI::IsMember({"c++", "c"}))
      ->capture_default_str();
  command
      ->add_option(
          "--real", arguments->real,
          "number types: of what NAME.cpp instantiates; in C of the files, NAME_f.h and NAME_f.c for float")
      ->check(CLI::IsMember({"float", "double", "both"}))
      ->capture_default_str();
  command->add_flag(
      "--packs", arguments->packs,
      "C++: literals that every pack of numbers takes, sine and cosine at once where a pack has them");
  command->add_flag("--clock", arguments->clock, "keep the time in State, though nothing depends on it");
  command->add_flag("--explain", arguments->explain,
                    "print what was compared with what, what each pass did and what was left out");
  command
      ->add_flag(
          fmt::format("--dump-ir{{{}}}", kAllPasses), arguments->dump,
          fmt::format("print programs, operations and time after each pass; --dump-ir=PASS: after that "
                      "one of {}, {}",
                      kLowered, fmt::join(passes::pass_names(), ", ")))
      ->check(check_pass);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
