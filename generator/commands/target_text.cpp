#include "commands/target_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "emit/operations.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;

/// A function or step with its arithmetic operations and what it takes.
struct Row {
  std::string name;
  long operations = 0;
  const TargetCost& cost;
};

/// The constructor, functions and steps, in the order of emission.
std::vector<Row> rows_of(const TargetReport& report) {
  const auto counted = [](const ir::Program& program) {
    return static_cast<long>(ir::count_operations(program).arithmetic());
  };
  const CompiledModel& compiled = report.compiled;
  std::vector<Row> rows = {{"model", counted(compiled.module.constants), report.costs.functions.at("model")}};
  for (const ir::Program& program : compiled.module.functions)
    if (const auto found = report.costs.functions.find(program.name); found != report.costs.functions.end())
      rows.push_back({program.name, counted(program), found->second});
  for (const emit::StepRecord& record :
       emit::step_records(compiled.facts, compiled.functions, compiled.module)) {
    const std::string name = record.stepper->name + "_step";
    rows.push_back({name, record.operations, report.costs.functions.at(name)});
  }
  return rows;
}

std::string sizes_text(const TargetReport& report) {
  std::string text = "  bytes of data:";
  for (const auto& [what, bytes] : report.costs.sizes) text += fmt::format(" {} {},", what, bytes);
  return text + fmt::format(" constants beside the code {}\n", report.costs.constants);
}

/// Sentences on what the numbers say.
std::vector<std::string> remarks(const TargetReport& report) {
  return {
      fmt::format("code and stack are what {} makes of each function with all of the model's functions that "
                  "it calls: exact for this compiler and these options, without the functions of {}",
                  report.target.tools + "g++", report.costs.library),
      "painted is the stack that one call has written, the library's functions among it: other states may "
      "take other ways through these",
      fmt::format(
          "instructions are counted by the simulator in one call from the described start, steps of "
          "{}, the library's among them: exact and the same in every run, for this state; they are no "
          "cycles. Steppers that remember have done three steps before",
          studies::time_text(report.step)),
  };
}

}  // namespace

std::string target_text(const TargetReport& report) {
  constexpr const char* kRow = "  {:<30} {:>10} {:>8} {:>8} {:>8} {:>12}\n";
  std::string text = fmt::format("{} in {} for {} ({})\n  {}\n  {}\n\n", report.head.name, report.head.real,
                                 report.target.name, report.target.processor, report.head.compiler,
                                 simulator_version(report.target));
  text += fmt::format(kRow, "", "operations", "code", "stack", "painted", "instructions");
  for (const Row& row : rows_of(report))
    text +=
        fmt::format(kRow, row.name == "model" ? "Model (once)" : row.name, row.operations, row.cost.code.code,
                    row.cost.code.stack, row.cost.painted_stack, row.cost.instructions);
  text += sizes_text(report) + "\n";
  for (const std::string& remark : remarks(report)) text += studies::wrapped(remark);
  return text;
}

std::string target_json(const TargetReport& report) {
  const studies::ReportHead& head = report.head;
  Json functions = Json::array(), sizes;
  for (const Row& row : rows_of(report))
    functions.push_back({{"name", row.name},
                         {"operations", row.operations},
                         {"code_bytes", row.cost.code.code},
                         {"stack_bytes", row.cost.code.stack},
                         {"painted_stack_bytes", row.cost.painted_stack},
                         {"instructions", row.cost.instructions}});
  for (const auto& [what, bytes] : report.costs.sizes) sizes[what] = bytes;
  const Json json = {{"generator", head.generator},
                     {"name", head.name},
                     {"model", head.path},
                     {"sha256", head.sha256},
                     {"number_type", head.real},
                     {"target", report.target.name},
                     {"compiler", compiler_version(report.target)},
                     {"options", target_compiler(report.target)},
                     {"library", report.costs.library},
                     {"simulator", simulator_version(report.target)},
                     {"step_s", report.step},
                     {"functions", functions},
                     {"data_bytes", sizes},
                     {"constant_bytes", report.costs.constants},
                     {"remarks", remarks(report)}};
  return json.dump(1) + "\n";
}

}  // namespace jourdain::commands
