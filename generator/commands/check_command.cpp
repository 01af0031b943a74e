#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/committed_files.hpp"
#include "commands/emission.hpp"
#include "commands/load.hpp"
#include "commands/printable.hpp"
#include "loops/plan/plan_text.hpp"

namespace jourdain::commands {

namespace {

struct CheckArguments {
  ModelArguments model;
  EmissionArguments emission;
  std::string folder;              ///< whose files are compared; empty: none
  std::vector<std::string> words;  ///< options that decide what the files hold

  void add_to(CLI::App& command) {
    model.add_to(command);
    emission.add_to(command);
  }
};

/// `given` with the options that a manifest holds. Throws CLI::ParseError where one is not known.
CheckArguments with_recorded(const CheckArguments& given, const RecordedModel& recorded) {
  CLI::App command;
  CheckArguments arguments;
  arguments.add_to(command);
  std::vector<std::string> words = recorded.words;
  words.push_back(given.model.path);
  std::reverse(words.begin(), words.end());
  command.parse(words);
  arguments.model.name = recorded.name;
  arguments.model.strict = given.model.strict;
  arguments.folder = given.folder;
  arguments.words = recorded.words;
  return arguments;
}

/// What to compile for a comparison: options that are given are all, otherwise those that the folder was made with
/// hold. Nothing where that cannot be known, which is said.
std::optional<CheckArguments> completed(const CheckArguments& given) {
  if (given.folder.empty()) return given;
  const std::string description = std::filesystem::path(given.model.path).filename().string();
  const std::vector<RecordedModel> recorded = recorded_models(given.folder, description, given.model.name);
  if (recorded.empty()) return given;
  if (recorded.size() > 1) {
    std::vector<std::string> names;
    for (const RecordedModel& model : recorded) names.push_back(model.name);
    fmt::print(stderr, "error: {} holds several models made from {}: {}; --name chooses one\n",
               printable(given.folder), printable(description), fmt::join(names, ", "));
    return std::nullopt;
  }
  if (given.words.empty()) try {
      return with_recorded(given, recorded.front());
    } catch (const CLI::ParseError& error) {
      fmt::print(stderr, "error: {}/{}.json was made with options that this version does not take: {}\n",
                 printable(given.folder), recorded.front().name, printable(error.what()));
      return std::nullopt;
    }
  CheckArguments named = given;
  named.model.name = recorded.front().name;
  return named;
}

/// Says how the files of the folder differ from those that were compiled; the status to exit with.
int compare(const CheckArguments& arguments, const CompiledModel& compiled) {
  const std::vector<std::string> texts = differences(arguments.folder, compiled.files);
  for (const std::string& text : texts) fmt::print(stderr, "{}", text);
  if (texts.empty()) {
    fmt::print("  {} holds just that: {} files, the same byte for byte\n", printable(arguments.folder),
               compiled.files.size());
    return kSuccess;
  }
  std::string options;
  if (!arguments.model.name.empty()) options += " --name " + arguments.model.name;
  for (const std::string& word : arguments.words) options += " " + word;
  const std::string path = printable(arguments.model.path);
  fmt::print(
      stderr, "error: {} of {} files are not what {} gives now\n  jourdain compile {} -o {}{} writes them.\n",
      texts.size(), compiled.files.size(), path, path, printable(arguments.folder), printable(options));
  return kModelWrong;
}

int run(const CheckArguments& given) {
  const std::optional<CheckArguments> arguments = completed(given);
  if (!arguments) return kUsage;
  std::optional<LoadedMechanism> loaded = load(arguments->model, External::kCalled);
  if (!loaded) return kModelWrong;
  std::string wrong = arguments->emission.apply(*loaded);
  if (wrong.empty()) wrong = arguments->emission.tell_absent_functions(*loaded);
  if (!wrong.empty()) {
    fmt::print(stderr, "error: {}\n", wrong);
    return kUsage;
  }
  loaded->options.words = arguments->words;
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) return refuse(*loaded, compiled.verdict);
  tell_float_misfit(compiled);
  fmt::print("ok: {}: {} bodies, {}, {} inputs; backward error {:.1e}, cond(M) up to {}\n",
             loaded->options.name, loaded->mechanism.bodies.size(), freedom_text(*loaded),
             compiled.facts.inputs.size(), compiled.verdict.backward_error,
             validate::condition_text(compiled.verdict));
  if (const loops::LoopPlan* plan = loaded->plan())
    for (const std::string& sentence : loops::sentences(loaded->mechanism, *plan))
      fmt::print("  loops: {}\n", sentence);
  return arguments->folder.empty() ? kSuccess : compare(*arguments, compiled);
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      app.add_subcommand("check", "read, derive and validate; write nothing: jourdain check arm.toml");
  arguments->add_to(*command);
  command->add_option("--against", arguments->folder,
                      "compare the files of this folder with what would be written now; without options "
                      "those that they were made with");
  command->callback([arguments, command, &status] {
    arguments->words = emission_words(*command);
    status = run(*arguments);
  });
}

}  // namespace jourdain::commands
