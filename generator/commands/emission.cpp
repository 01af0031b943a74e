#include "commands/emission.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include "commands/kinematic_choice.hpp"
#include "commands/method_names.hpp"

namespace jourdain::commands {

namespace {

/// Options that change no emitted byte, and --name, which the names of the files say.
constexpr std::array<std::string_view, 8> kBesideFiles = {"help",    "name",    "output",  "strict",
                                                          "explain", "dump-ir", "depfile", "against"};

}  // namespace

void EmissionArguments::add_to(CLI::App& command) {
  command
      .add_option(
          "--functions", functions,
          "functions to emit (default: all, of the steps rk4_step), those of momentum and weight too: "
          "gravity_compensation, centroidal_momentum_matrix, …")
      ->delimiter(',');
  command.add_option("--frame", frames, kFrameHelp)->expected(1)->take_all();
  command.add_option("--language", language, "language of the files: C++, or C99")
      ->check(CLI::IsMember({"c++", "c"}))
      ->capture_default_str();
  command
      .add_option(
          "--real", real,
          "number types: of what NAME.cpp instantiates; in C of the files, NAME_f.h and NAME_f.c for float")
      ->check(CLI::IsMember({"float", "double", "both"}))
      ->capture_default_str();
  command.add_flag(
      "--interface", interface,
      "of C: NAME_interface.h and .c too, instances in the caller's memory and a table of all variables");
  command.add_flag(
      "--packs", packs,
      "C++: literals that every pack of numbers takes, sine and cosine at once where a pack has them");
  command.add_flag("--libm", libm, kLibmHelp);
  command.add_flag("--no-lanes", no_lanes, kNoLanesHelp);
  command.add_flag("--clock", clock, "keep the time in State, though nothing depends on it");
}

namespace {

/// Parameters that the C interface takes at one value, at which loops are proven to close.
void tell_held_parameters(const LoadedMechanism& loaded) {
  const loops::ProvenBox* proven = loaded.plan() ? loaded.plan()->proven() : nullptr;
  if (!proven) return;
  std::vector<std::string> held;
  for (const loops::ProvenRange& range : proven->parameters)
    if (range.low == range.high)
      held.push_back(fmt::format("{} = {:g}", loaded.mechanism.parameters[range.index].name, range.low));
  if (!held.empty())
    fmt::print(
        stderr,
        "note: the loops are proven to close at {}, and no other values of these are taken: a 'range' of a "
        "parameter in the description extends that\n",
        fmt::join(held, ", "));
}

}  // namespace

std::string EmissionArguments::apply(LoadedMechanism& loaded) const {
  if (std::string conflict = check_derivative_terms(functions, loaded.options.derivative_terms);
      !conflict.empty())
    return conflict;
  if (std::string conflict = check_steps(functions, loaded); !conflict.empty()) return conflict;
  if (packs && language == "c") return "--packs is of C++, and the language is c";
  if (interface && language != "c") return "--interface is in C: add --language c";
  if (interface && calls_user_code(loaded.mechanism))
    return "--interface has no place for external functions: the table of a model is complete";
  if (interface && loaded.options.name == "jourdain")
    return "jourdain_interface.h is the header of all models: choose another name with --name";
  std::vector<std::string> chosen = functions;
  if (std::string wrong = choose_kinematics(frames, chosen, loaded.mechanism); !wrong.empty()) return wrong;
  if (interface) chosen.emplace_back("initial_state");  // an instance begins with it
  loaded.options.clock = clock;
  ir::TextChoices& choices = loaded.options.choices;
  choices.language = language == "c" ? ir::Language::kC : ir::Language::kCpp;
  choices.has_double = real != "float";
  choices.has_float = real != "double";
  choices.has_interface = interface;
  if (interface) tell_held_parameters(loaded);
  choices.packs = packs;
  choices.own_sines = !libm;
  choices.lanes = !no_lanes;
  if (!functions.empty()) loaded.options.functions = chosen;
  return "";
}

std::string EmissionArguments::tell_absent_functions(const LoadedMechanism& loaded) const {
  if (functions.empty()) return "";
  const CompileOptions& options = loaded.options;
  const programs::SceneFacts scene = programs::scene_facts(loaded.mechanism, loaded.plan(), options.wishes());
  std::vector<std::string> absent;
  for (const programs::FunctionInfo& function : programs::all_functions())
    if (std::find(functions.begin(), functions.end(), function.name) != functions.end() &&
        !programs::has_function(function, scene))
      absent.push_back(function.name);
  if (absent.empty()) return "";
  const std::string what = fmt::format("'{}' has no {}", options.name, fmt::join(absent, ", "));
  if (programs::with_needed(options.functions, scene).empty() && programs::kinematic_functions(scene).empty())
    return fmt::format("--functions: {}, and nothing else is asked for", what);
  fmt::print(stderr, "note: --functions: {}\n", what);
  return "";
}

std::vector<std::string> usual_functions(const model::Mechanism& mechanism) {
  std::vector<std::string> functions = programs::default_functions();
  for (const model::KinematicFunction& function : mechanism.kinematics) functions.push_back(function.name);
  return functions;
}

std::vector<std::string> emission_words(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string name = option->get_lnames().front();
    if (std::find(kBesideFiles.begin(), kBesideFiles.end(), name) != kBesideFiles.end()) continue;
    if (option->get_items_expected_max() == 0)
      words.push_back("--" + name);
    else if (option->get_delimiter() != '\0')
      words.push_back(fmt::format("--{}={}", name, fmt::join(option->results(), ",")));
    else
      for (const std::string& value : option->results()) words.push_back(fmt::format("--{}={}", name, value));
  }
  return words;
}

}  // namespace jourdain::commands
