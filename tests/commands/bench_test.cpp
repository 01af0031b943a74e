// `jourdain bench`: what is counted agrees with the manifest and repeats, what is measured is in order; no time is
// asserted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands/callgrind.hpp"
#include "commands/issue_kernels.hpp"
#include "commands/single_steps.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFunctions = "mass_matrix,forward_dynamics,close_loops,rk4_step,adams_bashforth2_step";

/// Runs a short `jourdain bench` from the project's root.
support::ProcessResult bench(const std::vector<std::string>& arguments, const std::string& path = "") {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR};
  if (!path.empty()) command.push_back(fmt::format("PATH={}:{}", path, std::getenv("PATH")));
  for (const char* word : {JOURDAIN_BINARY, "bench", "--blocks", "3", "--states", "2"})
    command.emplace_back(word);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

json bench_of(const std::string& model, std::vector<std::string> more = {}, const std::string& path = "") {
  more.insert(more.begin(), {model, "--json"});
  const support::ProcessResult result = bench(more, path);
  EXPECT_EQ(result.status, 0) << result.output;
  return json::parse(result.output.substr(result.output.find('{')));  // behind notes on loops
}

const json& entry_of(const json& list, const std::string& name) {
  for (const json& entry : list)
    if (entry["name"] == name) return entry;
  ADD_FAILURE() << "no " << name;
  return list.front();
}

json exact_part(json bench) {
  for (json& function : bench["functions"]) function.erase("measured");
  return bench;
}

/// A program of that name in the folder.
void write_program(const fs::path& file, const std::string& script) {
  support::write_file(file.string(), "#!/bin/sh\n" + script + "\n");
  fs::permissions(file, fs::perms::owner_all);
}

TEST(Bench, OperationsAreTheManifests) {
  const support::TemporaryFolder folder;
  const json bench = bench_of("models/four_bar.toml", {"--functions", kFunctions});
  const support::ProcessResult compiled =
      support::run_process({"env", "-C", JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "compile",
                            "models/four_bar.toml", "--functions", kFunctions, "-o", folder.path()});
  ASSERT_EQ(compiled.status, 0) << compiled.output;
  const json manifest = json::parse(support::read_file(folder.path() + "/four_bar.json"));
  for (const char* name : {"mass_matrix", "forward_dynamics", "close_loops"}) {
    const json& function = entry_of(bench["functions"], name);
    const json& counted = manifest["operations"][name];
    EXPECT_EQ(function["operations"], counted["arithmetic"]) << name;
    EXPECT_EQ(function["sin_and_cos"], counted["sin"].get<long>() + counted["cos"].get<long>()) << name;
  }
  for (const char* name : {"rk4_step", "adams_bashforth2_step"})
    EXPECT_EQ(entry_of(bench["functions"], name)["operations"], manifest["steps"][name]["operations"]);
}

TEST(Bench, CountsRepeatAndTimesAreInOrder) {
  const std::vector<std::string> options = {"--functions", kFunctions, "--real", "float"};
  const json once = bench_of("models/double_pendulum.toml", options);
  EXPECT_EQ(exact_part(once), exact_part(bench_of("models/double_pendulum.toml", options)));
  EXPECT_EQ(once["number_type"], "float");
  EXPECT_EQ(once["functions"].size(), 4u);
  for (const json& function : once["functions"]) {
    EXPECT_EQ(function["finite_states"], 2) << function;
    EXPECT_GT(function["code_bytes"], 0) << function;
    EXPECT_GT(function["measured"]["least_s"], 0) << function;
    EXPECT_LE(function["measured"]["least_s"], function["measured"]["median_s"]) << function;
    if (function["instructions"].is_null()) continue;  // no valgrind
    EXPECT_LE(function["instructions"]["least"], function["instructions"]["mean"]) << function;
    EXPECT_LE(function["instructions"]["mean"], function["instructions"]["most"]) << function;
    if (function["floating_point_instructions"].is_null()) continue;  // no single steps
    EXPECT_LT(function["floating_point_instructions"], function["instructions"]["mean"]) << function;
    EXPECT_GT(function["measured"]["floor_s"], 0) << function;
  }
  const json &dynamics = entry_of(once["functions"], "forward_dynamics"),
             &step = entry_of(once["functions"], "rk4_step");
  EXPECT_GE(step["code_bytes"], dynamics["code_bytes"]);
  if (dynamics["instructions"].is_null()) return;
  EXPECT_GT(dynamics["instructions"]["least"], dynamics["operations"]);
  EXPECT_GT(step["instructions"]["least"], 4 * dynamics["operations"].get<long>());
}

