#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <filesystem>
#include <memory>

#include "commands/commands.hpp"
#include "commands/cost_text.hpp"
#include "commands/method_names.hpp"
#include "commands/number_checks.hpp"
#include "commands/output_guard.hpp"
#include "commands/progress.hpp"
#include "commands/run_setup.hpp"
#include "commands/target_text.hpp"
#include "model/angular_entries.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

namespace {

struct CostArguments {
  RunArguments run;
  studies::StepCostOptions steps;
  std::vector<std::string> methods;
  std::string output;
  std::string target;  ///< empty: this machine
};

studies::ReportHead head_of(const CostArguments& arguments, const LoadedMechanism& loaded,
                            const std::string& compiler) {
  return {loaded.options.name,
          loaded.mechanism.description,
          loaded.options.path,
          loaded.options.sha256,
          arguments.run.real,
          compiler,
          fmt::format("Jourdain {}", emit::kVersion),
          ""};
}

/// Makes the report and prints it; the exit status.
int report_on(const CostArguments& arguments, const RunModel& model, const CompiledModel& compiled,
              ProgressBar& bar) {
  const std::string& name = model.loaded.options.name;
  const NumberType number = number_type(arguments.run.real);
  bar.show("compiling the emitted code", 0);
  const studies::LoadedModel loaded = build_model(name, compiled, number);
  studies::set_parameters(loaded.table(), model.parameters);
  int status = kSuccess;
  const std::optional<RunInputs> inputs = read_inputs(arguments.run, model, loaded.table(), nullptr, status);
  if (!inputs) return status;
  studies::Flow<double> flow(loaded.table(), *inputs->inputs);
  flow.set_start(inputs->start);
  flow.leave_open(left_open_rows(model.loaded));
  if (!check_closed(model, flow) || !check_rates(flow)) return kModelWrong;
  bar.show("stack and code", 0);
  const studies::ReportHead head = head_of(arguments, model.loaded, compiler_text(number));
  CostReport report{head, compiled,          loaded.table(),       code_costs(name, compiled, number),
                    {},   arguments.steps.h, studies::clock_tick()};
  report.steps = measure_step_costs(flow, model::angular_positions(model.loaded.mechanism), arguments.steps,
                                    [&bar](const std::string& what, double done) { bar.show(what, done); });
  if (!arguments.output.empty()) support::write_file(arguments.output, cost_json(report));
  bar.clear();
  fmt::print("{}", cost_text(report));
  if (!arguments.output.empty()) fmt::print("  wrote {}\n", arguments.output);
  return kSuccess;
}

/// Whether the loops close at the parameters' values, which this machine's compiler finds out; false after a message.
bool closes(const RunModel& model, const CompiledModel& compiled) {
  if (!model.loaded.plan()) return true;
  const studies::LoadedModel loaded = build_model(model.loaded.options.name, compiled, NumberType::kDouble);
  studies::set_parameters(loaded.table(), model.parameters);
  const studies::ConstantInputs inputs(
      std::vector<double>(static_cast<std::size_t>(loaded.table().input_count)));
  if (!tell_start(model)) return false;
  studies::Flow<double> flow(loaded.table(), inputs);
  flow.set_start(model.start.x);
  flow.leave_open(left_open_rows(model.loaded));
  return check_closed(model, flow);
}

/// The same of a target; nothing is timed.
int report_on_target(const CostArguments& arguments, const RunModel& model, const CompiledModel& compiled,
                     ProgressBar& bar) {
  const Target& target = *find_target(arguments.target);
  const NumberType number = number_type(arguments.run.real);
  if (!arguments.run.settings.empty() && !closes(model, compiled)) return kModelWrong;
  bar.show(fmt::format("compiling and simulating for {}", target.name), 0);
  const studies::ReportHead head = head_of(arguments, model.loaded, compiler_version(target));
  const TargetReport report{head, compiled, target,
                            target_costs(head.name, compiled, number, target,
                                         {model.parameters, arguments.run.constant_input, arguments.steps.h}),
                            arguments.steps.h};
  if (!arguments.output.empty()) support::write_file(arguments.output, target_json(report));
  bar.clear();
  fmt::print("{}", target_text(report));
  if (!arguments.output.empty()) fmt::print("  wrote {}\n", arguments.output);
  return kSuccess;
}

int run(CostArguments arguments) {
  const programs::DerivativeTerms terms = arguments.run.model.derivatives == "applied"
                                              ? programs::DerivativeTerms::kApplied
                                              : programs::DerivativeTerms::kAll;
  if (const std::string conflict = check_derivative_terms(arguments.methods, terms); !conflict.empty()) {
    fmt::print(stderr, "error: {}\n", conflict);
    return kUsage;
  }
  if (!arguments.target.empty()) check_tools(*find_target(arguments.target));
  int status = kSuccess;
  const std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  if (!are_outputs_apart({arguments.output}, files_read(arguments.run, *model))) return kUsage;
  if (!arguments.output.empty())
    support::check_writable(std::filesystem::absolute(arguments.output).parent_path().string());
  const std::size_t velocities = model->loaded.velocity_count();
  const auto conflict = [&](const std::vector<std::string>& methods) {
    return check_steps(methods, model->loaded);
  };
  if (arguments.methods.empty()) {
    arguments.methods = default_methods(terms, velocities);
    std::erase_if(arguments.methods, [&](const std::string& method) { return !conflict({method}).empty(); });
  }
  if (const std::string why = conflict(arguments.methods); !why.empty()) {
    fmt::print(stderr, "error: {}\n", why);
    return kUsage;
  }
  ProgressBar bar;
  bar.show("deriving the equations", 0);
  CompileOptions options = model->loaded.options;
  options.functions = loadable_functions(arguments.methods);
  options.choices.has_double = arguments.run.real != "float";
  const CompiledModel compiled = compile(model->loaded.mechanism, options);
  if (!compiled.verdict.accepted()) return refuse(model->loaded, compiled.verdict);
  return arguments.target.empty() ? report_on(arguments, *model, compiled, bar)
                                  : report_on_target(arguments, *model, compiled, bar);
}

/// Floating-point units of single precision take float, unless the user says otherwise.
void choose_number_type(const CLI::App& command, CostArguments& arguments) {
  const Target* target = find_target(arguments.target);
  if (target && target->usually_float && command.get_option("--real")->count() == 0)
    arguments.run.real = "float";
}

}  // namespace

