#include "fuzz/arguments.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <map>

#include "commands/commands.hpp"
#include "fuzz/hostile_values.hpp"

namespace jourdain::tests {

namespace {

struct OptionText {
  std::string name;  ///< as it is written, with its dashes
  bool takes_value = false;
};

using Options = std::map<std::string, std::vector<OptionText>>;

std::string written(const CLI::Option& option) {
  if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
  return option.get_snames().empty() ? "" : "-" + option.get_snames().front();
}

/// By command.
const Options& declared() {
  static const Options options = [] {
    CLI::App app;
    int status = 0;
    commands::add_all(app, status);
    Options list;
    for (const CLI::App* command : app.get_subcommands({}))
      for (const CLI::Option* option : command->get_options())
        if (const std::string name = written(*option); !name.empty())
          list[command->get_name()].push_back({name, option->get_items_expected_max() > 0});
    return list;
  }();
  return options;
}

/// What the models of the cases know, and what is near to that.
const std::map<std::string, std::vector<std::string>>& usual_values() {
  static const std::map<std::string, std::vector<std::string>> values = {
      {"--output", {"out", "out", "deep/er/out", "-", "/dev/null/x", "/dev/full", "model.toml", ".", ""}},
      {"--name", {"arm", "class", "lambda", "json", "a__b", "_a", "1a", "std", "Model", "jourdain", "sin"}},
      {"--root", {"fixed", "free", "Free"}},
      {"--lock", {"hinge", "slide", "crank,rocker", "nothing", "", ",", "root"}},
      {"--derivatives", {"all", "applied", "none"}},
      {"--for", {"casadi", "simulink", "matlab", ""}},
      {"--fmi", {"2", "3", "2.0", "1"}},
      {"--functions",
       {"mass_matrix", "k_bar,q_bar", "linearize", "rodas4_step,rk5_step", "forward_dynamics_derivatives",
        "outputs", "inverse_dynamics", "euler_step,heun_step", "ros34pw2_step", "close_loops", "project",
        "residual_derivatives", "mass_matrix,mass_matrix", "massmatrix", "", ","}},
      {"--depfile", {"out.d", "deep/er/out.d", "/dev/full", "/dev/null/x", ".", ""}},
      {"--against", {"out", "nothing", "model.toml", ".", ""}},
      {"--dump-ir", {"all", "lower", "hoist", "none"}},
      {"--methods", {"rk4", "rk4,euler", "rodas4", "rk9", ""}},
      {"--method", {"rk4", "rk4_step", "rosw43", "euler", "adams_bashforth2", "rk9"}},
      {"--duration",
       {"0.1", "0.01", "0.1s", "10ms", "0", "-1", "nan", "inf", "1e308", "1e-320", "1 fortnight"}},
      {"--step", {"0.01", "1e-3", "0.5", "1", "0", "-1", "nan", "1e308", "1e-300", "0x1p-7"}},
      {"--longest-step", {"16ms", "10ms", "0", "-1ms", "1e300s", "nan"}},
      {"--halvings", {"1", "2", "0", "17", "-1", "1.5"}},
      {"--every", {"1", "7", "0", "-1", "1000000000", "1e9", "99999999999999999999"}},
      {"--warm", {"1", "10", "100", "0", "-1", "1000000001"}},
      {"--cold", {"1", "3", "0", "100001"}},
      {"--blocks", {"1", "3", "0", "100001"}},
      {"--states", {"1", "3", "0", "257"}},
      {"--seed", {"1", "0", "-1", "18446744073709551616"}},
      {"--compiler", {"g++", "nothing", "g++ -Wall", ""}},
      {"--flags", {"-O0", "-O1 -g", "-fnothing", ""}},
      {"--effort", {"0.01", "0.1", "0", "-1", "nan"}},
      {"--tolerance", {"1e-3", "1e-6", "0", "-1", "nan", "1e-40", "1e40"}},
      {"--budget", {"20us", "1ms", "0", "-1us", "1e-30s"}},
      {"--period", {"1ms", "0", "1e30s"}},
      {"--reference", {"auto", "extrapolation", "cvode", "exact"}},
      {"--real", {"double", "float", "long", "half"}},
      {"--set", {"m=2", "l=0", "l=-1", "l=nan", "l=1e308", "x=1", "=1", "l", "l=", "l=1=2", ""}},
      {"--constant-input", {"0", "1", "1,2,3,4", "nan", "1e308", "", "a"}},
      {"--inputs", {"inputs.csv", "inputs.toml", "nothing.csv", ".", ""}},
      {"--outputs", {"tip", "nothing", ""}},
      {"--plot", {"plot.svg", "/dev/null/x.svg", ""}}};
  return values;
}

std::string value_of(const std::string& option, Random& random) {
  const auto usual = usual_values().find(option);
  if (usual != usual_values().end() && random.chance(0.9)) return one_of(usual->second, random);
  const std::string value = random.chance(0.5) ? hostile_number(random) : hostile_name(random);
  return value.substr(0, value.find('\0'));  // an argument ends there
}

void add_option(std::vector<std::string>& arguments, const OptionText& option, Random& random) {
  if (!option.takes_value && random.chance(0.95)) return arguments.push_back(option.name);
  const std::string value = value_of(option.name, random);
  if (random.chance(0.2)) return arguments.push_back(option.name + "=" + value);
  arguments.push_back(option.name);
  if (random.chance(0.97)) arguments.push_back(value);
}

/// Commands that call the C++ compiler get what makes them short, so that they end soon where the other options let
/// them run.
void keep_short(const std::string& command, std::vector<std::string>& arguments) {
  const auto has = [&](const std::string& name) {
    return std::any_of(arguments.begin(), arguments.end(),
                       [&](const auto& a) { return a.starts_with(name); });
  };
  const auto add = [&](const std::string& name, const std::string& value) {
    if (!has(name)) arguments.insert(arguments.end(), {name, value});
  };
  if (command == "simulate" || command == "report") add("--duration", "0.1");
  if (command == "cost") add("--warm", "10"), add("--cold", "1");
  if (command == "bench") add("--functions", "mass_matrix"), add("--blocks", "2"), add("--states", "2");
  if (command == "cost" || command == "report") add("--methods", "rk4");
  if (command == "fmu" && !has("--sources-only")) arguments.push_back("--sources-only");
  if (command == "wrap") add("--for", "simulink");
  if (command != "report") return;
  add("--effort", "0.01");
  add("--halvings", "1");
  add("--longest-step", "10ms");
  if (!has("--no-forms")) arguments.push_back("--no-forms");
  if (!has("--no-plots")) arguments.push_back("--no-plots");
}

std::string random_command(Random& random) {
  static const std::vector<std::string> kCheap = {"compile", "compile",   "compile", "check",
                                                  "info",    "equations", "wrap",    "fmu"};
  static const std::vector<std::string> kCompiling = {"simulate", "simulate", "cost",
                                                      "bench",    "report",   "python"};
  if (random.chance(0.02)) return hostile_name(random);
  return random.chance(0.04) ? one_of(kCompiling, random) : one_of(kCheap, random);
}

}  // namespace

std::vector<std::string> random_arguments(const std::string& model, Random& random) {
  const std::string command = random_command(random);
  std::vector<std::string> arguments;
  const auto known = declared().find(command);
  const std::vector<OptionText>& options = (known == declared().end() ? declared().begin() : known)->second;
  for (std::size_t i = random.below(4); i > 0; --i) add_option(arguments, one_of(options, random), random);
  if ((command == "compile" || command == "python" || command == "wrap") && random.chance(0.95))
    arguments.insert(arguments.end(), {"-o", "out"});
  keep_short(command, arguments);
  if (random.chance(0.97)) {
    const bool first = random.chance(0.7);
    arguments.insert(first ? arguments.begin() : arguments.end(),
                     random.chance(0.97) ? model : hostile_name(random));
  }
  arguments.insert(arguments.begin(), command.substr(0, command.find('\0')));
  return arguments;
}

}  // namespace jourdain::tests
