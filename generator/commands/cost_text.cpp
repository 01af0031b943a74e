#include "commands/cost_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "emit/body.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;
using studies::Quantiles;
using studies::StepCost;
using studies::time_text;

std::string name_of(const CostReport& report, const StepCost& step) {
  return report.table.methods[step.method].name;
}

const CodeCost* code_of(const CostReport& report, const std::string& function) {
  if (!report.code) return nullptr;
  const auto found = report.code->find(function);
  return found == report.code->end() ? nullptr : &found->second;
}

std::string bytes_cells(const CodeCost* code) {
  return code ? fmt::format("{:>7} {:>7}", code->stack, code->code) : fmt::format("{:>7} {:>7}", "-", "-");
}

/// Behind a row: what few models have.
std::string others(const ir::Operations& c) {
  std::string text;
  if (c.functions > 0) text += fmt::format("  and {} of exp, log, sinh, cosh, tanh, pow", c.functions);
  if (c.selections > 0) text += fmt::format("  and {} selections", c.selections);
  return text;
}

std::string program_row(const CostReport& report, const std::string& label, const std::string& name,
                        const ir::Operations& c) {
  return fmt::format("  {:<28} {:>6} {:>6} {:>6} {:>6} {:>4} {:>4} {:>4} {:>4} {:>4} {:>5} {}{}\n", label,
                     c.arithmetic(), c.multiply, c.add, c.subtract, c.divide, c.sqrt, c.negate, c.sin, c.cos,
                     c.atan2, bytes_cells(code_of(report, name)), others(c));
}

std::string functions_table(const CostReport& report) {
  std::string text = fmt::format(
      "  {:<28} {:>6} {:>6} {:>6} {:>6} {:>4} {:>4} {:>4} {:>4} {:>4} {:>5} {:>7} {:>7}\n", "operations",
      "all", "mul", "add", "sub", "div", "sqrt", "neg", "sin", "cos", "atan2", "stack", "code");
  text +=
      program_row(report, "Model (once)", "model", ir::count_operations(report.compiled.module.constants));
  for (const ir::Program& program : report.compiled.module.functions)
    text += program_row(report, program.name, program.name, ir::count_operations(program));
  for (const StepCost& step : report.steps) {
    const jourdain_method& method = report.table.methods[step.method];
    const std::string function = std::string(method.name) + "_step";
    text +=
        fmt::format("  {:<28} {:>6} {:<46}{}\n", function, method.operations,
                    fmt::format("in {} evaluation{}", method.evaluations, method.evaluations == 1 ? "" : "s"),
                    bytes_cells(code_of(report, function)));
  }
  return text + "  operations are exact; stack and code are bytes, of the function with all that it calls\n";
}

std::string microseconds(double seconds) { return fmt::format("{:.3g}", seconds * 1e6); }

std::string ratio_text(const std::optional<double>& ratio) {
  return ratio ? fmt::format("{:.2f}", *ratio) : "-";
}

std::string times_table(const CostReport& report) {
  constexpr const char* kRow = "  {:<23} {:>8} {:>8} {:>8} {:>8} {:>9} {:>8} {:>7} {:>7} {:>7} {:>7}\n";
  std::string text = fmt::format(
      "\n  single steps of {}, us, measured; the clock ticks every {}\n  {:<23} {:^35} {:^18} {:^31}\n",
      time_text(report.h), time_text(report.clock_tick), "", "warm", "cold", "times the usual");
  text += fmt::format(kRow, "method", "median", "99 %", "99.9 %", "worst", "median", "worst", "faint",
                      "flushed", "1e3 rad", "1e6 rad");
  for (const StepCost& s : report.steps)
    text += fmt::format(kRow, name_of(report, s), microseconds(s.warm.median), microseconds(s.warm.q99),
                        microseconds(s.warm.q999), microseconds(s.warm.worst), microseconds(s.cold.median),
                        microseconds(s.cold.worst), ratio_text(s.subnormal), ratio_text(s.flushed),
                        ratio_text(s.thousand), ratio_text(s.million));
  return text;
}

