#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "commands/commands.hpp"
#include "commands/halved_run.hpp"
#include "commands/loop_guard.hpp"
#include "commands/memory_checks.hpp"
#include "commands/method_names.hpp"
#include "commands/number_checks.hpp"
#include "commands/output_guard.hpp"
#include "commands/printable.hpp"
#include "commands/progress.hpp"
#include "commands/run_bounds.hpp"
#include "commands/run_length.hpp"
#include "commands/run_setup.hpp"
#include "commands/signal_choice.hpp"
#include "commands/signal_plot.hpp"
#include "commands/step_guard.hpp"
#include "programs/displaced_tangent.hpp"
#include "report/conserved_energy.hpp"
#include "report/plot.hpp"
#include "studies/flow.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

using Clock = std::chrono::steady_clock;
using studies::Flow;
using studies::Point;

struct SimulateArguments {
  RunArguments run;
  double duration = 10, step = 1e-3, accuracy = 0.25;
  long every = 10;
  std::string method = "rk4";
  std::vector<std::string> outputs;
  std::string output;
  std::vector<std::string> plot;
};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

const jourdain_method& method_called(const jourdain_model_table& table, const std::string& name) {
  return *std::find_if(table.methods, table.methods + table.method_count,
                       [&name](const jourdain_method& method) { return name == method.name; });
}

struct Trajectory {
  Point<double> end;
  std::vector<double> times;  ///< of all rows, where something is drawn
  std::vector<SampledSignal> drawn;
  double first_energy = 0, largest_drift = 0, largest_kinetic = 0;  ///< J
  studies::Residuals open;                                          ///< largest, of the loops
  std::vector<double> end_rates;                                    ///< of the positions
  double stepping_time = 0;                                         ///< s of wall time spent in steps
  std::optional<HalvedRun> halved;                                  ///< what half the step changes
  std::optional<Breach> breach;                                     ///< where the run ended early
};

class Simulation {
 public:
  /// `guard` may be null. `halves`: half the step is looked at.
  Simulation(const Flow<double>& flow, const SimulateArguments& arguments, bool conserves_energy,
             const Signals& signals, const Selection& selection, const LoopGuard* guard, long steps,
             bool halves)
      : flow_(flow),
        signals_(signals),
        selection_(selection),
        with_outputs_(selection.has_outputs(signals)),
        table_(flow.table()),
        arguments_(arguments),
        method_(method_called(table_, arguments.method)),
        bounds_(flow, flow.start(), conserves_energy),
        conserves_energy_(conserves_energy),
        guard_(guard),
        step_guard_(flow, method_, arguments.step),
        steps_(steps) {
    if (halves) state_.halved.emplace(flow, method_, arguments.step, steps, signals.state_units());
    state_.open = flow.residuals(flow.start());
    state_.first_energy = flow.energy(flow.start());
    for (const std::size_t i : selection.drawn) state_.drawn.push_back({signals.list()[i], {}});
  }

  /// Steps from the initial state, appending a CSV row every so many steps.
  Trajectory run(std::string& csv) {
    studies::Memory memory = flow_.fresh_memory(method_);
    state_.end = flow_.start();
    header(csv);
    row(csv);
    ProgressBar progress;
    for (long done = 0; done < steps_ && !state_.breach;) {
      const long to_row = arguments_.every - done % arguments_.every;
      const long to_comparison = state_.halved ? state_.halved->steps_to_next(done) : to_row;
      const long block = std::min({to_row, to_comparison, steps_ - done});
      const Point<double> before = state_.end;
      const studies::Memory memory_before = memory;
      const auto begin = Clock::now();
      flow_.step(method_, state_.end, arguments_.step, block, memory);
      state_.stepping_time += seconds_since(begin);
      done += block;
      state_.end.t = static_cast<double>(done) * arguments_.step;
      if (block > 1)
        watch_steps(before, memory_before, block);
      else
        watch(before, state_.end);
      if (!state_.breach) follow(block, block == to_comparison || done == steps_);
      if (block == to_row || done == steps_ || state_.breach) row(csv);
      progress.show("simulating", static_cast<double>(done) / static_cast<double>(steps_));
    }
    state_.end_rates = flow_.rates(state_.end.t, state_.end.x);
    return state_;
  }

