#include "commands/load.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "commands/content_hash.hpp"
#include "commands/number_checks.hpp"
#include "compile/start_check.hpp"
#include "loops/plan/plan.hpp"
#include "loops/plan/plan_text.hpp"
#include "model/names.hpp"
#include "model/read/format.hpp"
#include "model/read/members.hpp"
#include "support/files.hpp"
#include "validate/snapping.hpp"

namespace jourdain::commands {

namespace {

/// Emitted files name no folder: they are the same from wherever the command was called.
std::string printed_path(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// Each once, in the order of the imports.
std::vector<support::FileHash> imported_files(const support::Diagnostics& diagnostics) {
  std::vector<support::FileHash> files;
  std::set<std::string> paths;
  for (const support::SourceFile& file : diagnostics.files())
    if (paths.insert(file.path).second) files.push_back({printed_path(file.path), sha256_of(file.text)});
  files.erase(files.begin());
  return files;
}

/// Of the joints of the description and of what it imports.
std::map<std::string, model::Limits> limits_of(const model::Mechanism& mechanism,
                                               const support::Diagnostics& diagnostics) {
  std::vector<model::ImportedFile> files = mechanism.imports;
  files.insert(files.begin(), model::ImportedFile{});
  std::map<std::string, model::Limits> limits;
  for (const model::ImportedFile& imported : files) {
    const support::SourceFile& file = diagnostics.files()[static_cast<std::size_t>(imported.file)];
    if (file.path.ends_with(".toml")) continue;
    for (const auto& [joint, limit] : model::read_urdf_limits(file.text))
      limits[imported.prefix + joint] = limit;
  }
  return limits;
}

std::string check_name(const std::string& name) {
  constexpr std::size_t kLongest = 200;  // that with its endings is the name of a file
  if (name.size() > kLongest)
    return fmt::format("a name of {} characters is too long; there may be {}", name.size(), kLongest);
  if (!model::is_identifier(name) || name.find("__") != std::string::npos || name[0] == '_')
    return fmt::format("'{}' is not a C++ identifier that may name a namespace", name);
  if (model::is_reserved(name) || model::cpp_name(name) != name)
    return fmt::format("'{}' is reserved; try '{}'", name, model::cpp_name(name));
  return "";
}

/// Numbers of the external functions that are called.
std::set<std::uint32_t> called_functions(model::Mechanism mechanism) {
  std::set<std::uint32_t> found;
  const auto visit = [&found]<class Part>(const Part& part) {
    if constexpr (std::is_same_v<Part, model::Expression>)
      for (const model::Expression::Node& node : part.nodes())
        if (node.op == model::Expression::Op::kFunction && node.function == support::Function::kCall)
          found.insert(static_cast<std::uint32_t>(part.nodes()[node.right].value));
  };
  model::Members(visit).of(mechanism);
  return found;
}

/// Files that are imported know nothing of each other's functions, which are members of one struct.
void check_called(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const std::uint32_t number : called_functions(mechanism))
    if (const std::string name = support::called_function(number).name; !names.insert(name).second)
      diagnostics.error({}, fmt::format("two external functions are called '{}', and differ", name),
                        "a 'prefix' of their imports tells them apart");
}

/// Options that change how robot files are read, where neither the description nor what it imports is one that they
/// change.
void refuse_robot_options(const model::ReadOptions& read, support::Diagnostics& diagnostics) {
  bool robots = false, mimics = false;
  for (const support::SourceFile& file : diagnostics.files()) {
    const model::Format format = model::format_of(file.path, file.text);
    robots = robots || format != model::Format::kToml;
    mimics = mimics || format == model::Format::kUrdf || format == model::Format::kSdf;
  }
  if (!read.damping && !robots)
    diagnostics.error({}, "joint damping can be left out of URDF, SDF and MJCF files only",
                      "change the joints' 'damping' in the file");
  if (read.friction && !robots)
    diagnostics.error({}, "joint friction can be asked for with URDF, SDF and MJCF files only",
                      "declare the joints' 'friction' in the file");
  if (!read.mimic && !mimics)
    diagnostics.error({}, "joints that mimic others can be let free in URDF and SDF files only",
                      "change what couples them in the file");
}

void refuse_warnings(support::Diagnostics& diagnostics) {
  const auto is_warning = [](const support::Diagnostic& d) {
    return d.severity == support::Severity::kWarning;
  };
  const auto count = std::count_if(diagnostics.all().begin(), diagnostics.all().end(), is_warning);
  if (count > 0)
    diagnostics.error({}, fmt::format("--strict takes no warnings, and there {}",
                                      count == 1 ? "is one" : fmt::format("are {}", count)));
}

}  // namespace

void ModelArguments::add_to(CLI::App& command) {
  command.add_option("MODEL", path, "model description: .toml, .urdf, .sdf or .mjcf")->required();
  command.add_option("--name", name, "namespace and file name of the emitted code")->check(check_name);
  command.add_option("--root", root, "URDF, SDF: root link fixed to the world, or free")
      ->check(CLI::IsMember({"fixed", "free"}));
  command.add_option("--lock", read.locked_joints, "joints to lock at coordinate zero")->delimiter(',');
  command.add_flag("!--no-damping", read.damping, "URDF, SDF, MJCF: leave out joint damping");
  command.add_flag("--friction", read.friction,
                   "URDF, SDF, MJCF: take joint friction, smoothed about standstill");
  command.add_flag("!--no-mimic", read.mimic, "URDF, SDF: joints that mimic others move freely");
  CLI::Option* snap =
      command.add_option("--snap", read.snap, "angles, rad, and axes this near to a right angle are that")
          ->check(number_between(0, model::kMaximumSnap))
          ->capture_default_str();
  command
      .add_flag_callback(
          "--no-snap", [this] { read.snap = 0; }, "angles and axes as they are read")
      ->excludes(snap);
  command.add_flag("--strict", strict, "warnings are errors");
  command
      .add_option("--derivatives", derivatives,
                  "terms that linearly implicit steps differentiate: all, or those of applied forces but "
                  "gravity (fewer "
                  "operations)")
      ->check(CLI::IsMember({"all", "applied"}))
      ->capture_default_str();
}

std::optional<LoadedMechanism> load(const ModelArguments& arguments, External external) {
  support::Diagnostics diagnostics(arguments.path, support::read_file(arguments.path));
  model::ReadOptions read = arguments.read;
  read.external = external == External::kCalled;
  if (!arguments.root.empty())
    read.root = arguments.root == "free" ? model::RootJoint::kFree : model::RootJoint::kFixed;
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, read);
  if (mechanism) refuse_robot_options(read, diagnostics);
  if (mechanism) check_inertia(*mechanism, diagnostics);
  if (mechanism) check_called(*mechanism, diagnostics);
  if (mechanism) check_start(*mechanism, diagnostics);
  if (mechanism && diagnostics.has_errors() && calls_user_code(*mechanism))
    diagnostics.note({},
                     "external functions are taken to be within their 'range', [1, 3] unless told otherwise");
  if (mechanism && !diagnostics.has_errors())
    if (const std::string sentence = validate::snapping_sentence(*mechanism); !sentence.empty())
      diagnostics.note({}, sentence);
  std::optional<loops::LoopPlan> plan;
  if (mechanism && !diagnostics.has_errors()) plan = loops::plan_loops(*mechanism, diagnostics);
  if (arguments.strict) refuse_warnings(diagnostics);
  fmt::print(stderr, "{}", diagnostics.format());
  if (!mechanism || diagnostics.has_errors()) return std::nullopt;
  LoadedMechanism loaded{std::move(*mechanism), read, {}};
  loaded.limits = limits_of(loaded.mechanism, diagnostics);
  loaded.options.name = arguments.name.empty() ? model::cpp_name(loaded.mechanism.name) : arguments.name;
  loaded.options.loops = std::move(plan);
  if (loaded.options.loops) fmt::print(stderr, "{}", loops::assembly_text(loaded.options.loops->moved));
  loaded.options.path = printed_path(arguments.path);
  loaded.options.sha256 = sha256_of(diagnostics.text());
  loaded.options.imported = imported_files(diagnostics);
  for (const support::SourceFile& file : diagnostics.files()) loaded.sources.push_back(file.path);
  loaded.options.damping = read.damping;
  if (arguments.derivatives == "applied")
    loaded.options.derivative_terms = programs::DerivativeTerms::kApplied;
  if (arguments.name.empty() && loaded.options.name != loaded.mechanism.name)
    fmt::print(stderr, "note: model '{}' becomes namespace '{}' (--name chooses another)\n",
               loaded.mechanism.name, loaded.options.name);
  return loaded;
}