void add_cost(CLI::App& app, int& status) {
  auto arguments = std::make_shared<CostArguments>();
  CLI::App* command = app.add_subcommand(
      "cost", "operations, stack, code and measured times of single steps: jourdain cost arm.toml");
  arguments->run.add_to(*command);
  command->add_option("-o,--output", arguments->output, "JSON file to write (default: none)");
  command->add_option("--methods", arguments->methods, "steppers (default: all)")
      ->delimiter(',')
      ->check(check_method);
  command->add_option("--step", arguments->steps.h, "s")->check(positive_number())->capture_default_str();
  CLI::Option* warm =
      command->add_option("--warm", arguments->steps.warm, "single steps of each method, one after the other")
          ->check(CLI::Range(1L, 100000000L))
          ->capture_default_str();
  CLI::Option* cold =
      command->add_option("--cold", arguments->steps.cold, "single steps of each method with evicted caches")
          ->check(CLI::Range(1L, 100000L))
          ->capture_default_str();
  command
      ->add_option(
          "--target", arguments->target,
          fmt::format(
              "firmware for {}: code, stack and instructions, counted in a simulator, no times; float "
              "on cortex-m4, unless --real is given",
              fmt::join(target_names(), ", ")))
      ->check(check_target)
      ->excludes(warm)
      ->excludes(cold)
      ->excludes(command->get_option("--inputs"));
  command->callback([arguments, command, &status] {
    choose_number_type(*command, *arguments);
    status = run(*arguments);
  });
}

}  // namespace jourdain::commands
