#include "commands/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include "emit/operations.hpp"
#include "emit/templates.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

using ir::FunctionId;

namespace {

struct NumberText {
  const char* type;
  const char* include;
  int parts;
  const char* unit_roundoff;
  std::vector<std::string> compiler_options, link_options;
};

NumberText text_of(NumberType number) {
  switch (number) {
    case NumberType::kDouble:
      return {"double", "", 1, "0x1p-53", {"-O2"}, {}};
    case NumberType::kFloat:
      return {"float", "", 1, "0x1p-24", {"-O2"}, {}};
    case NumberType::kLong:
      return {"jourdain::LongReal", "#include \"long_real.hpp\"\n", 4, "0x1p-166", {"-O1"}, {"-lcln"}};
  }
  return {};
}

std::string stepper_struct(const std::string& name, const programs::Stepper& stepper) {
  const bool remembers = stepper.history > 0 || stepper.implicit;
  const std::string history = stepper.implicit
                                  ? fmt::format("::{}::Accelerations<Real>", name)
                                  : fmt::format("::{}::RateHistory<{}, Real>", name, stepper.history);
  return fmt::format(
      "struct {0}_method {{\n  static constexpr int depth = {1};\n  static constexpr bool implicit = {5};\n"
      "  using History = {2};\n  template <class In>\n"
      "  static void step(State& state, const In& input, const Real& h, [[maybe_unused]] History& history) "
      "{{\n"
      "    ::{3}::{0}_step(model(), state, input, h{4});\n  }}\n}};\n\n",
      stepper.name, stepper.history, remembers ? history : "int", name, remembers ? ", history" : "",
      stepper.implicit);
}

bool has(const CompiledModel& compiled, FunctionId function) {
  return std::any_of(compiled.functions.begin(), compiled.functions.end(),
                     [&](const programs::FunctionInfo& info) { return info.id == function; });
}

long operations_of(const CompiledModel& compiled, FunctionId function) {
  const ir::Program* program = ir::find_program(compiled.module, function);
  return program ? static_cast<long>(ir::count_operations(*program).arithmetic()) : 0;
}

/// The table's functions of a mechanism with loops; empty without.
std::string loop_functions(const std::string& name, const CompiledModel& compiled) {
  const char* correction = programs::correction(compiled.facts);
  if (!*correction) return "";
  return fmt::format(
      "\nvoid constraint_residual(const double* t, const double* y, const double* z, double* g, double* "
      "g_rate) {{\n"
      "  Real residual[Model::constraint_count], rate[Model::constraint_count];\n"
      "  ::{0}::constraint_residual(model(), to_state(t, y, z), residual, rate);\n"
      "  write(residual, g, Model::constraint_count);\n  write(rate, g_rate, "
      "Model::constraint_count);\n}}\n\n"
      "void correct(const double* t, double* y, double* z) {{\n  State state = to_state(t, y, z);\n"
      "  ::{0}::{1}(model(), state);\n  from_state(state, y, z);\n}}\n\n"
      "void closing(jourdain_closing* result) {{\n  *result = worst;\n}}\n",
      name, correction);
}

/// Arrays of length zero are no members of the emitted structs.
std::string shim(const std::string& name, const NumberText& number, const CompiledModel& compiled) {
  const auto copy = [](std::size_t count, const char* line) { return std::string(count > 0 ? line : ""); };
  const programs::SceneFacts& scene = compiled.facts;
  const long dynamics = operations_of(compiled, FunctionId::kForwardDynamics);
  const long rate = operations_of(compiled, FunctionId::kPositionRate);
  std::string steppers, methods;
  int method_count = 0;
  for (const emit::StepRecord& record : emit::step_records(scene, compiled.functions, compiled.module)) {
    const programs::Stepper& s = *record.stepper;
    steppers += stepper_struct(name, s);
    methods += fmt::format("\n    {{\"{0}\", {1}, {2}, {3}, {4}, {5}L, steps<{0}_method>}},", s.name,
                           s.order_with(scene.has_whole_derivatives()), s.evaluations, s.history,
                           int(s.implicit), record.operations);
    ++method_count;
  }
  std::string parameters;
  for (std::size_t i = 0; i < scene.parameters.size(); ++i)
    parameters +=
        fmt::format("  parameters.{} = joined<Real>(values + {} * parts);\n", scene.parameters[i].name, i);
  std::string rates, inverse, outputs;
  const bool with_position_rate = has(compiled, FunctionId::kPositionRate);
  if (!scene.velocities.empty() || with_position_rate) rates = "  const State state = to_state(t, y, z);\n";
  if (!scene.velocities.empty()) {
    rates += "  Real zd[Model::velocity_count];\n";
    rates += fmt::format("  ::{}::forward_dynamics(model(), state, to_input(u), zd);\n", name);
    rates += "  write(zd, zdot, Model::velocity_count);\n";
    if (!scene.has_rate()) rates += "  write(state.z, ydot, Model::velocity_count);\n";
  }
  if (with_position_rate) {
    rates +=
        fmt::format("  Real yd[Model::position_count];\n  ::{}::position_rate(model(), state, yd);\n", name);
    rates += "  write(yd, ydot, Model::position_count);\n";
  }
  const bool is_long = number.parts > 1;
  const bool with_derivatives = !is_long && has(compiled, FunctionId::kForwardDynamicsDerivatives);
  std::string derivatives;
  if (with_derivatives)
    derivatives = fmt::format(
        "void derivatives(const double* t, const double* y, const double* z, const double* u, double* "
        "zdot_y, "
        "double* zdot_z) {{\n  constexpr int nz = Model::velocity_count;\n  static Real zd[nz], "
        "by_y[nz][nz], by_z[nz][nz];\n"
        "  ::{}::forward_dynamics_derivatives(model(), to_state(t, y, z), to_input(u), zd, by_y, by_z);\n"
        "  write(*by_y, zdot_y, nz * nz);\n  write(*by_z, zdot_z, nz * nz);\n}}\n\n",
        name);
  if (has(compiled, FunctionId::kInverseDynamics))
    inverse = fmt::format(
        "  Real zd[Model::velocity_count], forces[Model::velocity_count];\n"
        "  read(zd, zdot, Model::velocity_count);\n"
        "  ::{}::inverse_dynamics(model(), to_state(t, y, z), {}zd, forces);\n"
        "  write(forces, tau, Model::velocity_count);\n",
        name, compiled.facts.motions_take_inputs ? "Model::Input{}, " : "");
  const bool with_outputs = has(compiled, FunctionId::kOutputs);
  if (with_outputs)
    outputs = fmt::format(
        "\n// An Outputs is numbers only, one after the other.\n"
        "void outputs(const double* t, const double* y, const double* z, const double* u, double* "
        "values) {{\n  Model::Outputs result;\n  ::{}::outputs(model(), to_state(t, y, z), "
        "to_input(u), result);\n  write(reinterpret_cast<const Real*>(&result), values, "
        "sizeof result / sizeof(Real));\n}}\n",
        name);
  return emit::fill(
      emit::template_text("shim.cpp.in"),
      {{"NAME", name},
       {"REAL", number.type},
       {"INCLUDE", number.include},
       {"PARTS", fmt::format("{}", number.parts)},
       {"READ_STATE", copy(scene.positions.size(), "  read(state.y, y, Model::position_count);\n") +
                          copy(scene.velocities.size(), "  read(state.z, z, Model::velocity_count);\n")},
       {"WRITE_STATE", copy(scene.positions.size(), "  write(state.y, y, Model::position_count);\n") +
                           copy(scene.velocities.size(), "  write(state.z, z, Model::velocity_count);\n")},
       {"READ_INPUT", copy(scene.inputs.size(), "  if (u) read(input.u, u, Model::input_count);\n")},
       {"READ_PARAMETERS", parameters},
       {"STEPPERS", steppers},
       {"RATES", rates},
       {"INVERSE", inverse},
       {"DERIVATIVES", derivatives},
       {"DERIVATIVES_POINTER", with_derivatives ? "derivatives" : "nullptr"},
       {"OUTPUTS", outputs},
       {"LOOPS", loop_functions(name, compiled)},
       {"LOOP_ENTRIES",
        scene.constraints.empty()
            ? "0, nullptr, nullptr, nullptr, 0, 0, nullptr"
            : fmt::format("Model::constraint_count, ::{}::constraint_names, constraint_residual, "
                          "correct, Model::least_regularity, Model::greatest_opening, closing",
                          name)},
       {"METHODS", methods},
       {"OUTPUT_COUNT", with_outputs ? "sizeof(Model::Outputs) / sizeof(Real)" : "0"},
       {"UNIT_ROUNDOFF", number.unit_roundoff},
       {"METHOD_COUNT", fmt::format("{}", method_count)},
       {"DYNAMICS_OPERATIONS", fmt::format("{}L", dynamics + rate)},
       {"OUTPUTS_POINTER", with_outputs ? "outputs" : "nullptr"}});
}

}  // namespace

