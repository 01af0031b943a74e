#include "commands/run_setup.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "commands/emission.hpp"
#include "commands/input_table.hpp"
#include "compile/start_check.hpp"
#include "loops/plan/parameter_check.hpp"
#include "loops/plan/plan_text.hpp"
#include "loops/plan/planned_start.hpp"
#include "model/check/checks.hpp"
#include "model/coordinates.hpp"
#include "model/read/read.hpp"
#include "model/read/scenario.hpp"
#include "reference/minimal.hpp"
#include "studies/driven_inputs.hpp"
#include "support/files.hpp"
#include "support/float_range.hpp"

namespace jourdain::commands {

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// False after a message where a number of the command line has no room in the run's number type.
bool check_room(const std::string& option, double value, const std::string& real) {
  const std::string misfit = real == "float" ? support::float_misfit(value) : "";
  if (!misfit.empty()) fmt::print(stderr, "error: {}: {} {}\n", option, value, misfit);
  return misfit.empty();
}

/// False after a message where a setting is no known NAME=VALUE.
bool apply_settings(const RunArguments& arguments, const model::Mechanism& mechanism,
                    std::vector<double>& values) {
  std::vector<std::string> names;
  for (const model::Parameter& parameter : mechanism.parameters) {
    names.push_back(parameter.name);
    values.push_back(parameter.value);
  }
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      const std::string near = support::nearest(name, names);
      fmt::print(stderr, "error: --set {}: no parameter '{}'; {}\n", setting, name,
                 !near.empty()   ? fmt::format("did you mean '{}'?", near)
                 : names.empty() ? std::string("the model has none")
                                 : fmt::format("there are {}", fmt::join(names, ", ")));
      return false;
    }
    double value = 0;
    const char* begin = equals == std::string::npos ? setting.data() + setting.size() : &setting[equals + 1];
    const char* end = setting.data() + setting.size();
    const auto [rest, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || rest != end || !std::isfinite(value)) {
      fmt::print(stderr, "error: --set {}: a number must follow, as in {}=0.5\n", setting, name);
      return false;
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (const auto& range = mechanism.parameters[index].range;
        range && !((*range)[0] <= value && value <= (*range)[1])) {
      fmt::print(stderr, "error: --set {}: '{}' is outside its range from {} to {}\n", setting, name,
                 (*range)[0], (*range)[1]);
      return false;
    }
    if (!check_room("--set " + setting, value, arguments.real)) return false;
    values[index] = value;
  }
  return true;
}

std::optional<RunInputs> read_scenario_file(const std::string& path, const RunModel& model,
                                            const jourdain_model_table& table,
                                            const jourdain_model_table* long_table) {
  support::Diagnostics diagnostics(path, support::read_file(path));
  const auto scenario = model::read_scenario(diagnostics, model.loaded.mechanism);
  fmt::print(stderr, "{}", diagnostics.format());
  if (!scenario) return {};
  RunInputs run;
  if (scenario->follow.empty()) {
    run.inputs = std::make_unique<studies::ExpressionInputs>(scenario->inputs, model.parameters);
    run.what = "inputs as functions of time";
    return run;
  }
  auto following = std::make_unique<studies::FollowingInputs>(model.loaded.mechanism, scenario->follow,
                                                              model.parameters, table, long_table);
  run.start = following->state_at(0);
  run.inputs = std::move(following);
  run.what = "following a motion by inverse dynamics";
  return run;
}

}  // namespace

void RunArguments::add_to(CLI::App& command) {
  model.add_to(command);
  command.add_option("--set", settings, "value of a parameter, NAME=VALUE; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  auto* constant = command.add_option("--constant-input", constant_input, "value of each input (default: 0)")
                       ->delimiter(',');
  command
      .add_option("--inputs", inputs,
                  "inputs over time: .csv (time, input names), or .toml with [input] or [follow]")
      ->excludes(constant);
  command.add_option("--real", real, "number type")
      ->check(CLI::IsMember({"double", "float"}))
      ->capture_default_str();
  command.add_flag("--libm", libm, kLibmHelp);
  command.add_flag("--no-lanes", no_lanes, kNoLanesHelp);
}

bool is_sound_at(const RunModel& model, const std::string& path, const std::string& cause) {
  model::ReadOptions read = model.loaded.read;
  const std::vector<model::Parameter>& parameters = model.loaded.mechanism.parameters;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (model.parameters[i] != parameters[i].value) read.parameters[parameters[i].name] = model.parameters[i];
  support::Diagnostics diagnostics(path, support::read_file(path));
  const std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, read);
  if (mechanism && !diagnostics.has_errors()) check_inertia(*mechanism, diagnostics);
  if (mechanism && !diagnostics.has_errors()) check_start(*mechanism, diagnostics);
  if (mechanism && !diagnostics.has_errors()) return true;
  fmt::print(stderr, "{}error: {}\n", diagnostics.format(), cause);
  return false;
}

