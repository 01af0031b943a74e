#include <fmt/format.h>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "commands/commands.hpp"
#include "commands/energy.hpp"
#include "commands/loop_guard.hpp"
#include "commands/method_names.hpp"
#include "commands/plot.hpp"
#include "commands/progress.hpp"
#include "commands/run_bounds.hpp"
#include "commands/run_setup.hpp"
#include "studies/flow.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

using Clock = std::chrono::steady_clock;
using studies::Flow;
using studies::Point;

constexpr double kLongestRun = 1e9;  ///< steps
constexpr std::size_t kPlottedPoints = 2000;

struct Arguments {
  RunArguments run;
  double duration = 10, step = 1e-3;
  long every = 10;
  std::string method = "rk4";
  std::vector<std::string> outputs;
  std::string output;
  std::string plot;
};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A CSV field; names from a URDF may hold commas and quotes.
std::string field(const std::string& name) {
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string quoted = "\"";
  for (char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// One of the numbers that the emitted `outputs` writes.
struct OutputNumber {
  std::size_t index = 0;
  std::string name;
};

/// "tracer.position[0]", …: of all outputs, or of those with a name of `chosen`.
std::vector<OutputNumber> output_numbers(const std::vector<readback::ExpectedOutput>& outputs,
                                         const std::vector<std::string>& chosen) {
  std::vector<OutputNumber> numbers;
  std::size_t index = 0;
  for (const readback::ExpectedOutput& output : outputs)
    for (const readback::ExpectedMember& member : output.members)
      for (int row = 0; row < member.rows; ++row)
        for (int column = 0; column < member.columns; ++column, ++index) {
          if (!chosen.empty() && std::find(chosen.begin(), chosen.end(), output.name) == chosen.end())
            continue;
          std::string name = output.name;
          if (!member.name.empty()) name += "." + member.name;
          if (member.rows > 1) name += fmt::format("[{}]", row);
          if (member.is_matrix) name += fmt::format("[{}]", column);
          numbers.push_back({index, name});
        }
  return numbers;
}

/// A sentence on a name that no output has; empty where there is none.
std::string unknown_output(const model::Mechanism& mechanism, const std::vector<std::string>& chosen) {
  std::vector<std::string> names;
  for (const model::Output& output : mechanism.outputs) names.push_back(output.name);
  for (const std::string& name : chosen) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = support::nearest(name, names);
    return fmt::format("no output '{}'; {}", support::shown(name),
                       !near.empty()   ? fmt::format("did you mean '{}'?", near)
                       : names.empty() ? "the model has none"
                                       : fmt::format("there are {}", fmt::join(names, ", ")));
  }
  return "";
}

struct Trajectory {
  Point<double> end;
  std::vector<Point<double>> points;  ///< every one that was written
  double first_energy = 0, largest_drift = 0;
  studies::Residuals open;        ///< largest, of the loops
  std::vector<double> end_rates;  ///< of the positions
  double stepping_time = 0;       ///< s of wall time spent in steps
  std::optional<Breach> breach;   ///< where the run ended early
};

class Simulation {
 public:
  /// `guard` may be null.
  Simulation(const Flow<double>& flow, const Arguments& arguments, bool conserves_energy,
             std::vector<OutputNumber> outputs, const LoopGuard* guard)
      : flow_(flow),
        outputs_(std::move(outputs)),
        table_(flow.table()),
        arguments_(arguments),
        bounds_(flow, flow.start(), conserves_energy),
        guard_(guard) {}

  /// Steps from the initial state, appending a CSV row every so many steps.
  Trajectory run(long steps, std::string& csv) {
    const jourdain_method& method =
        *std::find_if(table_.methods, table_.methods + table_.method_count,
                      [this](const jourdain_method& m) { return arguments_.method == m.name; });
    studies::Memory memory = flow_.fresh_memory(method);
    state_.end = flow_.start();
    header(csv);
    state_.first_energy = row(csv);
    ProgressBar progress;
    for (long done = 0; done < steps && !state_.breach;) {
      const long block = std::min(arguments_.every, steps - done);
      const Point<double> before = state_.end;
      const studies::Memory memory_before = memory;
      const auto begin = Clock::now();
      flow_.step(method, state_.end, arguments_.step, block, memory);
      state_.stepping_time += seconds_since(begin);
      done += block;
      state_.end.t = static_cast<double>(done) * arguments_.step;
      const double energy = row(csv);
      if (!trouble(state_.end).empty()) find_breach(method, before, memory_before, block);
      state_.largest_drift = std::max(state_.largest_drift, std::fabs(energy - state_.first_energy));
      progress.show("simulating", static_cast<double>(done) / static_cast<double>(steps));
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

  /// Makes the steps of a block that ended in trouble again, one by one, up to the first one that does.
  void find_breach(const jourdain_method& method, Point<double> point, studies::Memory memory, long steps) {
    Point<double> last = point;
    std::string what;
    for (long done = 0; done < steps && what.empty(); ++done) {
      last = point;
      flow_.step(method, point, arguments_.step, 1, memory);
      what = trouble(point);
    }
    state_.breach = {last, point, what, bounds_.breach(point).empty()};
  }

  void header(std::string& csv) const {
    csv += "time";
    for (int i = 0; i < table_.position_count; ++i) csv += "," + field(table_.position_names[i]);
    for (int i = 0; i < table_.velocity_count; ++i)
      csv += "," + field(fmt::format("{}_velocity", table_.velocity_names[i]));
    csv += ",kinetic_energy,potential_energy,total_energy";
    for (int i = 0; i < table_.input_count; ++i)
      csv += "," + field(fmt::format("{}_input", table_.input_names[i]));
    for (const OutputNumber& output : outputs_) csv += "," + field(output.name);
    csv += "\n";
  }

  /// Total energy, J.
  double row(std::string& csv) {
    const Point<double>& now = state_.end;
    const studies::Residuals open = flow_.residuals(now);
    state_.open.position = std::max(state_.open.position, open.position);
    state_.open.velocity = std::max(state_.open.velocity, open.velocity);
    if (!arguments_.plot.empty()) state_.points.push_back(now);
    double kinetic = 0, potential = 0;
    const double* z = now.x.data() + table_.position_count;
    table_.kinetic_energy(&now.t, now.x.data(), z, &kinetic);
    table_.potential_energy(&now.t, now.x.data(), z, &potential);
    csv += fmt::format("{}", now.t);
    for (double value : now.x) csv += fmt::format(",{}", value);
    csv += fmt::format(",{},{},{}", kinetic, potential, kinetic + potential);
    const std::vector<double> u = flow_.inputs().at(now.t);
    for (const double value : u) csv += fmt::format(",{}", value);
    if (!outputs_.empty()) {
      std::vector<double> values(static_cast<std::size_t>(table_.output_count));
      table_.outputs(&now.t, now.x.data(), z, u.data(), values.data());
      for (const OutputNumber& output : outputs_) csv += fmt::format(",{}", values[output.index]);
    }
    csv += "\n";
    return kinetic + potential;
  }

  const Flow<double>& flow_;
  std::vector<OutputNumber> outputs_;
  const jourdain_model_table& table_;
  const Arguments& arguments_;
  RunBounds bounds_;
  const LoopGuard* guard_;
  Trajectory state_;
};

/// Six decimals; six digits where that would be many.
std::string coordinate_text(double value) {
  return std::fabs(value) < 1e7 ? fmt::format("{:.6f}", value) : fmt::format("{:.6g}", value);
}

void print_summary(const RunModel& model, const RunInputs& inputs, const Arguments& arguments,
                   const jourdain_model_table& table, const Trajectory& result, long steps) {
  const double microseconds = result.stepping_time / static_cast<double>(steps) * 1e6;
  const std::string driven = inputs.what.empty() ? "" : ", " + inputs.what;
  fmt::print("{}: {} steps of {:g} s with {} in {}{}\n", model.loaded.mechanism.name, steps, arguments.step,
             arguments.method, arguments.run.real, driven);
  fmt::print("  {:.3g} us a step on average, {:.3g} times faster than real time\n", microseconds,
             arguments.step * 1e6 / microseconds);
  if (inputs.what.empty() && conserves_energy(model.loaded.mechanism))
    fmt::print("  energy {:.6g} J, drift {:.2g} J at most\n", result.first_energy, result.largest_drift);
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
               coordinate_text(x[static_cast<std::size_t>(ny + i)]));
}

/// Coordinates over time.
std::string plot_text(const std::string& title, const jourdain_model_table& table,
                      const std::vector<Point<double>>& points) {
  Plot plot{"trajectory", title, "t, s", "coordinates, rad or m", false, false, {}};
  const std::size_t stride = points.size() / kPlottedPoints + 1;
  for (int i = 0; i < table.position_count; ++i) {
    Series series{table.position_names[i], {}, {}, i, true, false, i >= 8};
    for (std::size_t k = 0; k < points.size(); k += stride) {
      series.x.push_back(points[k].t);
      series.y.push_back(points[k].x[static_cast<std::size_t>(i)]);
    }
    plot.series.push_back(std::move(series));
  }
  return draw({plot}).front();
}

int run(const Arguments& arguments) {
  const double exact_steps = arguments.duration / arguments.step;
  if (!(exact_steps >= 1 && exact_steps <= kLongestRun)) {
    fmt::print(stderr,
               "error: --duration {:g} at --step {:g} is {:.3g} steps; between 1 and {:g} are possible\n",
               arguments.duration, arguments.step, exact_steps, kLongestRun);
    return kUsage;
  }
  if (!arguments.plot.empty()) check_plotter();
  int status = kSuccess;
  std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  CompileOptions& options = model->loaded.options;
  const std::string conflict = check_derivative_terms({arguments.method}, options.derivative_terms);
  if (!conflict.empty()) {
    fmt::print(stderr, "error: {}\n", conflict);
    return kUsage;
  }
  if (const std::string unknown = unknown_output(model->loaded.mechanism, arguments.outputs);
      !unknown.empty()) {
    fmt::print(stderr, "error: {}\n", unknown);
    return kUsage;
  }
  options.functions = loadable_functions({arguments.method});
  const CompiledModel compiled = compile(model->loaded.mechanism, options);
  if (!compiled.verdict.accepted()) {
    print_refusal(compiled.verdict);
    return kInternal;
  }
  const studies::LoadedModel loaded = build_model(options.name, compiled, number_type(arguments.run.real));
  studies::set_parameters(loaded.table(), model->parameters);
  const std::optional<RunInputs> inputs = read_inputs(arguments.run, *model, loaded.table(), nullptr, status);
  if (!inputs) return status;
  Flow<double> flow(loaded.table(), *inputs->inputs);
  flow.set_start(inputs->start);
  if (!check_closed(*model, flow)) return kModelWrong;
  const long steps = std::lround(exact_steps);
  std::string csv;
  const bool conserves = inputs->what.empty() && conserves_energy(model->loaded.mechanism);
  const std::optional<LoopGuard> guard =
      model->loaded.plan() ? std::optional<LoopGuard>(std::in_place, flow, model->loaded, arguments.step)
                           : std::nullopt;
  const std::vector<OutputNumber> outputs = output_numbers(compiled.expected.outputs, arguments.outputs);
  const Trajectory result =
      Simulation(flow, arguments, conserves, outputs, guard ? &*guard : nullptr).run(steps, csv);
  if (result.breach) {
    fmt::print(stderr, "{}",
               breach_text(flow, compiled.tangent, *result.breach, arguments.method, arguments.step));
    return kModelWrong;
  }
  const std::string plot =
      arguments.plot.empty() ? "" : plot_text(model->loaded.mechanism.name, loaded.table(), result.points);
  if (!plot.empty()) support::write_file(arguments.plot, plot);
  if (arguments.output == "-") {
    fmt::print("{}", csv);
    return kSuccess;
  }
  const std::string output = arguments.output.empty() ? options.name + ".csv" : arguments.output;
  support::write_file(output, csv);
  print_summary(*model, *inputs, arguments, loaded.table(), result, steps);
  fmt::print("  wrote {}{}\n", output, plot.empty() ? "" : ", " + arguments.plot);
  return kSuccess;
}

}  // namespace

void add_simulate(CLI::App& app, int& status) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "compile, step, write CSV: jourdain simulate arm.toml --duration 5");
  arguments->run.add_to(*command);
  command->add_option("--duration", arguments->duration, "s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--step", arguments->step, "s")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--method", arguments->method, "stepper")->check(check_method)->capture_default_str();
  command->add_option("--every", arguments->every, "write every so many steps")
      ->check(CLI::Range(1L, 1000000000L))
      ->capture_default_str();
  command->add_option("--output", arguments->output,
                      "CSV file, or - for standard output (default: NAME.csv)");
  command->add_option("--outputs", arguments->outputs, "outputs to write (default: all)")->delimiter(',');
  command->add_option("--plot", arguments->plot, "SVG file of the coordinates over time; needs gnuplot");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
