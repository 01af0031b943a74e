#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <filesystem>
#include <memory>

#include "commands/commands.hpp"
#include "commands/emission.hpp"
#include "commands/ensemble_file.hpp"
#include "commands/ensemble_plot.hpp"
#include "commands/ensemble_run.hpp"
#include "commands/ensemble_setup.hpp"
#include "commands/ensemble_text.hpp"
#include "commands/ensemble_verdict.hpp"
#include "commands/memory_checks.hpp"
#include "commands/number_checks.hpp"
#include "commands/output_guard.hpp"
#include "commands/progress.hpp"
#include "commands/run_length.hpp"
#include "commands/run_setup.hpp"
#include "commands/spread_check.hpp"
#include "programs/steppers.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

constexpr std::uint64_t kMostNumbers = 100000000;  ///< of all rows, which are kept until they are written

struct EnsembleArguments {
  RunArguments run;
  EnsembleChoices choices;
  std::uint64_t states = 1000;
  std::vector<std::string> spreads;
  std::string shard = "1/1", output, plot;
  double duration = 10, step = 1e-3, accuracy = 0.1;
};

/// What a file's name asks for.
enum class OutputKind { kNone, kCsv, kHdf5 };

/// Nothing after a message where the ending is of neither.
std::optional<OutputKind> output_kind(const std::string& output) {
  if (output.empty()) return OutputKind::kNone;
  if (output == "-") {
    fmt::print(stderr,
               "error: --output -: the name of a file is expected; standard output has the statistics\n");
    return {};
  }
  if (is_ensemble_file(output)) return OutputKind::kHdf5;
  const std::string ending = std::filesystem::path(output).extension().string();
  if (ending.empty() || ending == ".csv") return OutputKind::kCsv;
  fmt::print(stderr, "error: --output {}: .csv or .h5 (HDF5) is expected, or no ending, for CSV\n",
             support::shown(output));
  return {};
}

/// Fills in where the states end.
void step_all(const EnsembleProgram& program, EnsembleResult& result) {
  const Shard& shard = result.shard;
  const EnsembleFacts& facts = result.facts;
  EnsembleRows rows = program.run(shard.begin, shard.end, facts.steps, facts.step);
  result.halved =
      program.run(shard.begin, shard.begin + judged_count(shard), 2 * facts.steps, facts.step / 2);
  result.halved.columns.erase(
      result.halved.columns.begin(),
      result.halved.columns.begin() + static_cast<std::ptrdiff_t>(result.drawn_count()));
  result.trusted = std::move(rows.trusted);
  result.values = [columns = std::move(rows.columns)](std::size_t i) { return columns[i]; };
}

