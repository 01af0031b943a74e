#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "commands/commands.hpp"
#include "commands/ensemble_file.hpp"
#include "commands/ensemble_merge.hpp"
#include "commands/ensemble_plot.hpp"
#include "commands/ensemble_verdict.hpp"
#include "commands/load.hpp"
#include "commands/output_guard.hpp"
#include "commands/printable.hpp"

namespace jourdain::commands {

namespace {

struct MergeArguments {
  std::string output, plot;
  std::vector<std::string> shards;
};

void print_error(const std::string& text) { fmt::print(stderr, "error: {}\n", printable(text)); }

/// "states 0 to 66 of 200": what the file holds, where it is one of several of an ensemble.
std::optional<std::string> part_in(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return {};
  std::string problem;
  const std::optional<EnsembleResult> result = read_ensemble_file(path, problem);
  if (!result || result->shard.size() == result->facts.states) return {};
  return fmt::format("states {} to {} of {}", result->shard.begin, result->shard.end - 1,
                     result->facts.states);
}

/// False after a message where the file to write is none, or is a shard, or is one of those to read.
bool is_output_sound(const MergeArguments& arguments) {
  if (!is_ensemble_file(arguments.output)) {
    print_error(fmt::format("{}: the file to write comes first and ends in .h5", arguments.output));
    return false;
  }
  if (const std::optional<std::string> part = part_in(arguments.output)) {
    print_error(fmt::format("{}: is a shard, {}, and would be overwritten; the file to write comes first",
                            arguments.output, *part));
    return false;
  }
  return are_outputs_apart({arguments.output, arguments.plot}, arguments.shards,
                           "is a shard, and would be overwritten; the file to write comes first");
}

/// Nothing after messages where one of them is not sound.
std::vector<StoredShard> read_shards(const std::vector<std::string>& paths) {
  std::vector<StoredShard> shards;
  for (const std::string& path : paths) {
    std::string problem;
    std::optional<EnsembleResult> result = read_ensemble_file(path, problem);
    if (result)
      shards.push_back({path, std::move(*result)});
    else
      print_error(path + ": " + problem);
  }
  if (shards.size() < paths.size()) shards.clear();
  return shards;
}

/// What half the step moves in the shards' own first states, of which the whole keeps only its own: that of these that
/// fail is said, too.
int report_shards(const std::vector<StoredShard>& shards, const std::vector<Statistics>& of_whole) {
  int status = kSuccess;
  for (const StoredShard& shard : shards) {
    const EnsembleResult& result = shard.result;
    if (of_whole.empty() || result.shard.begin == 0) continue;
    const StepError error = step_error(result, of_whole);
    if (error.ratio <= result.facts.accuracy) continue;
    print_error(
        fmt::format("{}: half the step moves ends of states {} to {} by at most {:.2g} of a deviation "
                    "({}); allowed are {:g}",
                    shard.path, result.shard.begin, result.shard.begin + judged_count(result.shard) - 1,
                    error.ratio, error.column, result.facts.accuracy));
    status = kModelWrong;
  }
  return status;
}

int run(const MergeArguments& arguments) {
  if (!is_output_sound(arguments) || !is_plot_possible(arguments.plot)) return kUsage;
  const std::vector<StoredShard> shards = read_shards(arguments.shards);
  if (shards.empty()) return kModelWrong;
  const std::vector<std::string> problems = merge_problems(shards);
  for (const std::string& problem : problems) print_error(problem);
  if (!problems.empty()) return kModelWrong;
  const EnsembleResult whole = merged(shards);
  write_ensemble_file(arguments.output, whole);
  const Verdict verdict = judge(whole);
  const int status =
      report_ensemble(whole, verdict, with_plot(arguments.output, arguments.plot, whole, verdict.statistics));
  const int of_shards = report_shards(shards, verdict.statistics);
  return status != kSuccess ? status : of_shards;
}

}  // namespace

void add_merge(CLI::App& app, int& status) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge", "put the shards of an ensemble together: jourdain merge all.h5 1.h5 2.h5 3.h5");
  command->add_option("OUTPUT", arguments->output, "HDF5 file to write: that of all states at once, .h5")
      ->required();
  command->add_option("SHARDS", arguments->shards, "what 'jourdain ensemble --shard' wrote, in any order")
      ->required();
  command->add_option("--plot", arguments->plot, kEnsemblePlotHelp);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