TEST(Bench, CodeIsWhatTheGraphOfCallsSays) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/cost.json";
  const support::ProcessResult cost = support::run_process(
      {"env", "-C", JOURDAIN_SOURCE_DIR, "CXX=g++", JOURDAIN_BINARY, "cost", "models/spring_pendulum.toml",
       "--methods", "rk4,heun", "--warm", "10", "--cold", "1", "-o", file});
  ASSERT_EQ(cost.status, 0) << cost.output;
  const json costs = json::parse(support::read_file(file));
  const json bench = bench_of("models/spring_pendulum.toml",
                              {"--compiler", "g++", "--functions", "inverse_dynamics,rk4_step,heun_step"});
  EXPECT_EQ(entry_of(bench["functions"], "inverse_dynamics")["code_bytes"],
            entry_of(costs["functions"], "inverse_dynamics")["code_bytes"]);
  for (const char* step : {"rk4_step", "heun_step"})
    EXPECT_EQ(entry_of(bench["functions"], step)["code_bytes"], entry_of(costs["steps"], step)["code_bytes"]);
}

TEST(Bench, EverySceneHasStatesAndFiniteNumbers) {
  // Quaternions and inputs; loops held by multipliers. A loop with a closed form is above.
  for (const char* model : {"quadrotor", "n_four_bar"}) {
    const json bench =
        bench_of(fmt::format("models/{}.toml", model), {"--functions", "forward_dynamics", "--seed", "7"});
    EXPECT_EQ(bench["seed"], 7);
    for (const json& function : bench["functions"]) EXPECT_EQ(function["finite_states"], 2) << function;
  }
}

/// Puts a valgrind there that cannot run anything.
void write_useless_valgrind(const support::TemporaryFolder& folder) {
  write_program(folder.path() + "/valgrind", "[ \"$1\" = --version ] && echo valgrind-9");
}

TEST(Bench, SaysWhatCountsInstructionsWithoutCallgrind) {
  const support::TemporaryFolder folder;
  const auto expect = [&](const std::string& reason) {
    const json bench = bench_of("models/pendulum.toml", {"--functions", "q_bar"}, folder.path());
    const json& function = bench["functions"][0];
    const bool stepped = !function["floating_point_instructions"].is_null();
#ifdef __x86_64__
    EXPECT_TRUE(stepped);
#endif
    EXPECT_EQ(bench["instructions_by"],
              reason + (stepped ? ": the processor's single steps" : ": instructions are not counted"));
    EXPECT_EQ(function["instructions"].is_null(), !stepped);
  };
  write_program(folder.path() + "/valgrind", "exit 1");
  expect("valgrind is not installed");
  write_useless_valgrind(folder);
  expect("valgrind-9 cannot run this code");
}

#ifdef __x86_64__

TEST(Bench, SingleStepsCountWhatCallgrindCounts) {
  if (!commands::valgrind_version()) GTEST_SKIP() << "valgrind is not installed";
  const support::TemporaryFolder folder;
  write_useless_valgrind(folder);
  const auto expect_same = [&](const std::string& model, const char* real) {
    const std::vector<std::string> options = {"--real", real, "--functions",
                                              "mass_matrix,forward_dynamics,inverse_dynamics,rk4_step"};
    const json counted = bench_of(model, options), stepped = bench_of(model, options, folder.path());
    ASSERT_NE(counted["instructions_by"], stepped["instructions_by"]);
    ASSERT_EQ(counted["functions"].size(), stepped["functions"].size());
    int compared = 0;
    for (std::size_t i = 0; i < counted["functions"].size(); ++i) {
      const json &one = counted["functions"][i], &other = stepped["functions"][i];
      if (one["instructions_of_libraries"] > 0)
        continue;  // chosen by processor, and valgrind's is another one
      EXPECT_EQ(one["instructions"], other["instructions"]) << model << ' ' << real << ' ' << one["name"];
      ++compared;
    }
    EXPECT_GT(compared, 2) << model;
  };
  expect_same("models/ur5.toml", "double");
  expect_same("models/n_four_bar.toml", "float");
}

TEST(Bench, CountedOperationsAreTheMachinesInstructions) {
  // Without sines, vectors and fused products each operation is one, where nothing is shared from stage to stage.
  for (const char* model : {"tumbling_body", "quadrotor"})
    for (const char* compiler : {"g++", "clang++"}) {
      const json bench =
          bench_of(fmt::format("models/{}.toml", model),
                   {"--compiler", compiler, "--flags", "-O1 -ffp-contract=off -DJOURDAIN_INLINED="});
      EXPECT_GE(bench["functions"].size(), 10u);
      for (const json& function : bench["functions"])
        EXPECT_EQ(function["floating_point_instructions"], function["operations"]) << compiler << function;
    }
}

#endif