 private:
  /// What is wrong with the last step or steps, which ended at `point`; empty: nothing.
  std::string trouble(const Point<double>& point) const {
    const std::string out = bounds_.breach(point);
    return out.empty() && guard_ ? guard_->problem(point) : out;
  }

  /// The run in half steps, to where this one is compared with it.
  void follow(long steps, bool is_due) {
    behind_ += steps;
    if (!state_.halved || !is_due) return;
    state_.halved->follow(state_.end, behind_);
    behind_ = 0;
  }

  /// Makes the steps of a block again, one by one: the block as a whole is what is timed.
  void watch_steps(Point<double> point, studies::Memory memory, long steps) {
    for (long done = 0; done < steps && !state_.breach; ++done) {
      const Point<double> last = point;
      flow_.step(method_, point, arguments_.step, 1, memory);
      watch(last, point);
    }
  }

  /// What a step from `before` led to.
  void watch(const Point<double>& before, const Point<double>& point) {
    if (const std::string what = trouble(point); !what.empty())
      state_.breach = {before, point, what,
                       bounds_.breach(point).empty() ? Breach::Of::kLoops : Breach::Of::kBounds};
    else if (const std::string growth = step_guard_.problem(before, point); !growth.empty())
      state_.breach = {before, point, growth, Breach::Of::kGrowth};
    if (conserves_energy_) {
      state_.largest_drift =
          std::max(state_.largest_drift, std::fabs(flow_.energy(point) - state_.first_energy));
      state_.largest_kinetic = std::max(state_.largest_kinetic, flow_.kinetic_energy(point));
    }
    if (!flow_.has_loops()) return;
    const studies::Residuals open = flow_.residuals(point);
    state_.open.position = std::max(state_.open.position, open.position);
    state_.open.velocity = std::max(state_.open.velocity, open.velocity);
  }

  void header(std::string& csv) const {
    csv += "time";
    for (const std::size_t i : selection_.written) csv += "," + csv_field(signals_.list()[i].name);
    csv += "\n";
  }

  void row(std::string& csv) {
    const Point<double>& now = state_.end;
    const std::vector<double> values = signals_.values(flow_, now, with_outputs_);
    csv += fmt::format("{}", now.t);
    for (const std::size_t i : selection_.written) csv += fmt::format(",{}", values[i]);
    csv += "\n";
    if (!state_.drawn.empty()) state_.times.push_back(now.t);
    for (std::size_t k = 0; k < state_.drawn.size(); ++k)
      state_.drawn[k].values.push_back(values[selection_.drawn[k]]);
  }

  const Flow<double>& flow_;
  const Signals& signals_;
  const Selection& selection_;
  bool with_outputs_ = false;
  const jourdain_model_table& table_;
  const SimulateArguments& arguments_;
  const jourdain_method& method_;
  RunBounds bounds_;
  bool conserves_energy_ = false;
  const LoopGuard* guard_;
  StepGuard step_guard_;
  long steps_ = 0;
  long behind_ = 0;  ///< steps that the run in half steps has not made
  Trajectory state_;
};

/// What rounding leaves of the energy of a mechanism that rests, J: of its weight over a metre, of what springs hold.
double rounding_of_energy(const RunModel& model, const jourdain_model_table& table,
                          const Trajectory& result) {
  constexpr double kRoundings = 8;
  double mass = 0, square = 0;
  for (const model::Body& body : model.loaded.mechanism.bodies)
    mass += body.mass.evaluate<double>(model.parameters);
  for (const model::Expression& entry : model.loaded.mechanism.gravity)
    square += std::pow(entry.evaluate<double>(model.parameters), 2);
  return kRoundings * table.unit_roundoff * (mass * std::sqrt(square) + std::fabs(result.first_energy));
}

/// Of the energy of a run that nothing changes; a few steps from rest may be off by a large part of little.
std::string drift_text(const RunModel& model, const jourdain_model_table& table, const Trajectory& result,
                       const SimulateArguments& arguments, long steps) {
  constexpr double kShare = 0.1;
  constexpr long kFewSteps = 20;
  if (steps < kFewSteps || !(result.largest_drift > kShare * result.largest_kinetic) ||
      result.largest_drift <= rounding_of_energy(model, table, result))
    return "";
  return fmt::format(
      "the energy, which nothing changes, drifted by {:.2g} J, of motion there were {:.2g} J at most: this "
      "is not the motion of the mechanism; steps of {:g} s may be too long{}",
      result.largest_drift, result.largest_kinetic, arguments.step,
      arguments.run.real == "float" ? ", or float too coarse, as near singular positions" : "");
}