std::optional<RunModel> read_run(const RunArguments& arguments, int& status) {
  std::optional<LoadedMechanism> loaded = load(arguments.model);
  status = kModelWrong;
  if (!loaded) return {};
  RunModel model{std::move(*loaded), {}};
  model.loaded.options.choices.own_sines = !arguments.libm;
  model.loaded.options.choices.lanes = !arguments.no_lanes;
  status = kUsage;
  if (!apply_settings(arguments, model.loaded.mechanism, model.parameters)) return {};
  if (const loops::LoopPlan* plan = model.loaded.plan())
    if (const auto failure = loops::unproven_at(model.loaded.mechanism, *plan, model.parameters)) {
      fmt::print(stderr, "error: --set: {}\n", *failure);
      return {};
    }
  if (!arguments.settings.empty() && !is_sound_at(model, arguments.model.path, "--set leads to this"))
    return {};
  for (const double input : arguments.constant_input) {
    if (!std::isfinite(input)) {
      fmt::print(stderr, "error: --constant-input has {}: numbers are expected\n", input);
      return {};
    }
    if (!check_room("--constant-input", input, arguments.real)) return {};
  }
  const std::size_t inputs = model::lay_out_coordinates(model.loaded.mechanism).input_count();
  if (!arguments.constant_input.empty() && arguments.constant_input.size() != inputs) {
    fmt::print(stderr, "error: --constant-input has {} values, the model has {} inputs\n",
               arguments.constant_input.size(), inputs);
    return {};
  }
  status = kSuccess;
  return model;
}

std::vector<std::string> files_read(const RunArguments& arguments, const RunModel& model) {
  std::vector<std::string> paths = model.loaded.sources;
  if (!arguments.inputs.empty()) paths.push_back(arguments.inputs);
  return paths;
}

std::vector<double> start_at_settings(const RunModel& model) {
  model::Mechanism mechanism = model.loaded.mechanism;
  const loops::LoopPlan* const plan = model.loaded.plan();
  if (!plan || model.parameters == model::default_values(mechanism)) return {};
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i)
    mechanism.parameters[i].value = model.parameters[i];
  support::Diagnostics diagnostics("--set", "");
  const std::optional<loops::Start> start = loops::planned_start(mechanism, *plan, diagnostics);
  if (!start) {  // what does not close is told where the run looks at its start
    fmt::print(stderr,
               "note: at these parameters the loops do not leave the start as it is given: it is that of the "
               "default values, closed\n");
    return {};
  }
  fmt::print(stderr, "{}", loops::assembly_text(start->moved, "at these parameters "));
  std::vector<double> x(start->configuration.y.begin(), start->configuration.y.end());
  const Eigen::VectorXd given = reference::Reference<double>(mechanism, model.parameters).initial_state().z;
  const auto velocity = [&](std::size_t k) {
    return static_cast<double>(k < std::size_t(start->z.size()) ? start->z[Eigen::Index(k)]
                                                                : given[Eigen::Index(k)]);
  };
  for (std::size_t k = 0; !plan->is_reduced() && k < std::size_t(given.size()); ++k) x.push_back(velocity(k));
  for (const std::size_t k : plan->independent) x.push_back(velocity(k));
  return x;
}

std::optional<RunInputs> read_inputs(const RunArguments& arguments, const RunModel& model,
                                     const jourdain_model_table& table,
                                     const jourdain_model_table* long_table, int& status) {
  status = kModelWrong;
  std::optional<RunInputs> run;
  if (ends_with(arguments.inputs, ".toml")) {
    run = read_scenario_file(arguments.inputs, model, table, long_table);
  } else if (!arguments.inputs.empty()) {
    const model::CoordinateLayout layout = model::lay_out_coordinates(model.loaded.mechanism);
    support::Diagnostics diagnostics(arguments.inputs, support::read_file(arguments.inputs));
    auto inputs = read_input_table(diagnostics, layout.input_names);
    fmt::print(stderr, "{}", diagnostics.format());
    if (inputs) run = RunInputs{std::move(inputs), {}, "inputs from a table"};
  } else {
    std::vector<double> values = arguments.constant_input;
    values.resize(static_cast<std::size_t>(table.input_count));
    const bool any = std::any_of(values.begin(), values.end(), [](double u) { return u != 0; });
    run = RunInputs{std::make_unique<studies::ConstantInputs>(values), {}, any ? "constant inputs" : ""};
  }
  if (run && run->start.empty()) run->start = start_at_settings(model);
  if (run) status = kSuccess;
  return run;
}

bool check_closed(const RunModel& model, const studies::Flow<double>& flow) {
  constexpr double kOpen = 1e7;  // units of rounding
  const studies::Residuals open = flow.residuals(flow.start());
  const double allowed = kOpen * flow.table().unit_roundoff;
  if (open.position <= allowed && open.velocity <= allowed) return true;
  fmt::print(stderr, "error: the loops of '{}' do not close {}: they are open by {:.2g} (rate {:.2g}/s)\n",
             model.loaded.mechanism.name,
             model.parameters.empty() ? "at the start" : "at these values of its parameters", open.position,
             open.velocity);
  return false;
}

bool check_rates(const studies::Flow<double>& flow) {
  const studies::Point<double> start = flow.start();
  if (start.x.empty()) return true;
  const std::vector<double> rates = flow.rates(start.t, start.x);
  if (std::all_of(rates.begin(), rates.end(), [](double rate) { return std::isfinite(rate); })) return true;
  fmt::print(stderr,
             "error: the equations of motion have no finite rates at the start: the mass matrix is singular "
             "there, or a force or an input has no value\n");
  return false;
}

NumberType number_type(const std::string& real) {
  return real == "float" ? NumberType::kFloat : NumberType::kDouble;
}

}  // namespace jourdain::commands
