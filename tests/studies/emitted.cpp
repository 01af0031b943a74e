#include "studies/emitted.hpp"

#include <fmt/format.h>

#include "commands/build_model.hpp"
#include "model/read/read.hpp"
#include "programs/displaced_tangent.hpp"
#include "programs/steppers.hpp"
#include "support/check.hpp"
#include "support/files.hpp"

namespace jourdain::tests {

namespace {

std::vector<double> parameter_values(const model::Mechanism& mechanism) {
  std::vector<double> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(parameter.value);
  return values;
}

}  // namespace

void EmittedModel::set_parameter(const std::string& name, double value) {
  bool found = false;
  for (model::Parameter& parameter : mechanism.parameters)
    if (parameter.name == name) {
      parameter.value = value;
      found = true;
    }
  JD_CHECK(found, "no parameter {}", name);
  studies::set_parameters(table(), parameter_values(mechanism));
}

std::vector<std::string> all_loadable_functions() {
  std::vector<std::string> steppers;
  for (const programs::Stepper& stepper : programs::all_steppers()) steppers.push_back(stepper.name);
  std::vector<std::string> functions = commands::loadable_functions(steppers);
  functions.push_back("forward_dynamics_derivatives");
  return functions;
}

EmittedModel emitted_from(const model::Mechanism& mechanism, const std::vector<std::string>& functions) {
  CompileOptions options;
  static int count = 0;  // objects of one process share what has one name
  options.name = "emitted_model" + std::to_string(++count);
  options.functions = functions;
  const CompiledModel compiled = compile(mechanism, options);
  JD_CHECK(compiled.verdict.accepted(), "refused: {}", compiled.verdict.failures.front());
  EmittedModel result{mechanism, programs::displaced_tangent(compiled.facts),
                      commands::build_model(options.name, compiled, commands::NumberType::kDouble)};
  studies::set_parameters(result.table(), parameter_values(mechanism));
  return result;
}

EmittedModel emitted_from(const std::string& text, const std::vector<std::string>& functions) {
  support::Diagnostics diagnostics("model.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  JD_CHECK(mechanism.has_value(), "the test's model has {} diagnostics", diagnostics.all().size());
  return emitted_from(*mechanism, functions);
}

EmittedModel emitted_model(const std::string& name, const std::vector<std::string>& functions) {
  return emitted_from(support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/" + name + ".toml"),
                      functions);
}

std::size_t method_called(const jourdain_model_table& table, const std::string& name) {
  for (int m = 0; m < table.method_count; ++m)
    if (name == table.methods[m].name) return static_cast<std::size_t>(m);
  JD_CHECK(false, "no method {}", name);
  return 0;
}

std::string oscillator_text(double stiffness, double damping) {
  return fmt::format(
      "[model]\nname = \"oscillator\"\n[[body]]\nname = \"block\"\nmass = 1.0\n[[joint]]\nname = \"rail\"\n"
      "type = \"prismatic\"\nparent = \"world\"\nchild = \"block\"\naxis = [1, 0, 0]\nstiffness = {:.17e}\n"
      "damping = {:.17e}\ninitial_position = 0.1\n",
      stiffness, damping);
}

std::string bushing_chain_text(int count) {
  std::string text =
      "[model]\nname = \"bushing_chain\"\ngravity = [0, -9.81, 0]\n[parameters]\nk = 1e6\nc = 200.0\nbending "
      "= 20.0\n";
  for (int i = 1; i <= count; ++i)
    text += fmt::format(
        "[[body]]\nname = \"rod{0}\"\nmass = 0.5\ncenter_of_mass = [0.1, 0, 0]\n"
        "shape = {{ kind = \"rod\", length = 0.2, axis = \"x\" }}\n"
        "[[joint]]\nname = \"bush{0}\"\ntype = \"planar\"\nparent = \"{1}\"\nchild = \"rod{0}\"\nposition = "
        "[{2}, 0, 0]\n"
        "axis = [0, 0, 1]\nx = {{ stiffness = \"k\", damping = \"c\" }}\ny = {{ stiffness = \"k\", damping = "
        "\"c\" }}\n"
        "angle = {{ stiffness = \"bending\", damping = 0.05 }}\n",
        i, i == 1 ? "world" : fmt::format("rod{}", i - 1), i == 1 ? 0.0 : 0.2);
  return text;
}

}  // namespace jourdain::tests