std::vector<std::string> machine_compiler() {
  const char* chosen = std::getenv("CXX");
  std::istringstream words(chosen ? chosen : "");
  std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
  return command.empty() ? std::vector<std::string>{"c++"} : command;
}

std::vector<std::string> loadable_functions(const std::vector<std::string>& steppers) {
  std::vector<std::string> functions;
  for (const FunctionId function :
       {FunctionId::kInitialState, FunctionId::kPositionRate, FunctionId::kForwardDynamics,
        FunctionId::kInverseDynamics, FunctionId::kKineticEnergy, FunctionId::kPotentialEnergy,
        FunctionId::kOutputs, FunctionId::kCloseLoops, FunctionId::kProject, FunctionId::kConstraintResidual})
    functions.push_back(ir::name_of(function));
  for (const std::string& stepper : steppers) functions.push_back(stepper + "_step");
  return functions;
}

std::vector<std::string> compiler_command(NumberType number) {
  std::vector<std::string> command = machine_compiler();
  command.emplace_back("-std=c++17");
  const NumberText text = text_of(number);
  command.insert(command.end(), text.compiler_options.begin(), text.compiler_options.end());
  return command;
}

namespace {

/// Operations. Optimising thousands of CLN's calls in one function takes minutes, and saves a tenth of the time.
constexpr long kLongestOptimised = 2000;

long largest_function(const CompiledModel& compiled) {
  std::size_t largest = 0;
  for (const ir::Program& program : compiled.module.functions)
    if (program.name != ir::name_of(FunctionId::kForwardDynamicsDerivatives))
      largest = std::max(largest, ir::count_operations(program).arithmetic());
  return static_cast<long>(largest);
}

}  // namespace

