#include "commands/bench_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "commands/bench_states.hpp"
#include "commands/callgrind.hpp"
#include "commands/code_cost.hpp"
#include "commands/issue_kernels.hpp"
#include "commands/single_steps.hpp"
#include "commands/tool.hpp"
#include "emit/templates.hpp"
#include "support/check.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

namespace {

const char* type_of(const BenchChoices& choices) { return choices.is_float ? "float" : "double"; }

/// Functions that are measured: a run calls initial_state once.
std::vector<std::string> measured(const CompiledModel& compiled) {
  std::vector<std::string> names;
  for (const programs::FunctionInfo& function : compiled.functions)
    if (function.id != ir::FunctionId::kInitialState) names.push_back(function.name);
  return names;
}

std::string driver(const LoadedMechanism& loaded, const CompiledModel& compiled,
                   const BenchChoices& choices) {
  const programs::SceneFacts& scene = compiled.facts;
  const std::string& name = loaded.options.name;
  std::string functions, drawn, read, close;
  for (const std::string& function : measured(compiled)) functions += fmt::format(" X({})", function);
  for (const std::vector<double>& row :
       draw_bench_states(loaded.mechanism, loaded.plan(), choices.states, choices.seed))
    drawn += fmt::format("  {{{}}},\n", fmt::join(row, ", "));
  std::vector<std::string> finite;
  const auto member = [&](bool exists, const char* numbers) {
    if (exists) read += fmt::format("    values = read({}, values);\n", numbers);
  };
  member(!scene.positions.empty(), "state.y");
  member(!scene.velocities.empty(), "state.z");
  member(!scene.inputs.empty(), "inputs[i].u");
  if (!scene.positions.empty()) finite.emplace_back("all_finite(state.y)");
  if (!scene.velocities.empty()) finite.emplace_back("all_finite(state.z)");
  if (finite.empty()) finite.emplace_back("true");
  if (const std::string correction = programs::correction(scene); !correction.empty())
    close = fmt::format("    ::{}::{}(model, state);\n", name, correction);
  return emit::fill(emit::template_text("bench.cpp.in"),
                    {{"NAME", name},
                     {"REAL", type_of(choices)},
                     {"STATES", fmt::format("{}", choices.states)},
                     {"STEP", fmt::format("{}", choices.step)},
                     {"FUNCTIONS", functions},
                     {"DRAWN", drawn},
                     {"READ", read},
                     {"FINITE", fmt::format("{}", fmt::join(finite, " && "))},
                     {"CLOSE", close}});
}

std::string processor_text(const LoadedMechanism& loaded, const BenchChoices& choices) {
  const IssueKernels kernels = issue_kernels(choices.is_float);
  return emit::fill(emit::template_text("bench_processor.hpp.in"), {{"NAME", loaded.options.name},
                                                                    {"REAL", type_of(choices)},
                                                                    {"NUMBERS", kernels.numbers},
                                                                    {"ISSUE", kernels.functions},
                                                                    {"ISSUES", kernels.table}});
}

/// The words with more behind them.
std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> compiler_words(const BenchChoices& choices) {
  return joined(joined(choices.compiler, {"-std=c++17"}), choices.flags);
}

/// The model as its user compiles it, and what calls it; leaves model.o and the program "bench" in the folder.
void build(const LoadedMechanism& loaded, const CompiledModel& compiled, const BenchChoices& choices,
           const std::string& folder) {
  for (const emit::File& file : compiled.files) support::write_file(folder + "/" + file.name, file.text);
  support::write_file(folder + "/bench.cpp", driver(loaded, compiled, choices));
  support::write_file(folder + "/bench_processor.hpp", processor_text(loaded, choices));
  run_tool(joined(
      compiler_words(choices),
      {"-ffunction-sections", "-c", folder + "/" + loaded.options.name + ".cpp", "-o", folder + "/model.o"}));
  run_tool(joined(choices.compiler,
                  {"-std=c++17", "-O2", "-c", folder + "/bench.cpp", "-o", folder + "/bench.o"}));
  // Bound at its start, so that no call is counted with the search for a function of a library; not moved, so that
  // addresses are those of its disassembly.
  run_tool(joined(compiler_words(choices), {folder + "/bench.o", folder + "/model.o", "-Wl,-z,now", "-no-pie",
                                            "-o", folder + "/bench"}));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string processor_name() try {
  constexpr const char* kKey = "model name\t: ";
  const std::string text = support::read_file("/proc/cpuinfo");
  const std::size_t begin = text.find(kKey);
  if (begin == std::string::npos) return "unknown processor";
  return first_line(text.substr(begin + std::string(kKey).size()));
} catch (const support::EnvironmentError&) {
  return "unknown processor";
}

BenchRow& row_named(BenchResult& result, const std::string& name) {
  const auto found = std::find_if(result.rows.begin(), result.rows.end(),
                                  [&](const BenchRow& row) { return row.name == name; });
  JD_CHECK(found != result.rows.end(), "no function {}", name);
  return *found;
}

/// What the program says: "finite NAME STATES", "time NAME CALLS FASTEST MEDIAN", in nanoseconds; "issue NAME RATE", in
/// instructions a nanosecond. Returns the rates, a second.
std::map<std::string, double> read_times(const std::string& output, BenchResult& result) {
  constexpr double kNanosecond = 1e-9;
  std::map<std::string, double> rates;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string kind, name;
    fields >> kind >> name;
    if (kind == "issue") {
      double rate = 0;
      JD_CHECK(fields >> rate && rate > 0, "unexpected line '{}'", line);
      rates[name] = rate / kNanosecond;
      continue;
    }
    BenchRow& row = row_named(result, name);
    if (kind == "finite") {
      fields >> row.finite;
    } else {
      fields >> row.calls >> row.fastest >> row.median;
      row.fastest *= kNanosecond;
      row.median *= kNanosecond;
    }
    JD_CHECK(bool(fields), "unexpected line '{}'", line);
  }
  return rates;
}

/// Of all functions, where this machine steps.
std::map<std::string, SteppedCalls> step_functions(const std::string& program) {
  const support::ProcessResult steps = support::run_process({program, "steps"});
  if (steps.status != 0) return {};
  return read_steps(steps.output, run_tool({"objdump", "-d", "-C", "-w", "--no-show-raw-insn", program}),
                    "jourdain_bench::");
}

/// Names of the loops that have to be timed.
std::vector<std::string> rates_to_measure(const std::map<std::string, SteppedCalls>& stepped) {
  ArithmeticCounts all;
  for (const auto& [name, calls] : stepped) all.insert(calls.arithmetic.begin(), calls.arithmetic.end());
  return issue_names(all);
}

Floor floor_of(const SteppedCalls& stepped, const std::map<std::string, double>& rates) {
  Floor floor{0, stepped.outside, least_time(stepped.arithmetic, rates)};
  for (const auto& [instruction, count] : stepped.arithmetic) floor.arithmetic += count;
  return floor;
}

Instructions spread_of(const std::vector<double>& counts) {
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  return {std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size()),
          std::llround(*least), std::llround(*most)};
}