bool calls_user_code(const model::Mechanism& mechanism) { return !called_functions(mechanism).empty(); }

std::size_t LoadedMechanism::freedom() const {
  return plan() ? plan()->freedom : velocity_count() - mechanism.states.size();
}

std::string freedom_text(const LoadedMechanism& loaded) {
  return fmt::format("{} degree{} of freedom", loaded.freedom(), loaded.freedom() == 1 ? "" : "s");
}

std::vector<std::string> loop_sentences(const LoadedMechanism& loaded) {
  if (!loaded.plan()) return {};
  std::vector<std::string> list = loops::sentences(loaded.mechanism, *loaded.plan());
  const std::vector<loops::Moved>& moved = loaded.plan()->moved;
  for (const loops::Moved& m : moved)
    list.push_back(fmt::format("the initial state closes with {}{} = {:.10g} instead of {:.10g}",
                               m.coordinate, m.velocity ? "'s velocity" : "", m.to, m.from));
  if (moved.empty()) list.push_back("the initial state of the description is closed as it is");
  return list;
}

void tell_float_misfit(const CompiledModel& compiled) {
  if (!compiled.weak_in_float.empty())
    fmt::print(stderr, "warning: {}: do not use it in float; --real double writes no floats\n",
               compiled.weak_in_float);
  if (!compiled.float_misfit.empty())
    fmt::print(stderr, "note: {}; --real double writes no floats\n", compiled.float_misfit);
}

