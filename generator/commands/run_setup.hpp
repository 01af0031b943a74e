// What simulations and studies share: parameter values, inputs, the loaded model.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/build_model.hpp"
#include "commands/load.hpp"
#include "studies/flow.hpp"
#include "studies/inputs.hpp"

namespace jourdain::commands {

struct RunArguments {
  ModelArguments model;
  std::vector<std::string> settings;   ///< NAME=VALUE
  std::vector<double> constant_input;  ///< one value per input; empty: zeros
  std::string inputs;                  ///< a file: .csv or .toml; empty: constant
  std::string real = "double";
  bool libm = false, no_lanes = false;

  void add_to(CLI::App& command);
};

/// y and z that a run starts from at the parameters' values, with closed loops. Empty where emitted code knows it:
/// without loops, or at the default values.
struct SettledStart {
  std::vector<double> x;
  std::string told;  ///< what moved; diagnostics where there is none
  bool found = true;
};

/// A mechanism with the values of its parameters.
struct RunModel {
  LoadedMechanism loaded;
  std::vector<double> parameters;  ///< in the mechanism's order
  SettledStart start = {};
};

/// Reads the model and the settings. On a mistake of the user prints it and leaves the exit status in `status`.
std::optional<RunModel> read_run(const RunArguments& arguments, int& status);

/// The description, what it imports, and the file of the inputs.
std::vector<std::string> files_read(const RunArguments& arguments, const RunModel& model);

/// False after diagnostics, and `cause`, where the mechanism fails the checks of its description at the parameters'
/// values.
bool is_sound_at(const RunModel& model, const std::string& path, const std::string& cause);

/// Prints what there is to tell of the start at the parameters' values; false where there is none.
bool tell_start(const RunModel& model);

/// Inputs of a run and the state that it starts from (empty: the description's).
struct RunInputs {
  std::unique_ptr<studies::Inputs> inputs;
  std::vector<double> start;
  std::string what;  ///< in words; empty where there are no inputs
};

/// Reads what drives the model. `long_table` may be null. On a mistake prints it and leaves the exit status in
/// `status`.
std::optional<RunInputs> read_inputs(const RunArguments& arguments, const RunModel& model,
                                     const jourdain_model_table& table,
                                     const jourdain_model_table* long_table, int& status);

/// Rows of constraints that do not agree with the others and stay open, and those that close by turns with them.
std::vector<std::size_t> left_open_rows(const LoadedMechanism& loaded);

/// Whether the loops close at the start; false after a message.
bool check_closed(const RunModel& model, const studies::Flow<double>& flow);

/// Whether rates at the start are numbers; false after a message.
bool check_rates(const studies::Flow<double>& flow);

NumberType number_type(const std::string& real);

}  // namespace jourdain::commands