/// The method that most take first.
const StepCost& usual_step(const CostReport& report) {
  for (const StepCost& step : report.steps)
    if (name_of(report, step) == "rk4") return step;
  return report.steps.front();
}

std::string operations_remark(const CostReport& report, const StepCost& step) {
  return fmt::format(
      "every {0}_step does the same {1} arithmetic operations, whatever the state and however often: counted "
      "in the "
      "emitted code, exact{2}",
      name_of(report, step), report.table.methods[step.method].operations,
      emit::any_turns_with_time(report.compiled.module)
          ? ", but that a sine or cosine of what follows from time is none of them and takes several"
          : "");
}

std::string memory_remark(const CostReport& report) {
  if (!report.code)
    return fmt::format(
        "stack and code are not known: '{}' draws no graph of calls (-fcallgraph-info); set CXX=g++",
        report.head.compiler);
  std::string deepest;
  long stack = 0;
  for (const auto& [name, cost] : *report.code)
    if (cost.stack > stack) stack = cost.stack, deepest = name;
  return fmt::format(
      "no function needs more than {} bytes of stack ({}), with all of the model's functions that it calls: "
      "exact for "
      "this compiler and these options; libm's own, which the compiler does not see, come on top",
      stack, deepest);
}

std::string warm_remark(const CostReport& report, const StepCost& step) {
  return fmt::format(
      "99.9 % of {} warm {} steps, one after the other, took less than {}, the longest {} with whatever else "
      "the machine did meanwhile: on this machine, measured; it is no bound",
      step.warm.count, name_of(report, step), time_text(step.warm.q999), time_text(step.warm.worst));
}

/// Methods whose motion did not stay finite; empty where all did.
std::string restart_remark(const CostReport& report) {
  std::vector<std::string> names;
  for (const StepCost& step : report.steps)
    if (step.restarts > 0)
      names.push_back(fmt::format("{} ({} times)", name_of(report, step), step.restarts));
  if (names.empty()) return "";
  return fmt::format(
      "steps of this length diverged, and the motion began anew from its start: {}. Their times are of steps "
      "that are too long, which may take other times: give a shorter --step",
      fmt::join(names, ", "));
}

std::string cold_remark(const CostReport& report, const StepCost& step) {
  const std::size_t last = studies::last_cache(), read = studies::evicting_bytes();
  const std::string stayed =
      read < 2 * last
          ? fmt::format("data may have stayed in a last-level cache that the system says has {} MiB, ",
                        last >> 20)
          : "";
  return fmt::format(
      "a {} step whose data was evicted from caches took {} in the median of {}, {} at most: plan with that "
      "where a step runs once per period among other work. {} MiB were read and written before each; {}code "
      "may have stayed in the first-level instruction cache. Measured; it is no bound",
      name_of(report, step), time_text(step.cold.median), step.cold.count, time_text(step.cold.worst),
      read >> 20, stayed);
}

/// The largest of a ratio over the methods, with the method: "1.21 (rk4)".
template <class Member>
std::string largest_ratio(const CostReport& report, Member member) {
  const StepCost* worst = nullptr;
  for (const StepCost& step : report.steps)
    if (!worst || member(step) > member(*worst)) worst = &step;
  return fmt::format("{:.2f} times ({})", member(*worst), name_of(report, *worst));
}

std::string faint_remark(const CostReport& report) {
  const auto faint = [](const StepCost& s) { return s.subnormal; };
  const auto flushed = [](const StepCost& s) { return *s.flushed; };
  const std::string also =
      report.steps.front().flushed
          ? fmt::format("; with subnormal numbers flushed to zero (FTZ and DAZ of MXCSR) {}",
                        largest_ratio(report, flushed))
          : std::string("; flushing them to zero was not tried on this processor");
  return fmt::format(
      "near rest, with velocities of {:g} whose products are subnormal numbers (\"faint\"), a step took up "
      "to {} the "
      "usual time{}: measured, medians over blocks",
      studies::faint_velocity(report.table.unit_roundoff), largest_ratio(report, faint), also);
}