int refuse(const LoadedMechanism& loaded, const validate::Verdict& verdict) {
  const bool overflows = verdict.overflows == verdict.failures.size();
  if (overflows || !verdict.advice.empty()) {
    const support::SourceRange& loops = loaded.mechanism.loop_options.where;
    const support::SourceRange& where = overflows || loops.line == 0 ? loaded.mechanism.where : loops;
    fmt::print(stderr, "{}:{}:{}: error: {}\n  {}\n", loaded.options.path, where.line, where.column,
               verdict.failures.front(),
               overflows ? "Units in which masses and lengths are nearer to 1 keep the numbers in its range."
                         : verdict.advice);
    return kModelWrong;
  }
  const std::size_t more = verdict.failures.size() - 1;
  const std::string failure =
      verdict.failures.front() + (more == 0 ? "" : fmt::format(" (and {} more)", more));
  if (verdict.kinks.stuck > 0) {
    const support::SourceRange& where = loaded.mechanism.where;
    fmt::print(
        stderr,
        "{}:{}:{}: error: refused to emit: {}\n"
        "  What decides abs, min, max, floor or `if` is within rounding of zero at all states that were "
        "drawn, {} time{}: a depth, a gap or a sine that is zero but for the last digits. Rounding chooses "
        "the side there, which may be why; give it a size, or leave it out.\n",
        loaded.options.path, where.line, where.column, failure, verdict.kinks.stuck,
        verdict.kinks.stuck == 1 ? "" : "s");
    return kModelWrong;
  }
  fmt::print(stderr,
             "error: refused to emit: {}\n"
             "  The fault is the compiler's, not the description's; --no-snap, fewer --functions or another "
             "treatment of loops may "
             "avoid it.\n"
             "  Please report it with the description, the options and jourdain --version.\n",
             failure);
  return kInternal;
}

}  // namespace jourdain::commands