/// Of a run that is not the motion, as half the step tells.
std::string halving_error(const Flow<double>& flow, const CompiledModel& compiled,
                          const HalvingVerdict& verdict, const SimulateArguments& arguments) {
  const std::string limit = step_limit_text(flow, programs::displaced_tangent(compiled.facts), verdict.point,
                                            arguments.method, arguments.step);
  return fmt::format(
      "{}\n  a step of {:g} s is too long{}; take a shorter one{}, or allow more by --accuracy",
      verdict.wrong, arguments.step, limit.empty() ? "" : ": " + limit,
      limit.empty() ? "" : " or --method rodas4");
}

/// Six decimals; six digits where that would be many.
std::string coordinate_text(double value) {
  return std::fabs(value) < 1e7 ? fmt::format("{:.6f}", value) : fmt::format("{:.6g}", value);
}

void print_summary(const RunModel& model, const RunInputs& inputs, const SimulateArguments& arguments,
                   const jourdain_model_table& table, const Trajectory& result, bool is_sensitive,
                   long steps) {
  const double microseconds = result.stepping_time / static_cast<double>(steps) * 1e6;
  const std::string driven = inputs.what.empty() ? "" : ", " + inputs.what;
  fmt::print("{}: {} steps of {:g} s with {} in {}{}\n", model.loaded.mechanism.name, steps, arguments.step,
             arguments.method, arguments.run.real, driven);
  fmt::print("  {:.3g} us a step on average, {:.3g} times faster than real time\n", microseconds,
             arguments.step * 1e6 / microseconds);
  if (inputs.what.empty() && report::conserves_energy(model.loaded.mechanism))
    fmt::print("  energy {:.6g} J, drift {:.2g} J at most\n", result.first_energy, result.largest_drift);
  if (result.halved && !result.halved->changes().empty())
    fmt::print("  {}{}\n", halving_text(result.halved->changes()),
               is_sensitive ? ": small differences grow, the end depends on them" : "");
  if (table.correct)
    fmt::print("  loops open by {:.1g} m (rate {:.1g} m/s) at most\n", result.open.position,
               result.open.velocity);
  fmt::print("  at t = {:g} s:\n", result.end.t);
  const std::vector<double>& x = result.end.x;
  const int ny = table.position_count, nz = table.velocity_count;
  if (ny == nz || table.correct) {
    for (int i = 0; i < ny; ++i)
      fmt::print("    {:<24} {:>12}   rate {:>12}\n", table.position_names[i],
                 coordinate_text(x[static_cast<std::size_t>(i)]),
                 coordinate_text(result.end_rates[static_cast<std::size_t>(i)]));
    return;
  }
  for (int i = 0; i < ny; ++i)
    fmt::print("    {:<24} {:>12}\n", table.position_names[i],
               coordinate_text(x[static_cast<std::size_t>(i)]));
  for (int i = 0; i < nz; ++i)
    fmt::print("    {:<24} {:>12}\n", table.velocity_names[i],
               coordinate_text(x[static_cast<std::size_t>(ny) + static_cast<std::size_t>(i)]));
}

