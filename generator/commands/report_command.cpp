#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <cmath>
#include <filesystem>
#include <future>
#include <memory>

#include "commands/commands.hpp"
#include "commands/method_names.hpp"
#include "commands/number_checks.hpp"
#include "commands/output_guard.hpp"
#include "commands/progress.hpp"
#include "commands/run_setup.hpp"
#include "loops/plan/plan.hpp"
#include "loops/plan/plan_text.hpp"
#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "programs/displaced_tangent.hpp"
#include "report/conserved_energy.hpp"
#include "report/figure.hpp"
#include "report/plot.hpp"
#include "report/report_page.hpp"
#include "studies/report.hpp"
#include "studies/study.hpp"
#include "support/check.hpp"

namespace jourdain::commands {

namespace {

constexpr double kMostSteps = 2e7;  ///< of the shortest length
constexpr long kLargeScene =
    5000;  ///< operations of forward dynamics beyond which 50 digits must be asked for

struct ReportArguments {
  RunArguments run;
  studies::StudyOptions study;
  std::vector<std::string> methods;
  std::string folder;
  std::string reference = "auto";
  double tolerance = 0, budget = 0, penetration = 0;
  bool plots = true;
};

studies::ReferenceKind reference_kind(const std::string& name) {
  if (name == "extrapolation") return studies::ReferenceKind::kExtrapolation;
  if (name == "cvode") return studies::ReferenceKind::kCvode;
  return studies::ReferenceKind::kAutomatic;
}

studies::ReportHead head_of(const ReportArguments& arguments, const LoadedMechanism& loaded,
                            const std::string& scenario) {
  return {loaded.options.name,
          loaded.mechanism.description,
          loaded.options.path,
          loaded.options.sha256,
          arguments.run.real,
          compiler_text(number_type(arguments.run.real)),
          fmt::format("Jourdain {}", emit::kVersion),
          scenario,
          loop_sentences(loaded),
          loaded.plan() ? loops::closing_text(*loaded.plan()) : ""};
}

/// The model in the number type under study and, where it is worth its cost, in 50 digits.
struct LoadedModels {
  studies::LoadedModel working;
  std::optional<studies::LoadedModel> precise;
};

LoadedModels build_models(const ReportArguments& arguments, const std::string& name,
                          const CompiledModel& compiled, ProgressBar& bar) {
  bar.show("compiling the emitted code", 0);
  LoadedModels models{build_model(name, compiled, number_type(arguments.run.real)), {}};
  const bool large = models.working.table().dynamics_operations > kLargeScene;
  const bool needed = arguments.run.real != "double";  // CVODE needs rates in double
  if (!needed && (arguments.reference == "cvode" || (large && arguments.reference == "auto"))) return models;
  bar.show("compiling the emitted code for 50 digits", 0);
  models.precise = build_model(name, compiled, NumberType::kLong);
  return models;
}

/// False after a message.
bool check_steps(const studies::StudyOptions& options) {
  const double steps = std::ldexp(options.duration / options.longest_step, options.halvings);
  if (steps <= kMostSteps) return true;
  fmt::print(stderr,
             "error: --duration {:g} with --longest-step {:g} and {} halvings is {:.3g} of the shortest "
             "steps; {:g} are "
             "possible\n",
             options.duration, options.longest_step, options.halvings, steps, kMostSteps);
  return false;
}

programs::DerivativeTerms terms_of(const ReportArguments& arguments) {
  return arguments.run.model.derivatives == "applied" ? programs::DerivativeTerms::kApplied
                                                      : programs::DerivativeTerms::kAll;
}

/// Whether there is none.
bool print_conflict(const std::string& conflict) {
  if (!conflict.empty()) fmt::print(stderr, "error: {}\n", conflict);
  return conflict.empty();
}

/// Settles what the options leave open; false after a message.
bool settle(ReportArguments& arguments) {
  if (!check_steps(arguments.study)) return false;
  if (arguments.run.real != "double") {
    if (arguments.reference == "cvode") {
      fmt::print(stderr, "error: --reference cvode works in double; leave it out with --real {}\n",
                 arguments.run.real);
      return false;
    }
    arguments.reference = "extrapolation";
  }
  arguments.study.reference = reference_kind(arguments.reference);
  if (arguments.tolerance > 0) arguments.study.question.tolerance = arguments.tolerance;
  if (arguments.budget > 0) arguments.study.question.budget = arguments.budget;
  if (arguments.penetration > 0) arguments.study.penetration = arguments.penetration;
  return print_conflict(check_derivative_terms(arguments.methods, terms_of(arguments)));
}

/// The scene as free bodies.
struct FreeModel {
  model::Mechanism mechanism;
  studies::LoadedModel loaded;
};

/// Compiles the scene as free bodies while other work goes on. Nothing where there is no such scene, or it is
/// too large.
std::future<std::optional<FreeModel>> build_free_bodies(const ReportArguments& arguments,
                                                        const LoadedMechanism& loaded) {
  constexpr std::size_t kMostBodies = 8;  // of which g++ does not take longer than of the rest
  const auto nothing = [] {
    return std::async(std::launch::deferred, [] { return std::optional<FreeModel>(); });
  };
  if (!arguments.study.forms || loaded.velocity_count() > kMostBodies) return nothing();
  const std::optional<model::Mechanism> mechanism = studies::as_free_bodies(loaded.mechanism);
  if (!mechanism) return nothing();
  support::Diagnostics ignored("free bodies", "");
  CompileOptions options;
  options.name = loaded.options.name + "_free_bodies";
  options.choices = loaded.options.choices;
  options.functions = loadable_functions({"rk4"});
  options.loops = loops::plan_loops(*mechanism, ignored);
  if (!options.loops) return nothing();
  const auto compiled = std::make_shared<CompiledModel>(compile(*mechanism, options));
  if (!compiled->verdict.accepted()) return nothing();
  const NumberType number = number_type(arguments.run.real);
  return std::async(std::launch::async, [mechanism, compiled, number, name = options.name] {
    return std::optional<FreeModel>({*mechanism, build_model(name, *compiled, number)});
  });
}

/// Adds an output for the depth of each one-sided element, after the others.
std::vector<studies::TouchFacts> add_depths(model::Mechanism& mechanism,
                                            const std::vector<double>& parameters) {
  std::vector<studies::TouchFacts> facts;
  const auto add = [&](const auto& elements, const auto& unit_of) {
    for (const auto& element : elements) {
      if (!element.touch) continue;
      model::Output depth;
      depth.name = fmt::format("figure_depth_{}", facts.size());
      depth.kind = model::OutputKind::kExpression;
      depth.value = element.touch->depth;
      mechanism.outputs.push_back(depth);
      facts.push_back({element.name, unit_of(element),
                       element.touch->stiffness.template evaluate<double>(parameters),
                       element.touch->exponent});
    }
  };
  add(mechanism.loads, [](const model::Load&) { return std::string("m"); });
  add(mechanism.coordinate_forces, [&mechanism](const model::CoordinateForce& stop) {
    const model::JointKind& kind = model::joint_kind(mechanism.joints[stop.joint.value]);
    return std::string(kind.motions[stop.coordinate].is_angular() ? "rad" : "m");
  });
  return facts;
}

studies::EmittedFreeBodies emitted(const FreeModel& free, const studies::Inputs& inputs, bool hold) {
  studies::Flow<double> flow(free.loaded.table(), inputs);
  if (hold) flow.hold_inputs();
  return {free.mechanism, flow};
}

studies::Study make_study(const ReportArguments& arguments, const RunModel& model, const RunInputs& inputs,
                          const model::Tangent& tangent, const studies::Flow<double>& flow,
                          const jourdain_model_table* long_table, const std::optional<FreeModel>& free,
                          ProgressBar& bar) {
  std::optional<studies::Flow<LongReal>> long_flow;
  if (long_table) {
    long_flow.emplace(*long_table, *inputs.inputs);
    long_flow->set_start(flow.start().x);
    long_flow->leave_open(left_open_rows(model.loaded));
  }
  studies::StudyOptions options = arguments.study;
  if (const loops::LoopPlan* plan = model.loaded.plan(); plan && !plan->redundant.empty())
    options.most_open = plan->most_left_open();
  options.conserves_energy = inputs.what.empty() && report::conserves_energy(model.loaded.mechanism);
  std::optional<studies::EmittedFreeBodies> free_bodies;
  if (free) free_bodies.emplace(emitted(*free, *inputs.inputs, options.hold_inputs));
  return studies::run_study(model.loaded.mechanism, tangent, model.parameters, flow,
                            long_flow ? &*long_flow : nullptr, free_bodies ? &*free_bodies : nullptr, options,
                            [&bar](const std::string& what, double done) { bar.show(what, done); });
}

/// Names of what an older report in the folder may have left beside `written`; none where there is none.
std::vector<std::string> names_beside(const std::string& folder,
                                      const std::vector<support::FileText>& written) {
  std::vector<std::string> names = report::page_names(methods_for(programs::DerivativeTerms::kAll));
  for (const std::string& name : studies::report_csv_names()) names.push_back(name);
  const bool is_first = !std::filesystem::exists(std::filesystem::path(folder) / "report.json");
  for (const support::FileText& file : written) {
    const bool is_known = std::erase(names, file.name) == 1 || file.name == "report.json";
    JD_CHECK(is_known, "a report has no file {}", file.name);
  }
  return is_first ? std::vector<std::string>() : names;
}

/// Writes the files, removes those of an older report and prints what they say; the exit status.
int write_report(const ReportArguments& arguments, const std::string& folder, const RunModel& model,
                 const studies::ReportHead& head, const studies::Flow<double>& flow,
                 const studies::Study& study, const report::Figure& figure, ProgressBar& bar) {
  std::vector<support::FileText> files = studies::report_csv(head, flow.table(), study);
  files.push_back({"report.json", studies::report_json(head, flow.table(), study)});
  if (arguments.plots) {
    bar.show("drawing", 0.5);
    for (support::FileText& file : report::report_pages(head, flow, study, figure))
      files.push_back(std::move(file));
  }
  bar.clear();
  const std::vector<std::string> stale = names_beside(folder, files), read = files_read(arguments.run, model);
  std::vector<std::string> removed;
  for (const std::string& name : stale) removed.push_back(folder + "/" + name);
  if (!are_outputs_apart(paths_in(folder, files), read) ||
      !are_outputs_apart(removed, read, "is read, and would be removed"))
    return kUsage;
  support::write_files(folder, files, stale);
  fmt::print("{}  wrote", studies::report_text(head, flow.table(), study));
  for (const support::FileText& file : files)
    fmt::print(" {}", (std::filesystem::path(folder) / file.name).generic_string());
  fmt::print("\n");
  return kSuccess;
}

int run(ReportArguments arguments) {
  if (!settle(arguments)) return kUsage;
  int status = kSuccess;
  const std::optional<RunModel> model = read_run(arguments.run, status);
  if (!model) return status;
  const std::string& name = model->loaded.options.name;
  if (has_samples(model->loaded.mechanism)) {
    fmt::print(
        stderr,
        "error: '{}' has memories; the solutions that a report compares with follow rates without samples. "
        "Compare runs of `jourdain simulate` with a step and its half\n",
        name);
    return kUsage;
  }
  const std::string folder = arguments.folder.empty() ? name + "_report" : arguments.folder;
  support::check_writable(folder);
  if (arguments.plots) report::check_plotter();
  const std::size_t velocities = model->loaded.velocity_count();
  const auto conflict = [&](const std::vector<std::string>& methods) {
    return check_steps(methods, model->loaded);
  };
  if (arguments.methods.empty()) {
    arguments.methods = default_methods(terms_of(arguments), velocities);
    std::erase_if(arguments.methods, [&](const std::string& method) { return !conflict({method}).empty(); });
  }
  if (const std::string why = conflict(arguments.methods); !why.empty()) {
    fmt::print(stderr, "error: {}\n", why);
    return kUsage;
  }
  if (velocities == 0) {
    fmt::print(stderr, "error: '{}' has no degree of freedom: nothing is integrated\n", name);
    return kModelWrong;
  }
  ProgressBar bar;
  bar.show("deriving the equations", 0);
  report::Figure figure = report::make_figure(model->loaded.mechanism, model->parameters);
  arguments.study.touches = add_depths(figure.mechanism, model->parameters);
  if (arguments.study.penetration && arguments.study.touches.empty()) {
    fmt::print(stderr, "error: --penetration is of contacts, tyres and stops, and '{}' has none\n", name);
    return kUsage;
  }
  CompileOptions options = model->loaded.options;
  options.functions = loadable_functions(arguments.methods);
  options.choices.has_double = arguments.run.real != "float";
  // With what is carried along there are more displacements than its derivatives have in the table of a model.
  const bool carries = model->loaded.plan() && !model->loaded.plan()->carried().empty();
  if (velocities <= kMostVelocities && !carries) options.functions.push_back("forward_dynamics_derivatives");
  const CompiledModel compiled = compile(figure.mechanism, options);
  if (!compiled.verdict.accepted()) return refuse(model->loaded, compiled.verdict);
  bar.show("deriving the equations of the first kind", 0);
  std::future<std::optional<FreeModel>> building = build_free_bodies(arguments, model->loaded);
  const LoadedModels models = build_models(arguments, name, compiled, bar);
  const std::optional<FreeModel> free = building.get();
  if (free) studies::set_parameters(free->loaded.table(), model->parameters);
  const jourdain_model_table& table = models.working.table();
  const jourdain_model_table* long_table = models.precise ? &models.precise->table() : nullptr;
  for (const jourdain_model_table* t : {&table, long_table})
    if (t) studies::set_parameters(*t, model->parameters);
  const std::optional<RunInputs> inputs = read_inputs(arguments.run, *model, table, long_table, status);
  if (!inputs) return status;
  studies::Flow<double> flow(table, *inputs->inputs);
  flow.set_start(inputs->start);
  flow.leave_open(left_open_rows(model->loaded));
  if (!check_closed(*model, flow) || !check_rates(flow)) return kModelWrong;
  const studies::Study study = make_study(
      arguments, *model, *inputs, programs::displaced_tangent(compiled.facts), flow, long_table, free, bar);
  return write_report(arguments, folder, *model, head_of(arguments, model->loaded, inputs->what), flow, study,
                      figure, bar);
}

}  // namespace

void add_report(CLI::App& app, int& status) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand(
      "report",
      "error against run time, and where the error comes from: jourdain report arm.toml --tolerance 1e-6");
  const CLI::Validator time = time_with_unit();
  arguments->run.add_to(*command);
  command->add_option("-o,--output", arguments->folder, "folder to write into (default: NAME_report)");
  command
      ->add_option("--duration", arguments->study.duration,
                   "simulated time, as 2s; whole longest steps, four at least")
      ->transform(time)
      ->default_str("2s");
  const auto* longest = command
                            ->add_option("--longest-step", arguments->study.longest_step,
                                         "longest step, as 16ms; halved again and again. Longer ones are "
                                         "tried and recommended only where this is not given")
                            ->transform(time)
                            ->default_str("16ms");
  command->add_option("--halvings", arguments->study.halvings, "of the longest step")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_option("--methods", arguments->methods, "steppers to compare (default: all)")
      ->delimiter(',')
      ->check(check_method);
  auto* tolerance = command
                        ->add_option("--tolerance", arguments->tolerance,
                                     "recommend the cheapest within this position error, rad or m")
                        ->check(positive_number());
  command
      ->add_option("--budget", arguments->budget,
                   "recommend the most accurate within this run time, as 20us, per period")
      ->transform(time)
      ->excludes(tolerance);
  command
      ->add_option("--penetration", arguments->penetration,
                   "say what keeps contacts, tyres and stops within this depth, m or rad")
      ->check(positive_number());
  command
      ->add_option("--period", arguments->study.question.period,
                   "simulated time that the budget is for, as 1ms")
      ->transform(time)
      ->default_str("1ms");
  command->add_option("--reference", arguments->reference, "reference solution")
      ->check(CLI::IsMember({"auto", "extrapolation", "cvode"}))
      ->capture_default_str();
  command
      ->add_option("--effort", arguments->study.seconds,
                   "s of work for each costly part, on a nominal machine: work is counted, not timed")
      ->check(number_between(0.1, 1e5))
      ->capture_default_str();
  command->add_flag("--hold-inputs", arguments->study.hold_inputs,
                    "steps get inputs as numbers, those of their begin; default: a function of time, sampled "
                    "at the stages");
  command->add_flag("!--no-forms", arguments->study.forms,
                    "leave out the comparison with equations of the first kind");
  command->add_flag("!--no-plots", arguments->plots, "leave out plots and the page, which need gnuplot");
  command->callback([arguments, longest, &status] {
    if (!longest->empty()) arguments->study.question.longest = arguments->study.longest_step;
    status = run(*arguments);
  });
}

}  // namespace jourdain::commands
