#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>

#include "commands/commands.hpp"
#include "commands/ensemble_run.hpp"
#include "commands/ensemble_text.hpp"
#include "commands/progress.hpp"
#include "commands/run_setup.hpp"
#include "loops/plan/parameter_check.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

constexpr double kMostSteps = 1e9;
constexpr std::uint64_t kMostNumbers = 100000000;  ///< of all rows, which are kept until they are written
constexpr std::uint64_t kJudged = 32;              ///< states that are stepped with half the step, too

struct EnsembleArguments {
  RunArguments run;
  EnsembleChoices choices;
  std::uint64_t states = 1000;
  std::vector<std::string> spreads;
  std::string shard = "1/1", output;
  double duration = 10, step = 1e-3, accuracy = 0.1;
};

/// Sets which states are computed; false where the word is no "3/16".
bool set_shard(const EnsembleArguments& arguments, EnsembleChoices& choices) {
  const std::string& word = arguments.shard;
  std::uint64_t part = 0, parts = 0;
  const char* const end = word.data() + word.size();
  const auto first = std::from_chars(word.data(), end, part);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return false;
  const auto second = std::from_chars(first.ptr + 1, end, parts);
  if (second.ec != std::errc() || second.ptr != end || part < 1 || part > parts || parts > arguments.states)
    return false;
  choices.begin = arguments.states / parts * (part - 1) + std::min(part - 1, arguments.states % parts);
  choices.end = choices.begin + arguments.states / parts + (part <= arguments.states % parts ? 1 : 0);
  return true;
}

/// False after diagnostics where the description fails its checks at the ends of what is drawn of its parameters.
bool is_sound_where_drawn(const EnsembleArguments& arguments, const RunModel& model,
                          const std::vector<Spread>& spreads) {
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const Spread& spread = spreads[i];
    if (spread.of != Spread::Of::kParameter) continue;
    double least = spread.value(arguments.choices.seed, 0, i), greatest = least;
    for (std::uint64_t k = 1; k < arguments.states; ++k) {
      const double value = spread.value(arguments.choices.seed, k, i);
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    for (const double value : {least, greatest}) {
      RunModel drawn = model;
      drawn.parameters[spread.entry] = value;
      const auto& range = model.loaded.mechanism.parameters[spread.entry].range;
      if (range && !((*range)[0] <= value && value <= (*range)[1])) {
        fmt::print(stderr, "error: --spread draws {} = {:g}, which is outside its range from {} to {}\n",
                   spread.name, value, (*range)[0], (*range)[1]);
        return false;
      }
      const loops::LoopPlan* plan = model.loaded.plan();
      if (const auto failure =
              plan ? loops::unproven_at(model.loaded.mechanism, *plan, drawn.parameters) : std::nullopt) {
        fmt::print(stderr, "error: --spread of {}: {}\n", spread.name, *failure);
        return false;
      }
      if (!is_sound_at(drawn, arguments.run.model.path,
                       fmt::format("--spread draws {} = {:g}", spread.name, value)))
        return false;
    }
  }
  return true;
}

struct Columns {
  std::vector<std::string> names, units;
};

/// Of what was drawn and of the ends.
Columns columns_of(const RunModel& model, const Signals& signals, const std::vector<Spread>& spreads) {
  Columns columns;
  for (const Spread& spread : spreads) {
    columns.names.push_back(spread.of == Spread::Of::kParameter || spread.of == Spread::Of::kInput
                                ? spread.name
                                : spread.name + "_at_start");
    std::string unit;
    if (spread.of == Spread::Of::kParameter) unit = model.loaded.mechanism.parameters[spread.entry].unit;
    for (const Signal& signal : signals.list())
      if (spread.of != Spread::Of::kParameter && signal.name == spread.name) unit = signal.unit;
    columns.units.push_back(unit);
  }
  for (const Signal& signal : signals.list()) {
    if (signal.kind == "energy" || signal.kind == "input") continue;
    columns.names.push_back(signal.name);
    columns.units.push_back(signal.unit);
  }
  return columns;
}