studies::LoadedModel build_model(const std::string& name, const CompiledModel& compiled, NumberType number) {
  const support::TemporaryFolder folder;
  const auto in_folder = [&folder](const std::string& file) { return folder.path() + "/" + file; };
  const NumberText text = text_of(number);
  for (const emit::File& file : compiled.files) support::write_file(in_folder(file.name), file.text);
  for (const char* header : {"model_table.h", "long_real.hpp"})
    support::write_file(in_folder(header), emit::template_text(header));
  support::write_file(in_folder("shim.cpp"), shim(name, text, compiled));
  std::vector<std::string> command = compiler_command(number);
  if (number == NumberType::kLong && largest_function(compiled) > kLongestOptimised) command.push_back("-O0");
  for (const std::string& argument : {std::string("-fPIC"), std::string("-shared"), in_folder("shim.cpp"),
                                      std::string("-o"), in_folder("model.so")})
    command.push_back(argument);
  command.insert(command.end(), text.link_options.begin(), text.link_options.end());
  const support::ProcessResult result = support::run_process(command);
  if (result.status != 0)
    throw support::EnvironmentError(fmt::format("'{}' cannot compile the emitted code (exit status {}):\n{}",
                                                fmt::join(machine_compiler(), " "), result.status,
                                                result.output.substr(0, 2000)));
  return studies::LoadedModel(in_folder("model.so"));
}

std::string compiler_text(NumberType number) {
  std::string text = fmt::format("{}", fmt::join(machine_compiler(), " "));
  for (const std::string& option : text_of(number).compiler_options) text += " " + option;
  return text;
}

}  // namespace jourdain::commands
