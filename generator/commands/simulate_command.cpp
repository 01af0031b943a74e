#include <fmt/format.h>
#include <unistd.h>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "commands/build_model.hpp"
#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "model/coordinates.hpp"

namespace jourdain::commands {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestRun = 1e9;  ///< steps

struct Arguments {
  ModelArguments model;
  double duration = 10, step = 1e-3;
  long every = 10;
  std::string output;
  std::string real = "double";
  std::vector<double> input;
};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A bar on a terminal, once a run has taken a second.
class Progress {
 public:
  explicit Progress(long total) : total_(total), shown_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (drawn_) fmt::print(stderr, "\r{:50}\r", "");
  }

  void update(long done) {
    constexpr int kWidth = 40;
    if (!shown_ || seconds_since(begin_) < 1 || seconds_since(last_) < 0.1) return;
    last_ = Clock::now();
    drawn_ = true;
    const int filled = static_cast<int>(kWidth * done / total_);
    fmt::print(stderr, "\r[{:=<{}}{:{}}] {:3}%", "", filled, "", kWidth - filled, 100 * done / total_);
    std::fflush(stderr);
  }

 private:
  long total_;
  bool shown_, drawn_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

/// A CSV field; names from a URDF may hold commas and quotes.
std::string field(const std::string& name) {
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string quoted = "\"";
  for (char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

struct Trajectory {
  std::vector<double> y, z;
  double t = 0;
  double first_energy = 0, largest_drift = 0;
  double stepping_time = 0;  ///< s of wall time spent in steps
  bool finite = true;
};

class Simulation {
 public:
  Simulation(const jourdain_model_table& table, const Arguments& arguments)
      : table_(table), arguments_(arguments) {
    state_.y.resize(static_cast<std::size_t>(table.position_count));
    state_.z.resize(static_cast<std::size_t>(table.velocity_count));
    table.initial_state(state_.y.data(), state_.z.data());
  }

  /// Steps from the initial state, appending a CSV row every so many steps.
  Trajectory run(long steps, std::string& csv) {
    header(csv);
    state_.first_energy = row(csv);
    Progress progress(steps);
    for (long done = 0; done < steps && state_.finite;) {
      const long block = std::min(arguments_.every, steps - done);
      const auto begin = Clock::now();
      table_.rk4_steps(&state_.t, state_.y.data(), state_.z.data(), arguments_.input.data(), arguments_.step,
                       block);
      state_.stepping_time += seconds_since(begin);
      done += block;
      state_.t = static_cast<double>(done) * arguments_.step;
      const double energy = row(csv);
      state_.finite = std::isfinite(energy);
      state_.largest_drift = std::max(state_.largest_drift, std::fabs(energy - state_.first_energy));
      progress.update(done);
    }
    return state_;
  }

 private:
  void header(std::string& csv) const {
    csv += "time";
    for (int i = 0; i < table_.position_count; ++i) csv += "," + field(table_.position_names[i]);
    for (int i = 0; i < table_.velocity_count; ++i)
      csv += "," + field(fmt::format("{}_velocity", table_.velocity_names[i]));
    csv += ",kinetic_energy,potential_energy,total_energy\n";
  }

  /// Total energy, J.
  double row(std::string& csv) const {
    const double kinetic = table_.kinetic_energy(state_.t, state_.y.data(), state_.z.data());
    const double potential = table_.potential_energy(state_.t, state_.y.data(), state_.z.data());
    csv += fmt::format("{}", state_.t);
    for (double value : state_.y) csv += fmt::format(",{}", value);
    for (double value : state_.z) csv += fmt::format(",{}", value);
    csv += fmt::format(",{},{},{}\n", kinetic, potential, kinetic + potential);
    return kinetic + potential;
  }

  const jourdain_model_table& table_;
  const Arguments& arguments_;
  Trajectory state_;
};

bool conserves_energy(const model::Mechanism& mechanism, const std::vector<double>& input) {
  for (const model::Joint& joint : mechanism.joints) {
    if (!joint.spin_damping.is_zero()) return false;
    for (const model::Coordinate& c : joint.coordinates)
      if (!c.damping.is_zero() || !c.friction.is_zero() || c.motion) return false;
  }
  for (const model::Spring& spring : mechanism.springs)
    if (!spring.damping.is_zero() || (!spring.law.is_zero() && !spring.potential)) return false;
  if (!mechanism.loads.empty() || !mechanism.coordinate_forces.empty()) return false;
  for (double u : input)
    if (u != 0) return false;
  return true;
}

void print_summary(const LoadedMechanism& loaded, const Arguments& arguments,
                   const jourdain_model_table& table, const Trajectory& end, long steps) {
  const double microseconds = end.stepping_time / static_cast<double>(steps) * 1e6;
  fmt::print("{}: {} steps of {:g} s with RK4 in {}\n", loaded.mechanism.name, steps, arguments.step,
             arguments.real);
  fmt::print("  {:.3g} us a step on average, {:.3g} times faster than real time\n", microseconds,
             arguments.step * 1e6 / microseconds);
  if (conserves_energy(loaded.mechanism, arguments.input))
    fmt::print("  energy {:.6g} J, drift {:.2g} J at most\n", end.first_energy, end.largest_drift);
  fmt::print("  at t = {:g} s:\n", end.t);
  if (table.position_count == table.velocity_count) {
    for (int i = 0; i < table.position_count; ++i)
      fmt::print("    {:<24} {:>12.6f}   rate {:>12.6f}\n", table.position_names[i],
                 end.y[static_cast<std::size_t>(i)], end.z[static_cast<std::size_t>(i)]);
    return;
  }
  for (int i = 0; i < table.position_count; ++i)
    fmt::print("    {:<24} {:>12.6f}\n", table.position_names[i], end.y[static_cast<std::size_t>(i)]);
  for (int i = 0; i < table.velocity_count; ++i)
    fmt::print("    {:<24} {:>12.6f}\n", table.velocity_names[i], end.z[static_cast<std::size_t>(i)]);
}

int run(Arguments arguments) {
  const double exact_steps = arguments.duration / arguments.step;
  if (!(exact_steps >= 1 && exact_steps <= kLongestRun)) {
    fmt::print(stderr,
               "error: --duration {:g} at --step {:g} is {:.3g} steps; between 1 and {:g} are possible\n",
               arguments.duration, arguments.step, exact_steps, kLongestRun);
    return kUsage;
  }
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  const std::size_t inputs = model::lay_out_coordinates(loaded->mechanism).input_count();
  if (!arguments.input.empty() && arguments.input.size() != inputs) {
    fmt::print(stderr, "error: --constant-input has {} values, the model has {} inputs\n",
               arguments.input.size(), inputs);
    return kUsage;
  }
  arguments.input.resize(inputs, 0.0);
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  if (!compiled.verdict.accepted()) {
    print_refusal(compiled.verdict);
    return kInternal;
  }
  const studies::LoadedModel model = build_model(loaded->options.name, compiled, arguments.real);
  const long steps = std::lround(exact_steps);
  std::string csv;
  const Trajectory end = Simulation(model.table(), arguments).run(steps, csv);
  if (!end.finite) {
    fmt::print(stderr, "error: the state is not finite at t = {:g} s; a step of {:g} s may be too long\n",
               end.t, arguments.step);
    return kModelWrong;
  }
  if (arguments.output == "-") {
    fmt::print("{}", csv);
    return kSuccess;
  }
  const std::string output = arguments.output.empty() ? loaded->options.name + ".csv" : arguments.output;
  support::write_file(output, csv);
  print_summary(*loaded, arguments, model.table(), end, steps);
  fmt::print("  wrote {}\n", output);
  return kSuccess;
}

}  // namespace

void add_simulate(CLI::App& app, int& status) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "simulate", "compile, step with RK4, write CSV: jourdain simulate arm.toml --duration 5");
  arguments->model.add_to(*command);
  command->add_option("--duration", arguments->duration, "s")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--step", arguments->step, "s")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--every", arguments->every, "write every so many steps")
      ->check(CLI::Range(1L, 1000000000L))
      ->capture_default_str();
  command->add_option("--output", arguments->output,
                      "CSV file, or - for standard output (default: NAME.csv)");
  command->add_option("--constant-input", arguments->input, "value of each input, N m or N (default: 0)")
      ->delimiter(',');
  command->add_option("--real", arguments->real, "number type")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