std::string angle_remark(const CostReport& report) {
  return fmt::format(
      "after 1e3 rad of whole turns on all angles a step took up to {}, after 1e6 rad up to {} the usual "
      "time, for "
      "reducing the arguments of sines and cosines: measured; whoever wraps angles does not pay it",
      largest_ratio(report, [](const StepCost& s) { return *s.thousand; }),
      largest_ratio(report, [](const StepCost& s) { return *s.million; }));
}

/// Sentences on what the numbers say.
std::vector<std::string> remarks(const CostReport& report) {
  const StepCost& usual = usual_step(report);
  std::vector<std::string> list = {operations_remark(report, usual), memory_remark(report),
                                   warm_remark(report, usual), cold_remark(report, usual),
                                   faint_remark(report)};
  if (usual.thousand) list.push_back(angle_remark(report));
  if (const std::string diverged = restart_remark(report); !diverged.empty())
    list.insert(list.begin(), diverged);
  return list;
}

Json operations_json(const ir::Operations& c) {
  return {{"arithmetic", c.arithmetic()},
          {"add", c.add},
          {"sub", c.subtract},
          {"mul", c.multiply},
          {"div", c.divide},
          {"sqrt", c.sqrt},
          {"neg", c.negate},
          {"sin", c.sin},
          {"cos", c.cos},
          {"atan2", c.atan2},
          {"functions", c.functions},
          {"selections", c.selections}};
}

void add_bytes(Json& entry, const CodeCost* code) {
  entry["stack_bytes"] = code ? Json(code->stack) : Json(nullptr);
  entry["code_bytes"] = code ? Json(code->code) : Json(nullptr);
}

Json functions_json(const CostReport& report) {
  Json functions = Json::array();
  const auto add = [&](const std::string& name, const ir::Program& program) {
    Json entry = {{"name", name}, {"operations", operations_json(ir::count_operations(program))}};
    add_bytes(entry, code_of(report, name));
    functions.push_back(std::move(entry));
  };
  add("model", report.compiled.module.constants);
  for (const ir::Program& program : report.compiled.module.functions) add(program.name, program);
  return functions;
}

Json quantiles_json(const Quantiles& q) {
  return {{"steps", q.count},
          {"median_s", q.median},
          {"99_percent_s", q.q99},
          {"99.9_percent_s", q.q999},
          {"worst_s", q.worst}};
}

Json steps_json(const CostReport& report) {
  const auto optional = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  Json steps = Json::array();
  for (const StepCost& s : report.steps) {
    const jourdain_method& method = report.table.methods[s.method];
    Json entry = {{"name", std::string(method.name) + "_step"},
                  {"operations", method.operations},
                  {"evaluations", method.evaluations}};
    add_bytes(entry, code_of(report, entry["name"]));
    entry["measured"] = {{"restarts", s.restarts},
                         {"warm", quantiles_json(s.warm)},
                         {"cold", quantiles_json(s.cold)},
                         {"subnormal_ratio", s.subnormal},
                         {"subnormal_flushed_ratio", optional(s.flushed)},
                         {"angle_1e3_ratio", optional(s.thousand)},
                         {"angle_1e6_ratio", optional(s.million)}};
    steps.push_back(std::move(entry));
  }
  return steps;
}

}  // namespace

std::string cost_text(const CostReport& report) {
  const studies::ReportHead& head = report.head;
  std::string text = fmt::format("{} in {}, {}\n", head.name, head.real, head.compiler) +
                     functions_table(report) + times_table(report) + "\n";
  for (const std::string& remark : remarks(report)) text += studies::wrapped(remark);
  return text;
}

std::string cost_json(const CostReport& report) {
  const studies::ReportHead& head = report.head;
  const Json json = {{"generator", head.generator},
                     {"name", head.name},
                     {"model", head.path},
                     {"sha256", head.sha256},
                     {"number_type", head.real},
                     {"compiler", head.compiler},
                     {"functions", functions_json(report)},
                     {"step_s", report.h},
                     {"clock_tick_s", report.clock_tick},
                     {"evicting_bytes", studies::evicting_bytes()},
                     {"faint_velocity", studies::faint_velocity(report.table.unit_roundoff)},
                     {"steps", steps_json(report)},
                     {"remarks", remarks(report)}};
  return json.dump(1) + "\n";
}

}  // namespace jourdain::commands
