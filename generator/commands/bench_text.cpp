#include "commands/bench_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "emit/body.hpp"
#include "emit/operations.hpp"
#include "report/text_table.hpp"
#include "studies/report.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kNanosecond = 1e-9;

/// What is counted in the emitted code; of steps arithmetic alone.
struct Counted {
  long operations = 0;
  std::optional<long> sines;  ///< sines and cosines
};

Counted counted(const CompiledModel& compiled, const std::string& function) {
  for (const ir::Program& program : compiled.module.functions)
    if (program.name == function) {
      const ir::Operations c = ir::count_operations(program);
      return {static_cast<long>(c.arithmetic()), static_cast<long>(c.sin + c.cos)};
    }
  for (const emit::StepRecord& record :
       emit::step_records(compiled.facts, compiled.functions, compiled.module))
    if (record.stepper->name + "_step" == function) return {record.operations, {}};
  return {};
}

std::string time_cell(double seconds) { return fmt::format("{:.1f}", seconds / kNanosecond); }

std::string table(const BenchReport& report) {
  report::TextTable table({"function", ">operations", ">sin, cos", ">ns, least", ">ns, median", ">floor",
                           ">over it", ">instructions", ">at least", ">at most", ">bytes"});
  for (const BenchRow& row : report.result.rows) {
    const Counted c = counted(report.compiled, row.name);
    const auto& n = row.instructions;
    const bool differs = n && n->least < n->most;
    table.add({row.name, fmt::format("{}", c.operations), c.sines ? fmt::format("{}", *c.sines) : "",
               time_cell(row.fastest), time_cell(row.median), row.floor ? time_cell(row.floor->time) : "",
               row.floor && row.floor->time > 0 ? fmt::format("{:.2f}", row.fastest / row.floor->time) : "",
               n ? fmt::format("{:.0f}", n->mean) : "", differs ? fmt::format("{}", n->least) : "",
               differs ? fmt::format("{}", n->most) : "", row.code ? fmt::format("{}", *row.code) : ""});
  }
  return table.text();
}

std::string options_text(const BenchChoices& choices) {
  return choices.flags.empty() ? "no options" : fmt::format("{}", fmt::join(choices.flags, " "));
}

std::vector<std::string> remarks(const BenchReport& report) {
  const BenchChoices& choices = report.choices;
  std::vector<std::string> list = {
      fmt::format(
          "operations are additions, products, quotients and square roots of one call: counted in the "
          "emitted code, exact, the same whatever the state{}",
          emit::any_turns_with_time(report.compiled.module)
              ? "; a sine or cosine of what follows from time is none of them and takes several"
              : ""),
      fmt::format(
          "times are of one call, with the call itself, in {} blocks of about {} that take turns over the "
          "functions: of the fastest block and of the middle one. They are of this machine and this minute: "
          "compare them within one table",
          choices.blocks, studies::time_text(choices.block_length)),
      fmt::format("{} states are drawn from seed {}{}; steps are {} long and go on from each of them, other "
                  "functions take them in turn",
                  choices.states, choices.seed,
                  report.loaded.plan() ? " near the start, and closed" : " in the coordinates' ranges",
                  studies::time_text(choices.step)),
      "bytes of code are of the function with all of the model's functions that it calls, without tables and "
      "libm's"};
  for (const BenchRow& row : report.result.rows)
    if (row.floor) {
      list.push_back(
          "floor, ns: of the floating-point sums, products, quotients and roots of a call, sines with them, "
          "as the "
          "compiler wrote them (counted in single steps), at the rate of instructions that do not wait for "
          "each other, "
          "measured in the same blocks; the unit that is busy longest counts, all else is taken to be free. "
          "Over it: "
          "the fastest block");
      break;
    }
  const auto add_once = [&](const auto& is_so, const char* remark) {
    if (std::any_of(report.result.rows.begin(), report.result.rows.end(), is_so)) list.emplace_back(remark);
  };
  add_once([](const BenchRow& row) { return !row.code; },
           "bytes are not known of functions whose code the compiler leaves to the linker (-flto)");
  add_once([](const BenchRow& row) { return row.x87; },
           "functions that compute in x87's registers have no floor: that arithmetic is not counted");
  for (const BenchRow& row : report.result.rows)
    if (row.floor && row.floor->outside > 0)
      list.push_back(fmt::format("of {}, {:.0f} instructions a call are of libraries and not in the floor",
                                 row.name, row.floor->outside));
  bool is_counted = false;
  for (const BenchRow& row : report.result.rows) is_counted = is_counted || row.instructions;
  list.push_back(
      is_counted ? fmt::format("instructions are of one call with libm's, the mean over the "
                               "states and the ends where they differ: counted by {}, exact for this code",
                               report.result.counter)
                 : report.result.counter);
  for (const BenchRow& row : report.result.rows)
    if (row.finite < choices.states)
      list.push_back(
          fmt::format("{} gives numbers that are not finite at {} of the states: its time may be "
                      "another where all are",
                      row.name, choices.states - row.finite));
  return list;
}

}  // namespace

std::string bench_text(const BenchReport& report) {
  std::string text = fmt::format("{} in {}\n  {}\n  {}, -std=c++17 {}\n\n", report.loaded.options.name,
                                 report.choices.is_float ? "float" : "double", report.result.processor,
                                 report.result.compiler, options_text(report.choices));
  text += table(report) + "\n";
  for (const std::string& remark : remarks(report)) text += studies::wrapped(remark);
  return text;
}

std::string bench_json(const BenchReport& report) {
  const CompileOptions& options = report.loaded.options;
  const BenchChoices& choices = report.choices;
  Json functions = Json::array();
  for (const BenchRow& row : report.result.rows) {
    const Counted c = counted(report.compiled, row.name);
    const auto& n = row.instructions;
    Json measured = {{"calls_in_a_block", row.calls}, {"least_s", row.fastest}, {"median_s", row.median}};
    if (row.floor) measured["floor_s"] = row.floor->time;
    functions.push_back(
        {{"name", row.name},
         {"operations", c.operations},
         {"sin_and_cos", c.sines ? Json(*c.sines) : Json()},
         {"measured", measured},
         {"floating_point_instructions", row.floor ? Json(row.floor->arithmetic) : Json()},
         {"instructions_of_libraries", row.floor ? Json(row.floor->outside) : Json()},
         {"instructions", n ? Json({{"mean", n->mean}, {"least", n->least}, {"most", n->most}}) : Json()},
         {"code_bytes", row.code ? Json(*row.code) : Json()},
         {"finite_states", row.finite}});
  }
  const Json json = {{"generator", fmt::format("Jourdain {}", emit::kVersion)},
                     {"name", options.name},
                     {"model", options.path},
                     {"sha256", options.sha256},
                     {"number_type", choices.is_float ? "float" : "double"},
                     {"processor", report.result.processor},
                     {"compiler", report.result.compiler},
                     {"options", choices.flags},
                     {"instructions_by", report.result.counter},
                     {"states", choices.states},
                     {"seed", choices.seed},
                     {"blocks", choices.blocks},
                     {"block_s", choices.block_length},
                     {"step_s", choices.step},
                     {"functions", functions},
                     {"remarks", remarks(report)}};
  return json.dump(1) + "\n";
}

}  // namespace jourdain::commands