/// Calls of `signature` from functions of its own for each state.
std::optional<Instructions> instructions_of(const std::vector<CountedCalls>& counted,
                                            const std::string& function, const std::string& signature) {
  Instructions found{0, std::numeric_limits<long long>::max(), 0};
  long long calls = 0;
  for (const CountedCalls& c : counted) {
    if (c.caller.find("::count_" + function + "<") == std::string::npos ||
        c.callee.find(signature) == std::string::npos)
      continue;
    calls += c.calls;
    found.mean += static_cast<double>(c.instructions);
    found.least = std::min(found.least, c.instructions / c.calls);
    found.most = std::max(found.most, c.instructions / c.calls);
  }
  if (calls == 0) return {};
  found.mean /= static_cast<double>(calls);
  return found;
}

/// By callgrind, where it can; else those of single steps.
void count_instructions(const std::string& folder, const std::map<std::string, std::string>& signatures,
                        const std::map<std::string, SteppedCalls>& stepped, BenchResult& result) {
  const std::optional<std::string> version = valgrind_version();
  const std::optional<std::vector<CountedCalls>> counted =
      version ? count_calls(folder + "/bench", folder) : std::nullopt;
  if (counted) {
    result.counter = *version + ", callgrind";
    for (BenchRow& row : result.rows)
      row.instructions = instructions_of(*counted, row.name, signatures.at(row.name));
    return;
  }
  result.counter = version ? *version + " cannot run this code" : "valgrind is not installed";
  result.counter += stepped.empty() ? ": instructions are not counted" : ": the processor's single steps";
  for (const auto& [name, calls] : stepped)
    row_named(result, name).instructions = spread_of(calls.instructions);
}

}  // namespace

BenchResult measure_functions(const LoadedMechanism& loaded, const CompiledModel& compiled,
                              const BenchChoices& choices) {
  BenchResult result;
  result.compiler = first_line(run_tool(joined(choices.compiler, {"--version"})));
  result.processor = processor_name();
  for (const std::string& name : measured(compiled)) result.rows.emplace_back().name = name;
  const support::TemporaryFolder folder;
  build(loaded, compiled, choices, folder.path());
  const std::map<std::string, std::string> signatures = function_signatures(
      loaded.options.name, compiled, choices.is_float ? NumberType::kFloat : NumberType::kDouble);
  for (const auto& [function, bytes] : linked_code(folder.path() + "/model", signatures))
    for (BenchRow& row : result.rows)
      if (row.name == function) row.code = bytes;
  constexpr double kMicrosecond = 1e-6;
  const std::string program = folder.path() + "/bench";
  const std::map<std::string, SteppedCalls> stepped = step_functions(program);
  const std::map<std::string, double> rates =
      read_times(run_tool(joined({program, fmt::format("{}", choices.blocks),
                                  fmt::format("{}", choices.block_length / kMicrosecond)},
                                 rates_to_measure(stepped))),
                 result);
  for (const auto& [name, calls] : stepped) {
    BenchRow& row = row_named(result, name);
    row.x87 = calls.x87;
    if (!row.x87) row.floor = floor_of(calls, rates);
  }
  count_instructions(folder.path(), signatures, stepped, result);
  return result;
}

}  // namespace jourdain::commands