TEST(Bench, OptionsReachTheLinker) {
  const auto function_with = [](const std::string& flags) {
    return bench_of("models/pendulum.toml",
                    {"--compiler", "g++", "--functions", "forward_dynamics", "--flags", flags});
  };
  EXPECT_GT(function_with("-fsanitize=address")["functions"][0]["code_bytes"], 0);
  const json left = function_with("-O2 -flto");
  EXPECT_EQ(left["functions"][0]["finite_states"], 2);
  EXPECT_TRUE(left["functions"][0]["code_bytes"].is_null());
  EXPECT_NE(left["remarks"].dump().find("leaves to the linker (-flto)"), std::string::npos);
}

#ifdef __x86_64__

TEST(Bench, ArithmeticThatIsNotCountedHasNoFloor) {
  const json bench = bench_of("models/pendulum.toml", {"--compiler", "g++", "--functions", "forward_dynamics",
                                                       "--flags", "-O2 -mfpmath=387"});
  const json& function = bench["functions"][0];
  EXPECT_TRUE(function["floating_point_instructions"].is_null());
  EXPECT_FALSE(function["measured"].contains("floor_s"));
  EXPECT_NE(bench["remarks"].dump().find("x87's registers have no floor"), std::string::npos);
}

#endif

TEST(Bench, NamesMachineCompilerAndOptions) {
  const support::ProcessResult result =
      bench({"models/pendulum.toml", "--compiler", "clang++", "--flags", "-O1 -fno-math-errno"});
  ASSERT_EQ(result.status, 0) << result.output;
  for (const char* part : {"pendulum in double", "clang version", "-O1 -fno-math-errno", "forward_dynamics",
                           "forward_dynamics_derivatives", "rk4_step", "2 states are drawn from seed 1"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << " is missing in\n" << result.output;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 125u) << line;
}

TEST(Bench, MistakesEndWithTheirStatus) {
  const support::TemporaryFolder folder;
  const std::string bad = folder.path() + "/bad.toml";
  support::write_file(bad, "[model]\nname = \"bad\"\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\n");
  const auto expect = [&](const std::vector<std::string>& arguments, int status, const std::string& part) {
    const support::ProcessResult result = bench(arguments);
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  const std::string model = "models/pendulum.toml";
  expect({bad}, 1, "bad.toml:3");
  expect({"models/nothing.toml"}, 3, "models/nothing.toml");
  expect({model, "--functions", "massmatrix"}, 2, "did you mean 'mass_matrix'");
  expect({model, "--functions", ""}, 2, "no function ''");
  expect({model, "--real", "long"}, 2, "--real");
  expect({model, "--states", "0"}, 2, "--states");
  expect({model, "--compiler", " "}, 2, "--compiler is empty");
  expect({model, "--compiler", "no-such-compiler"}, 3, "cannot run 'no-such-compiler'");
  expect({model, "--flags", "-fno-such-option"}, 3, "-fno-such-option");
}

TEST(Floor, ReadsArithmeticInstructions) {
  using commands::Arithmetic, commands::ArithmeticInstruction, commands::Width;
  const auto expect = [](const char* mnemonic, const char* operands, Arithmetic arithmetic, Width width) {
    const std::optional<ArithmeticInstruction> read = commands::read_instruction(mnemonic, operands);
    ASSERT_TRUE(read) << mnemonic;
    EXPECT_EQ(*read, (ArithmeticInstruction{arithmetic, width})) << mnemonic;
  };
  expect("addsd", "%xmm0,%xmm1", Arithmetic::kSum, Width::kOne);
  expect("vsubss", "(%rax),%xmm0,%xmm1", Arithmetic::kSum, Width::kOne);
  expect("vaddsubpd", "%ymm0,%ymm1,%ymm2", Arithmetic::kSum, Width::k256);
  expect("mulpd", "0x10(%rsp),%xmm1", Arithmetic::kProduct, Width::k128);
  expect("vfnmadd231pd", "(%rcx){1to8},%zmm1,%zmm2", Arithmetic::kProduct, Width::k512);
  expect("vfmsub132ss", "%xmm0,%xmm1,%xmm2", Arithmetic::kProduct, Width::kOne);
  expect("vmaxps", "%ymm0,%ymm1,%ymm2", Arithmetic::kExtreme, Width::k256);
  expect("divsd", "%xmm0,%xmm1", Arithmetic::kQuotient, Width::kOne);
  expect("vsqrtpd", "%zmm0,%zmm1", Arithmetic::kRoot, Width::k512);
  for (const char* other :
       {"movsd", "vmovapd", "add", "imul", "mul", "div", "vpaddd", "paddd", "pmulld", "ucomisd", "cvttsd2si",
        "roundsd", "xorpd", "vunpcklpd", "vpermpd", "subq", "vpmuludq", "adds"})
    EXPECT_FALSE(commands::read_instruction(other, "%ymm0,%ymm1")) << other;
  for (const char* x87 : {"fadd", "fsubrp", "fmull", "fdivs", "fsqrt", "fsincos"}) {
    EXPECT_TRUE(commands::is_x87_arithmetic(x87)) << x87;
    EXPECT_FALSE(commands::read_instruction(x87, "%st(1),%st")) << x87;
  }
  for (const char* other : {"fldl", "fstpl", "fxch", "fchs", "fucomi", "addsd", "vfmadd231pd"})
    EXPECT_FALSE(commands::is_x87_arithmetic(other)) << other;
}

TEST(Floor, IsTheTimeOfTheBusiestUnit) {
  using commands::Arithmetic, commands::Width;
  const std::map<std::string, double> rates = {{"sum0", 2},     {"product0", 4}, {"both0", 5},
                                               {"sum3", 1},     {"both3", 1},    {"quotient0", 0.25},
                                               {"root0", 0.125}};
  const auto expect = [&](const commands::ArithmeticCounts& counts, double time) {
    EXPECT_DOUBLE_EQ(commands::least_time(counts, rates), time);
    for (const std::string& name : commands::issue_names(counts)) EXPECT_TRUE(rates.contains(name)) << name;
  };
  expect({}, 0);
  expect({{{Arithmetic::kSum, Width::kOne}, 100}, {{Arithmetic::kProduct, Width::kOne}, 10}}, 50);
  expect({{{Arithmetic::kSum, Width::kOne}, 100}, {{Arithmetic::kSum, Width::k512}, 10}}, 60);
  expect({{{Arithmetic::kSum, Width::kOne}, 10}, {{Arithmetic::kProduct, Width::kOne}, 190}}, 47.5);
  expect({{{Arithmetic::kSum, Width::kOne}, 100}, {{Arithmetic::kProduct, Width::kOne}, 190}}, 58);
  expect({{{Arithmetic::kExtreme, Width::kOne}, 100}}, 20);
  expect({{{Arithmetic::kQuotient, Width::kOne}, 10},
          {{Arithmetic::kRoot, Width::kOne}, 10},
          {{Arithmetic::kSum, Width::kOne}, 100}},
         120);
}

TEST(Floor, StepsAreThoseOfTheFunction) {
  using commands::Arithmetic, commands::Width;
  const auto steps = commands::read_steps(
      "finite step 2\nsteps step 9 11\noutside step 4\nat step 401000 2\nat step 401010 4\nat step 401014 "
      "10\n"
      "steps old 5 5\noutside old 0\nat old 401018 2\nsteps idle 0 0\noutside idle 0\n",
      "program:     file format\n\n0000000000401000 <bench::call(int)>:\n  401000:\tmulsd  %xmm0,%xmm1\n\n"
      "0000000000401010 <step(double)>:\n  401010:\tvaddpd %ymm0,%ymm1,%ymm2\n  401014:\tret\n"
      "  401018:\tfmulp  %st,%st(1)\n",
      "bench::");
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_TRUE(steps.at("old").x87);
  const commands::SteppedCalls& step = steps.at("step");
  EXPECT_EQ(step.instructions, (std::vector<double>{8, 10}));
  EXPECT_EQ(step.outside, 2);
  EXPECT_FALSE(step.x87);
  EXPECT_EQ(step.arithmetic, (commands::ArithmeticCounts{{{Arithmetic::kSum, Width::k256}, 2}}));
}

TEST(Callgrind, AddsNothingAndMixesNoNames) {
  const std::vector<commands::CountedCalls> calls = commands::read_callgrind(
      "events: Ir\nfl=(1) a.cpp\nfn=(1) main\n10 5\ncfi=(2) b.cpp\ncfn=(2) step(double)\ncalls=3 20\n11 300\n"
      "cfn=(3) sin\ncalls=1 0\n* 40\n\nfn=(2)\n21 100\ncfn=(3)\ncalls=6 0\n+2 160\n\ntotals: 305\n");
  ASSERT_EQ(calls.size(), 3u);
  const auto expect = [](const commands::CountedCalls& c, const char* caller, const char* callee,
                         long long count, long long instructions) {
    EXPECT_EQ(c.caller, caller);
    EXPECT_EQ(c.callee, callee);
    EXPECT_EQ(c.calls, count);
    EXPECT_EQ(c.instructions, instructions);
  };
  expect(calls[0], "main", "step(double)", 3, 300);
  expect(calls[1], "main", "sin", 1, 40);
  expect(calls[2], "step(double)", "sin", 6, 160);
}

}  // namespace
}  // namespace jourdain::tests