int run(const SimulateArguments& arguments) {
  const std::optional<long> steps = steps_asked_for(arguments.duration, arguments.step);
  if (!steps) return kUsage;
  if (!arguments.plot.empty()) report::check_plotter();
  int status = kSuccess;
  std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  CompileOptions& options = model->loaded.options;
  for (const std::string& conflict :
       {check_derivative_terms({arguments.method}, options.derivative_terms),
        check_steps({arguments.method}, model->loaded),
        check_sampling(model->loaded.mechanism, model->parameters, arguments.step)})
    if (!conflict.empty()) {
      fmt::print(stderr, "error: {}\n", conflict);
      return kUsage;
    }
  if (const std::string unknown = unknown_output(model->loaded.mechanism, arguments.outputs);
      !unknown.empty()) {
    fmt::print(stderr, "error: {}\n", unknown);
    return kUsage;
  }
  const std::optional<PlotRequest> plot = plot_request(arguments.plot, options.name);
  if (!plot) return kUsage;
  const std::string output = arguments.output.empty() ? options.name + ".csv" : arguments.output;
  if (!are_outputs_apart({output, plot->file}, files_read(arguments.run, *model))) return kUsage;
  options.functions = loadable_functions({arguments.method});
  options.choices.has_double = arguments.run.real != "float";
  const CompiledModel compiled = compile(model->loaded.mechanism, options);
  if (!compiled.verdict.accepted()) return refuse(model->loaded, compiled.verdict);
  const Signals signals(model->loaded, compiled.facts.outputs);
  for (const std::string& sentence : signals.renamed()) fmt::print(stderr, "note: {}\n", sentence);
  const std::optional<Selection> selection = select(signals, arguments.outputs, *plot);
  if (!selection) return kUsage;
  const studies::LoadedModel loaded = build_model(options.name, compiled, number_type(arguments.run.real));
  studies::set_parameters(loaded.table(), model->parameters);
  const std::optional<RunInputs> inputs = read_inputs(arguments.run, *model, loaded.table(), nullptr, status);
  if (!inputs) return status;
  Flow<double> flow(loaded.table(), *inputs->inputs);
  flow.set_start(inputs->start);
  flow.leave_open(left_open_rows(model->loaded));
  if (!check_closed(*model, flow)) return kModelWrong;
  std::string csv;
  const bool conserves = inputs->what.empty() && report::conserves_energy(model->loaded.mechanism);
  const std::optional<LoopGuard> guard =
      model->loaded.plan() ? std::optional<LoopGuard>(std::in_place, flow, model->loaded, arguments.step)
                           : std::nullopt;
  const Trajectory result =
      Simulation(flow, arguments, conserves, signals, *selection, guard ? &*guard : nullptr, *steps,
                 !samples_at_steps(model->loaded.mechanism))
          .run(csv);
  if (result.breach) {
    fmt::print(stderr, "{}",
               breach_text(flow, programs::displaced_tangent(compiled.facts), *result.breach,
                           arguments.method, arguments.step));
    return kModelWrong;
  }
  const std::string picture =
      result.drawn.empty() ? "" : signal_plot(model->loaded.mechanism.name, result.times, result.drawn);
  if (!picture.empty()) support::write_file(plot->file, picture);
  if (picture.empty() && !plot->file.empty())
    fmt::print(stderr, "note: no plot: no value of what it was to show is finite\n");
  std::string wrong = drift_text(*model, loaded.table(), result, arguments, *steps);
  HalvingVerdict halving;
  if (result.halved)
    halving = judge_halving({flow, method_called(loaded.table(), arguments.method), arguments.step, *steps},
                            *result.halved, signals.state_units(), arguments.accuracy);
  if (wrong.empty() && !halving.wrong.empty()) wrong = halving_error(flow, compiled, halving, arguments);
  if (!wrong.empty()) fmt::print(stderr, "error: {}\n", wrong);
  const int outcome = wrong.empty() ? kSuccess : kModelWrong;
  if (arguments.output == "-") {
    fmt::print("{}", csv);
    return outcome;
  }
  support::write_file(output, csv);
  print_summary(*model, *inputs, arguments, loaded.table(), result,
                halving.leads_elsewhere && halving.wrong.empty(), *steps);
  fmt::print("  wrote {}{}\n", output, picture.empty() ? "" : ", " + plot->file);
  return outcome;
}

}  // namespace

void add_simulate(CLI::App& app, int& status) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "compile, step, write CSV: jourdain simulate arm.toml --duration 5");
  arguments->run.add_to(*command);
  command->add_option("--duration", arguments->duration, "s")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--step", arguments->step, "s")->check(positive_number())->capture_default_str();
  command->add_option("--method", arguments->method, "stepper")->check(check_method)->capture_default_str();
  command
      ->add_option("--accuracy", arguments->accuracy,
                   "share of velocities that half the step may change without an error")
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--every", arguments->every, "write every so many steps")
      ->check(CLI::Range(1L, 1000000000L))
      ->capture_default_str();
  command->add_option("--output", arguments->output,
                      "CSV file, or - for standard output (default: NAME.csv)");
  command->add_option("--outputs", arguments->outputs, "outputs to write (default: all)")->delimiter(',');
  command
      ->add_option(
          "--plot", arguments->plot,
          "signals to draw over time, by their names in the CSV ('*' stands for any characters), and "
          "the SVG file (defaults: positions, NAME.svg); needs gnuplot")
      ->delimiter(',');
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