/// Of each column over the trusted rows, at least one.
std::vector<Statistics> statistics_of_rows(const std::vector<EnsembleRow>& rows, std::size_t columns) {
  std::vector<Statistics> statistics;
  for (std::size_t i = 0; i < columns; ++i) {
    std::vector<double> values;
    for (const EnsembleRow& row : rows)
      if (row.trusted) values.push_back(i < row.drawn.size() ? row.drawn[i] : row.end[i - row.drawn.size()]);
    statistics.push_back(statistics_of(values));
  }
  return statistics;
}

/// The most that half the step changes an end by, over the deviation of that number.
struct StepError {
  double ratio = 0;
  std::string column;
};

StepError step_error(const std::vector<EnsembleRow>& rows, const std::vector<EnsembleRow>& halved,
                     const Columns& columns, const std::vector<Statistics>& statistics) {
  constexpr double kRounding = 1e-6;  // of a number's size: less is not looked at
  StepError worst;
  for (std::size_t k = 0; k < halved.size(); ++k)
    for (std::size_t i = 0; i < halved[k].end.size(); ++i) {
      if (!rows[k].trusted) continue;
      const std::size_t column = rows[k].drawn.size() + i;
      const Statistics& s = statistics[column];
      const double size = std::max(std::fabs(s.least), std::fabs(s.greatest));
      const double apart = std::fabs(rows[k].end[i] - halved[k].end[i]);
      const double ratio = halved[k].trusted ? apart / std::max({s.deviation, kRounding * size, 1e-12})
                                             : std::numeric_limits<double>::infinity();
      if (ratio > worst.ratio) worst = {ratio, columns.names[column]};
    }
  return worst;
}

/// The first states that may not be trusted, and what was drawn for them.
std::string untrusted_text(const std::vector<EnsembleRow>& rows, const Columns& columns, std::size_t count) {
  constexpr int kShown = 3;
  std::string text =
      fmt::format("error: {} of {} states ended where a number is not finite or loops could not be closed",
                  count, rows.size());
  int shown = 0;
  for (const EnsembleRow& row : rows) {
    if (row.trusted || ++shown > kShown) continue;
    text += fmt::format("\n  state {}", row.state);
    for (std::size_t i = 0; i < row.drawn.size(); ++i)
      text += fmt::format("{} {} = {:g}", i == 0 ? ":" : ",", columns.names[i], row.drawn[i]);
  }
  return text + "\n";
}

