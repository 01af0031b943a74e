#include "commands/target_cost.hpp"

#include <fmt/format.h>

#include <sstream>

#include "commands/tool.hpp"
#include "emit/templates.hpp"
#include "support/check.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

namespace {

const char* type_of(NumberType number) { return number == NumberType::kFloat ? "float" : "double"; }

/// The kernels with their functions in one number type alone.
std::string functions_source(const std::string& name, const CompiledModel& compiled, NumberType number) {
  const std::string real = type_of(number);
  std::string text = fmt::format(
      "#include \"{0}_kernels.hpp\"\ntemplate {0}::Model<{1}>::Model(const {0}::Parameters<{1}>&) "
      "noexcept;\n",
      name, real);
  for (const programs::FunctionInfo& function : compiled.functions)
    text += fmt::format("template decltype({0}::{1}<{2}>) {0}::{1}<{2}>;\n", name, function.name, real);
  return text;
}

/// Steps of a stepper with a memory before it runs as usual.
int earlier_steps(const programs::FunctionInfo& function) {
  constexpr int kFilled = 3;  // more than any history is long
  const programs::Stepper* stepper = function.stepper;
  return stepper && (stepper->history > 0 || stepper->implicit) ? kFilled : 0;
}

std::string program_source(const std::string& name, const CompiledModel& compiled, NumberType number,
                           const Target& target, const TargetStart& start, const std::string& constructor) {
  const programs::SceneFacts& scene = compiled.facts;
  std::string parameters, inputs, functions, sizes;
  for (std::size_t i = 0; i < scene.parameters.size(); ++i)
    parameters +=
        fmt::format("  parameters.{} = Real({});\n", scene.parameters[i].name, start.parameters.at(i));
  for (std::size_t i = 0; i < scene.inputs.size(); ++i)
    inputs += fmt::format("  input.u[{}] = Real({});\n", i, i < start.inputs.size() ? start.inputs[i] : 0.0);
  for (const char* type : {"Parameters", "State", "Input"})
    sizes += fmt::format("  write_size(\"{0}\", sizeof({0}));\n", type);
  for (const programs::FunctionInfo& function : compiled.functions) {
    functions +=
        fmt::format("  Measured<decltype(::{0}::{1}<Real>)>::report(\"{1}\", ::{0}::{1}<Real>, {2});\n", name,
                    function.name, earlier_steps(function));
    if (function.id == ir::FunctionId::kOutputs)
      sizes += "  write_size(\"Outputs\", sizeof(Model::Outputs));\n";
  }
  return emit::fill(emit::template_text("cost.cpp.in"), {{"NAME", name},
                                                         {"REAL", type_of(number)},
                                                         {"CONSTRUCTOR", constructor},
                                                         {"RETURN", target.return_instruction},
                                                         {"INPUTS", inputs},
                                                         {"STEP", fmt::format("{}", start.step)},
                                                         {"PARAMETERS", parameters},
                                                         {"SIZES", sizes},
                                                         {"FUNCTIONS", functions}});
}

/// Bytes of read-only data in what `size -A` lists: section, size, address.
long constants_of(const std::string& listing) {
  long bytes = 0;
  std::istringstream lines(listing);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string section;
    long size = 0;
    if (fields >> section >> size && (section.starts_with(".rodata") || section.starts_with(".srodata")))
      bytes += size;
  }
  return bytes;
}

/// Adds what the firmware says: "library NAME VERSION", "size WHAT BYTES", "function NAME STACK INSTRUCTIONS".
void read_counts(const std::string& output, TargetCosts& costs) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string kind, name;
    fields >> kind >> name;
    if (kind == "library") costs.library = line.substr(kind.size() + 1);
    if (kind == "size") fields >> costs.sizes.emplace_back(name, 0).second;
    if (kind != "function") continue;
    TargetCost& cost = costs.functions.at(name);
    fields >> cost.painted_stack >> cost.instructions;
    JD_CHECK(bool(fields), "unexpected line '{}'", line);
  }
}

}  // namespace

TargetCosts target_costs(const std::string& name, const CompiledModel& compiled, NumberType number,
                         const Target& target, const TargetStart& start) {
  check_tools(target);
  const support::TemporaryFolder folder;
  const auto in_folder = [&folder](const std::string& file) { return folder.path() + "/" + file; };
  for (const emit::File& file : compiled.files) support::write_file(in_folder(file.name), file.text);
  write_board(target, folder.path());
  support::write_file(in_folder("functions.cpp"), functions_source(name, compiled, number));
  TargetCosts costs;
  for (const auto& [function, code] :
       source_costs({target_compiler(target), target.tools + "nm"}, in_folder("functions.cpp"),
                    in_folder("functions"), function_signatures(name, compiled, number)))
    costs.functions[function].code = code;
  for (const programs::FunctionInfo& function : compiled.functions)
    JD_CHECK(costs.functions.count(function.name), "no code of {}", function.name);
  costs.constants = constants_of(run_tool({target.tools + "size", "-A", in_folder("functions.o")}));
  support::write_file(in_folder("cost.cpp"), program_source(name, compiled, number, target, start,
                                                            costs.functions.at("model").code.symbol));
  std::vector<std::string> command = target_compiler(target);
  for (const std::string& argument :
       {std::string("-c"), in_folder("cost.cpp"), std::string("-o"), in_folder("cost.o")})
    command.push_back(argument);
  run_tool(command);
  link_firmware(target, folder.path(), "cost", {in_folder("functions.o"), in_folder("cost.o")});
  read_counts(run_firmware(target, folder.path(), "cost"), costs);
  return costs;
}

}  // namespace jourdain::commands
