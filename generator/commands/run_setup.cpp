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
  command
      .add_option("--set", settings,
                  "value of a parameter, NAME=VALUE, in SI units whatever unit it declares; may be repeated")
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

namespace {

/// The description with the parameters' values in place of its own.
std::optional<model::Mechanism> read_at(const RunModel& model, support::Diagnostics& diagnostics) {
  model::ReadOptions read = model.loaded.read;
  const std::vector<model::Parameter>& parameters = model.loaded.mechanism.parameters;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (model.parameters[i] != parameters[i].value) read.parameters[parameters[i].name] = model.parameters[i];
  return model::read_mechanism(diagnostics, read);
}

SettledStart start_at(const RunModel& model, const std::string& path) {
  const loops::LoopPlan* const plan = model.loaded.plan();
  if (!plan || model.parameters == model::default_values(model.loaded.mechanism)) return {};
  model::Mechanism mechanism = model.loaded.mechanism;
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i)
    mechanism.parameters[i].value = model.parameters[i];
  support::Diagnostics diagnostics(path, support::read_file(path));
  std::optional<loops::Start> start = loops::planned_start(mechanism, *plan, diagnostics);
  if (!diagnostics.all().empty()) {  // they may be about files that this one imports
    read_at(model, diagnostics);
    diagnostics.forget();
    start = loops::planned_start(mechanism, *plan, diagnostics);
  }
  if (!start) return {{}, diagnostics.format(), false};
  SettledStart settled{{start->configuration.y.begin(), start->configuration.y.end()},
                       diagnostics.format() + loops::assembly_text(start->moved, "at these parameters ")};
  const Eigen::VectorXd given = reference::Reference<double>(mechanism, model.parameters).initial_state().z;
  const auto velocity = [&](std::size_t k) {
    return static_cast<double>(k < std::size_t(start->z.size()) ? start->z[Eigen::Index(k)]
                                                                : given[Eigen::Index(k)]);
  };
  for (std::size_t k = 0; !plan->is_reduced() && k < std::size_t(given.size()); ++k)
    settled.x.push_back(velocity(k));
  for (const std::size_t k : plan->independent) settled.x.push_back(velocity(k));
  return settled;
}

}  // namespace

bool is_sound_at(const RunModel& model, const std::string& path, const std::string& cause) {
  support::Diagnostics diagnostics(path, support::read_file(path));
  const std::optional<model::Mechanism> mechanism = read_at(model, diagnostics);
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
  model.start = start_at(model, arguments.model.path);
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

bool tell_start(const RunModel& model) {
  fmt::print(stderr, "{}", model.start.told);
  if (!model.start.found) fmt::print(stderr, "error: --set leads to this\n");
  return model.start.found;
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
  if (run && run->start.empty()) {
    status = kUsage;
    if (!tell_start(model)) return {};
    run->start = model.start.x;
  }
  if (run) status = kSuccess;
  return run;
}

std::vector<std::size_t> left_open_rows(const LoadedMechanism& loaded) {
  const loops::LoopPlan* const plan = loaded.plan();
  if (!plan || plan->disagreeing.empty()) return {};
  std::vector<std::size_t> rows = plan->disagreeing;
  rows.insert(rows.end(), plan->sharing.begin(), plan->sharing.end());
  return rows;
}

namespace {

/// Whether closed forms and Newton's iterations find the positions that were settled; false after a message.
bool starts_as_settled(const RunModel& model, const studies::Flow<double>& flow) {
  const double same = std::max(1e-6, 1e4 * flow.table().unit_roundoff);  // float rounds by more
  const std::vector<double>& settled = model.start.x;
  if (settled.empty() || flow.start_set() != settled) return true;
  const std::vector<double> found = flow.start().x;
  const std::vector<std::string> names = model::lay_out_coordinates(model.loaded.mechanism).position_names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::fabs(found[i] - settled[i]) > same * std::max(1.0, std::fabs(settled[i]))) {
      fmt::print(stderr,
                 "error: at these values of its parameters '{}' starts with {} = {:g}, but its loops are "
                 "closed another way there, with {:g}\n",
                 model.loaded.mechanism.name, support::shown(names[i]), settled[i], found[i]);
      return false;
    }
  return true;
}

}  // namespace

bool check_closed(const RunModel& model, const studies::Flow<double>& flow) {
  constexpr double kOpen = 1e7;  // units of rounding
  const studies::Residuals open = flow.residuals_of_closed_rows(flow.start());
  const double allowed = kOpen * flow.table().unit_roundoff;
  if (open.position <= allowed && open.velocity <= allowed) return starts_as_settled(model, flow);
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