int run(EnsembleArguments arguments) {
  const double exact_steps = arguments.duration / arguments.step;
  if (!(exact_steps >= 1 && exact_steps <= kMostSteps)) {
    fmt::print(stderr,
               "error: --duration {:g} at --step {:g} is {:.3g} steps; between 1 and {:g} are possible\n",
               arguments.duration, arguments.step, exact_steps, kMostSteps);
    return kUsage;
  }
  if (!set_shard(arguments, arguments.choices)) {
    fmt::print(
        stderr,
        "error: --shard {}: a part of all is expected, as in 3/16, with a state for each of {} states\n",
        arguments.shard, arguments.states);
    return kUsage;
  }
  if (!arguments.run.inputs.empty()) {
    fmt::print(stderr,
               "error: --inputs is of single runs; an ensemble holds --constant-input and what is spread\n");
    return kUsage;
  }
  int status = kSuccess;
  std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  if (model->loaded.velocity_count() == 0) {
    fmt::print(stderr, "error: '{}' has no degree of freedom: nothing is integrated\n",
               model->loaded.mechanism.name);
    return kModelWrong;
  }
  CompileOptions& options = model->loaded.options;
  options.functions = loadable_functions({arguments.choices.method});
  options.choices.packs = true;
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
  if (!is_sound_where_drawn(arguments, *model, *spreads)) return kModelWrong;
  const Columns columns = columns_of(*model, signals, *spreads);
  const std::uint64_t begin = arguments.choices.begin, end = arguments.choices.end;
  if ((end - begin) * columns.names.size() > kMostNumbers) {
    fmt::print(stderr, "error: {} states have {} numbers each, together more than {}; cut them by --shard\n",
               end - begin, columns.names.size(), kMostNumbers);
    return kUsage;
  }
  bar.show("compiling and stepping", 0);
  const EnsembleProgram program(*model, compiled, *spreads, arguments.choices);
  const auto steps = static_cast<std::uint64_t>(std::llround(exact_steps));
  const std::vector<EnsembleRow> rows = program.run(begin, end, steps, arguments.step);
  const std::vector<EnsembleRow> halved =
      program.run(begin, std::min(end, begin + kJudged), 2 * steps, arguments.step / 2);
  bar.clear();
  if (!arguments.output.empty()) support::write_file(arguments.output, ensemble_csv(columns.names, rows));
  const auto untrusted = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const EnsembleRow& row) { return !row.trusted; }));
  fmt::print("{}: {} states{}, {} steps of {:g} s with {} in {}, seed {}\n", options.name, rows.size(),
             rows.size() < arguments.states
                 ? fmt::format(" ({} to {} of {})", begin, end - 1, arguments.states)
                 : "",
             steps, arguments.step, arguments.choices.method, arguments.choices.real, arguments.choices.seed);
  StepError error;
  if (untrusted < rows.size()) {
    const std::vector<Statistics> statistics = statistics_of_rows(rows, columns.names.size());
    fmt::print("{}", statistics_table(columns.names, columns.units, statistics, spreads->size()));
    error = step_error(rows, halved, columns, statistics);
    fmt::print("  half the step moves the first {} ends by at most {:.2g} of a deviation{}\n", halved.size(),
               error.ratio, error.column.empty() ? "" : fmt::format(" ({})", error.column));
  }
  if (!arguments.output.empty()) fmt::print("  wrote {}\n", arguments.output);
  if (untrusted > 0) fmt::print(stderr, "{}", untrusted_text(rows, columns, untrusted));
  if (!(error.ratio <= arguments.accuracy))
    fmt::print(stderr,
               "error: the step is too long for these statistics (allowed: {:g} of a deviation); take a "
               "shorter one, or allow "
               "more by --accuracy where a motion is chaotic\n",
               arguments.accuracy);
  return untrusted > 0 || !(error.ratio <= arguments.accuracy) ? kModelWrong : kSuccess;
}

}  // namespace

void add_ensemble(CLI::App& app, int& status) {
  auto arguments = std::make_shared<EnsembleArguments>();
  CLI::App* command = app.add_subcommand(
      "ensemble",
      "step many drawn states, print statistics: jourdain ensemble arm.toml --spread mass=normal(5%)");
  arguments->run.add_to(*command);
  command->add_option("--states", arguments->states, "how many")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100000000}))
      ->capture_default_str();
  command
      ->add_option("--spread", arguments->spreads,
                   "what differs: NAME=normal(DEVIATION) or NAME=uniform(HALF) about its value, of a "
                   "parameter, an input or "
                   "the start of a position or velocity; 5% is a share of the value; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--seed", arguments->choices.seed, "of what is drawn")->capture_default_str();
  command->add_option("--duration", arguments->duration, "s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--step", arguments->step, "s")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--method", arguments->choices.method, "stepper")
      ->check(CLI::IsMember({"rk4", "rk5", "heun", "euler", "semi_implicit_euler"}))
      ->capture_default_str();
  command->add_option("--threads", arguments->choices.threads, "0: as many as the machine runs at once")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command
      ->add_option("--shard", arguments->shard,
                   "a part of the states, as 3/16; the same numbers as in the whole")
      ->capture_default_str();
  command->add_option("--output", arguments->output, "CSV file with a row for each state");
  command
      ->add_option("--accuracy", arguments->accuracy,
                   "what half the step may move ends by, in deviations, without an error")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
