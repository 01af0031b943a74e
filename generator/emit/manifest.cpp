#include "emit/manifest.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "emit/called_functions.hpp"
#include "emit/unique_names.hpp"
#include "emit/what_depends.hpp"

namespace jourdain::emit {

namespace {

std::string string_array(const std::vector<std::string>& entries) {
  std::string text;
  for (const std::string& entry : entries)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", quoted_text(entry));
  return "[" + text + "]";
}

std::string files_array(const std::vector<support::FileHash>& files) {
  std::string text;
  for (const support::FileHash& file : files)
    text += fmt::format(R"({}{{"model": "{}", "sha256": "{}"}})", text.empty() ? "" : ", ",
                        quoted_text(file.path), file.sha256);
  return "[" + text + "]";
}

std::string operations_object(const ir::Operations& count) {
  return fmt::format(
      R"({{"arithmetic": {}, "add": {}, "sub": {}, "mul": {}, "div": {}, "sqrt": {}, "neg": {}, "sin": {}, "cos": {}{}{}{}}})",
      count.arithmetic(), count.add, count.subtract, count.multiply, count.divide, count.sqrt, count.negate,
      count.sin, count.cos, count.atan2 == 0 ? "" : fmt::format(R"(, "atan2": {})", count.atan2),
      count.functions == 0 ? "" : fmt::format(R"(, "functions": {})", count.functions),
      count.selections == 0 ? "" : fmt::format(R"(, "selections": {})", count.selections));
}

std::string ranges_object(const std::vector<loops::ProvenRange>& ranges,
                          const std::vector<std::string>& names) {
  std::string text;
  for (const loops::ProvenRange& range : ranges)
    text += fmt::format("{}\"{}\": [{}, {}]", text.empty() ? "" : ", ", quoted_text(names[range.index]),
                        range.low, range.high);
  return "{" + text + "}";
}

std::string number_array(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{}", text.empty() ? "" : ", ", value);
  return "[" + text + "]";
}

std::string called_array(const std::vector<support::CalledFunction>& called) {
  std::string text;
  for (const support::CalledFunction& function : called)
    text += fmt::format(R"({}{{"name": "{}", "arguments": {}}})", text.empty() ? "" : ", ", function.member(),
                        string_array(function.arguments));
  return "[" + text + "]";
}

/// One line for each variable.
std::string variables_array(const ModelText& model, const ir::Module& module) {
  std::string text;
  for (const programs::Variable& variable : model.variables) {
    text += fmt::format(R"({}    {{"name": "{}", "role": "{}", "index": {}, "quantity": "{}", "unit": "{}")",
                        text.empty() ? "" : ",\n", quoted_text(variable.name), role_name(variable.role),
                        variable.index, quantity_name(variable.quantity), quoted_text(variable.unit));
    if (variable.is_array)
      text += fmt::format(R"(, "rows": {}, "columns": {}, "numbers": {})", variable.rows, variable.columns,
                          string_array(variable.numbers));
    if (!variable.start.empty()) text += fmt::format(R"(, "start": {})", number_array(variable.start));
    if (variable.range) text += fmt::format(R"(, "range": {})", number_array(*variable.range));
    if (variable.derivative_of)
      text += fmt::format(R"(, "derivative_of": "{}")",
                          quoted_text(model.variables[*variable.derivative_of].name));
    const std::vector<std::string> read = what_depends(variable, model.facts, module);
    if (!read.empty()) text += fmt::format(R"(, "depends_on": {})", string_array(read));
    text += fmt::format(R"(, "description": "{}"}})", quoted_text(variable.description));
  }
  return text.empty() ? "[]" : "[\n" + text + "\n  ]";
}

}  // namespace

std::string manifest(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module, const std::vector<StepRecord>& steps) {
  std::string text = "{\n";
  const auto field = [&text](const std::string& key, const std::string& value) {
    text += fmt::format("  \"{}\": {},\n", key, value);
  };
  const auto string = [](const std::string& value) { return "\"" + quoted_text(value) + "\""; };
  std::vector<std::string> parameters, names;
  std::string values, ranges;
  for (const model::Parameter& parameter : model.facts.parameters) {
    parameters.push_back(parameter.name);
    values += fmt::format("{}{}", values.empty() ? "" : ", ", parameter.value);
    if (const auto& range = parameter.range)
      ranges += fmt::format("{}{}: [{}, {}]", ranges.empty() ? "" : ", ", string(parameter.name), (*range)[0],
                            (*range)[1]);
  }
  for (const programs::FunctionInfo& function : functions) names.push_back(function.name);
  field("generator", string(fmt::format("Jourdain {}", kVersion)));
  field("name", string(model.name));
  field("title", string(model.title));
  field("model", string(model.path));
  field("sha256", string(model.sha256));
  if (!model.imported.empty()) field("imported", files_array(model.imported));
  if (!model.options.empty()) field("options", string_array(model.options));
  field("position_count", fmt::format("{}", model.facts.positions.size()));
  field("velocity_count", fmt::format("{}", model.facts.velocities.size()));
  field("input_count", fmt::format("{}", model.facts.inputs.size()));
  field("output_count", fmt::format("{}", model.facts.outputs.size()));
  field("parameter_count", fmt::format("{}", model.facts.parameters.size()));
  field("positions", string_array(model.facts.positions));
  field("velocities", string_array(model.facts.velocities));
  if (!model.facts.constraints.empty()) {
    const auto named = [&](const std::vector<std::size_t>& entries) {
      std::vector<std::string> list;
      for (const std::size_t entry : entries) list.push_back(model.facts.positions[entry]);
      return string_array(list);
    };
    field("constraints", string_array(model.facts.constraints));
    field("dependent_positions", named(model.facts.dependents));
    if (!model.facts.carried.empty()) field("carried_positions", named(model.facts.carried));
    field("least_regularity", fmt::format("{}", model.least_regularity));
    field("greatest_opening", fmt::format("{}", model.greatest_opening));
    if (!model.proven.positions.empty())
      field("proven_ranges", ranges_object(model.proven.positions, model.facts.positions));
    if (!model.proven.parameters.empty())
      field("proven_parameters", ranges_object(model.proven.parameters, parameters));
  }
  field("inputs", string_array(model.facts.inputs));
  std::vector<std::string> outputs;
  for (const programs::OutputFacts& output : model.facts.outputs) outputs.push_back(output.name);
  field("outputs", string_array(outputs));
  field("parameters", string_array(parameters));
  field("parameter_values", "[" + values + "]");
  if (!ranges.empty()) field("parameter_ranges", "{" + ranges + "}");
  field("variables", variables_array(model, module));
  field("functions", string_array(names));
  if (const auto called = called_in(module); !called.empty()) field("user_functions", called_array(called));
  text += "  \"operations\": {\n";
  text += fmt::format("    \"model\": {}", operations_object(ir::count_operations(module.constants)));
  for (const ir::Program& program : module.functions)
    text += fmt::format(",\n    \"{}\": {}", program.name, operations_object(ir::count_operations(program)));
  text += "\n  },\n";
  text += "  \"steps\": {";
  const char* separator = "\n";
  for (const StepRecord& step : steps) {
    text += fmt::format(R"({}    "{}_step": {{"order": {}, "evaluations": {}, "operations": {}}})", separator,
                        step.stepper->name, step.stepper->order_with(model.facts.has_whole_derivatives()),
                        step.stepper->evaluations, step.operations);
    separator = ",\n";
  }
  text += steps.empty() ? "},\n" : "\n  },\n";
  field("assumptions", string_array(model.assumptions));
  field("left_out", string_array(model.left_out));
  field("backward_error", fmt::format("{:.2g}", model.backward_error));
  // JSON has no infinity.
  const std::string condition =
      std::isfinite(model.condition) ? fmt::format("{:.2g}", model.condition) : "null";
  text += fmt::format("  \"condition\": {}\n}}\n", condition);
  return text;
}

}  // namespace jourdain::emit