int run(EnsembleArguments arguments) {
  const std::optional<long> steps = steps_asked_for(arguments.duration, arguments.step);
  if (!steps) return kUsage;
  const std::optional<Shard> shard = read_shard(arguments.shard, arguments.states);
  if (!shard) {
    fmt::print(
        stderr,
        "error: --shard {}: a part of all is expected, as in 3/16, with a state for each of {} states\n",
        arguments.shard, arguments.states);
    return kUsage;
  }
  const std::optional<OutputKind> output = output_kind(arguments.output);
  if (!output || !is_plot_possible(arguments.plot)) return kUsage;
  if (!arguments.run.inputs.empty()) {
    fmt::print(stderr,
               "error: --inputs is of single runs; an ensemble holds --constant-input and what is spread\n");
    return kUsage;
  }
  int status = kSuccess;
  std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  if (!are_outputs_apart({arguments.output, arguments.plot}, model->loaded.sources)) return kUsage;
  if (model->loaded.velocity_count() == 0) {
    fmt::print(stderr, "error: '{}' has no degree of freedom: nothing is integrated\n",
               model->loaded.mechanism.name);
    return kModelWrong;
  }
  if (const std::string uneven = check_sampling(model->loaded.mechanism, model->parameters, arguments.step);
      !uneven.empty()) {
    fmt::print(stderr, "error: {}\n", uneven);
    return kUsage;
  }
  if (const std::string& method = arguments.choices.method;
      arguments.choices.turns_sines && programs::find_stepper(method)->evaluations == 1) {
    fmt::print(stderr, "error: --turned-sines: {} has one stage, whose sines are computed\n", method);
    return kUsage;
  }
  CompileOptions& options = model->loaded.options;
  options.functions = loadable_functions({arguments.choices.method});
  options.choices.packs = true;
  options.choices.has_double = arguments.run.real != "float";
  ProgressBar bar;
  bar.show("deriving the equations", 0);
  const CompiledModel compiled = compile(model->loaded.mechanism, options);
  bar.clear();
  if (!compiled.verdict.accepted()) return refuse(model->loaded, compiled.verdict);
  arguments.choices.real = arguments.run.real;
  arguments.choices.inputs = arguments.run.constant_input;
  arguments.choices.inputs.resize(compiled.facts.inputs.size());
  const Signals signals(model->loaded, compiled.facts.outputs);
  const auto spreads = read_spreads(arguments.spreads, *model, compiled, signals, arguments.choices.inputs);
  if (!spreads) return kUsage;
  for (const Spread& spread : *spreads) {
    if (spread.of != Spread::Of::kParameter) continue;
    const std::string uneven =
        check_drawn_sampling(model->loaded.mechanism, model->parameters, spread.entry, spread.width);
    if (uneven.empty()) continue;
    fmt::print(stderr, "error: --spread: {}\n", uneven);
    return kUsage;
  }
  if (!is_sound_where_drawn(*model, arguments.run.model.path, *spreads, arguments.choices.seed,
                            arguments.states))
    return kModelWrong;
  if (!starts_follow(*model, *spreads) && !tell_start(*model)) return kUsage;
  const loops::LoopPlan* const plan = model->loaded.plan();
  const auto is_of_input = [](const Spread& spread) { return spread.of == Spread::Of::kInput; };
  if (plan && plan->treatment == model::LoopTreatment::kMultipliers &&
      !std::all_of(spreads->begin(), spreads->end(), is_of_input))
    fmt::print(stderr,
               "note: drawn states close their loops by the least change, weighed by masses: positions and "
               "velocities that '{}' gives move with the others; 'simulate --set' keeps them where it can\n",
               model->loaded.mechanism.name);
  EnsembleResult result;
  result.shard = *shard;
  result.columns = columns_of(*model, signals, *spreads);
  if (shard->size() * result.columns.size() > kMostNumbers) {
    fmt::print(stderr, "error: {} states have {} numbers each, together more than {}; cut them by --shard\n",
               shard->size(), result.columns.size(), kMostNumbers);
    return kUsage;
  }
  bar.show("compiling and stepping", 0);
  const EnsembleProgram program(*model, compiled, *spreads, arguments.choices);
  result.facts = facts_of(*model, compiled, arguments.choices, arguments.spreads);
  result.facts.program_sha256 = program.sha256();
  result.facts.step = arguments.step;
  result.facts.steps = static_cast<std::uint64_t>(*steps);
  result.facts.states = arguments.states;
  result.facts.accuracy = arguments.accuracy;
  step_all(program, result);
  bar.clear();
  switch (*output) {
    case OutputKind::kNone:
      break;
    case OutputKind::kCsv:
      support::write_file(arguments.output, ensemble_csv(result));
      break;
    case OutputKind::kHdf5:
      write_ensemble_file(arguments.output, result);
      break;
  }
  const Verdict verdict = judge(result);
  return report_ensemble(result, verdict,
                         with_plot(arguments.output, arguments.plot, result, verdict.statistics));
}

}  // namespace

void add_ensemble(CLI::App& app, int& status) {
  auto arguments = std::make_shared<EnsembleArguments>();
  CLI::App* command = app.add_subcommand(
      "ensemble",
      "step many drawn states, print statistics: jourdain ensemble arm.toml --spread mass=normal(5%)");
  arguments->run.add_to(*command);
  command->get_option("--inputs")->group("");  // of single runs
  command->add_option("--states", arguments->states, "how many")
      ->check(CLI::Range(std::uint64_t{1}, kMostStates))
      ->capture_default_str();
  command
      ->add_option(
          "--spread", arguments->spreads,
          "what differs: NAME=normal(DEVIATION) or NAME=uniform(HALF) about its value, in SI units "
          "whatever unit it declares, of a parameter, an input (NAME_input) or the start of a "
          "position or velocity; 5% is a share of the value, of parameters and inputs alone that are "
          "not zero; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--seed", arguments->choices.seed, "of what is drawn")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--duration", arguments->duration, "s")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--step", arguments->step, "s")->check(positive_number())->capture_default_str();
  command->add_option("--method", arguments->choices.method, "stepper")
      ->check(CLI::IsMember({"rk4", "rk5", "heun", "euler", "semi_implicit_euler"}))
      ->capture_default_str();
  command->add_flag("--turned-sines", arguments->choices.turns_sines, kTurnedSinesHelp);
  command->add_option("--threads", arguments->choices.threads, "0: as many as the machine runs at once")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command
      ->add_option("--shard", arguments->shard,
                   "a part of the states, as 3/16; the same numbers as in the whole")
      ->capture_default_str();
  command->add_option("--output", arguments->output,
                      "file with a row for each state: .h5 (HDF5, for merge), else CSV");
  command->add_option("--plot", arguments->plot, kEnsemblePlotHelp);
  command
      ->add_option(
          "--accuracy", arguments->accuracy,
          "what half the step may move ends by, in deviations (in thousandths of what is the same in all "
          "states), without an error")
      ->check(positive_number())
      ->capture_default_str();
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
