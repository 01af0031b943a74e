// Programs for devices as clang's CUDA mode cuts them in two: the device's half becomes NVIDIA's assembly, and the same
// intermediate code, run on this machine, gives the host's bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "package/project.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kRoot = JOURDAIN_SOURCE_DIR, kPrograms = kRoot + "/tests/ensemble/programs";

std::string output_of(const std::vector<std::string>& command) {
  const support::ProcessResult result = support::run_process(command);
  EXPECT_EQ(result.status, 0) << command[0] << "\n" << result.output;
  return result.output;
}

/// Of a program's two halves, with PROGRAM.ptx beside it; and of the host's compiler, which knows no device.
std::string output_in_halves(const std::string& source, const std::string& program,
                             const std::vector<std::string>& flags) {
  std::vector<std::string> build = {"sh", kPrograms + "/cuda/build.sh", source, program};
  build.insert(build.end(), flags.begin(), flags.end());
  output_of(build);
  return output_of({program});
}
std::string output_of_host(const std::string& source, const std::string& program,
                           const std::vector<std::string>& flags) {
  std::vector<std::string> build = {"g++",   "-std=c++17", "-O1",        "-ffp-contract=off",
                                    "-Wall", "-Wextra",    "-Wpedantic", "-Werror",
                                    "-o",    program,      source};
  build.insert(build.end(), flags.begin(), flags.end());
  output_of(build);
  return output_of({program});
}

/// What a model in generated/ and its type of numbers are to PROGRAM.
std::vector<std::string> flags_of(const std::string& model, const std::string& real) {
  return {"-I",
          kRoot + "/runtime",
          "-I",
          kRoot + "/generated/" + model,
          fmt::format("-DKERNELS=\"{}_kernels.hpp\"", model),
          fmt::format("-DMODEL={}::Model", model),
          "-DREAL=" + real};
}

/// Of the crane, emitted into a folder, which steps implicitly.
std::vector<std::string> flags_of_implicit_steps(const std::string& folder) {
  output_of({JOURDAIN_BINARY, "compile", kRoot + "/models/crane.toml", "--functions",
             "initial_state,forward_dynamics,rodas4_step", "-o", folder});
  return {"-I",
          kRoot + "/runtime",
          "-I",
          folder,
          "-DNAME=crane",
          "-DKERNELS=\"crane_kernels.hpp\"",
          "-DMODEL=crane::Model",
          "-DREAL=double",
          "-DSTEP=rodas4_step"};
}

/// Of the glider, which calls functions that its user writes.
std::vector<std::string> flags_of_own_functions() {
  std::vector<std::string> flags = flags_of("glider", "double");
  flags.insert(flags.end(), {"-I", kRoot + "/models", "-DFUNCTIONS=\"glider_functions.hpp\""});
  return flags;
}

/// Of a model: its coordinates and what is trusted, in all digits.
void expect_host_bits(const std::vector<std::string>& flags, const std::string& real) {
  const support::TemporaryFolder folder;
  const std::string device = output_in_halves(kPrograms + "/device.cpp", folder.path() + "/device", flags);
  const std::string host = output_of_host(kPrograms + "/device.cpp", folder.path() + "/host", flags);
  EXPECT_EQ(device, host);
  EXPECT_EQ(device.find("nan"), std::string::npos);
  EXPECT_NE(device.substr(0, device.find('\n')), device.substr(device.rfind('\n', device.size() - 2) + 1));
  const std::string assembly = support::read_file(folder.path() + "/device.ptx");
  EXPECT_NE(assembly.find(".entry"), std::string::npos);
  EXPECT_EQ(assembly.find(".f64") != std::string::npos, real == "double") << "float is float";
}

/// Of one whose files are in generated/.
void expect_host_bits(const std::string& model, const std::string& real) {
  SCOPED_TRACE(model + " in " + real);
  expect_host_bits(flags_of(model, real), real);
}

TEST(DevicePrograms, HaveTheBitsOfTheHost) {
  expect_host_bits("panda", "double");
  expect_host_bits("quadruped", "float");
}

TEST(DevicePrograms, ReadTables) { expect_host_bits("wind_turbine", "float"); }

TEST(DevicePrograms, CloseLoops) { expect_host_bits("four_bar", "double"); }

TEST(DevicePrograms, StepImplicitly) {
  const support::TemporaryFolder folder;
  expect_host_bits(flags_of_implicit_steps(folder.path()), "double");
}

TEST(DevicePrograms, CallFunctionsOfTheirUser) { expect_host_bits(flags_of_own_functions(), "double"); }

/// Debian's compiler of NVIDIA is no part of what tests need.
TEST(DevicePrograms, AreCompiledByNvccWithoutWarnings) {
  if (support::run_process({"sh", "-c", "command -v nvcc"}).status != 0) GTEST_SKIP() << "no nvcc";
  const support::TemporaryFolder crane;
  for (const std::vector<std::string>& flags :
       {flags_of("wind_turbine", "float"), flags_of("four_bar", "double"),
        flags_of_implicit_steps(crane.path()), flags_of_own_functions()}) {
    const support::TemporaryFolder folder;
    std::vector<std::string> command = {"nvcc",
                                        "-x",
                                        "cu",
                                        "-std=c++17",
                                        "--Werror",
                                        "all-warnings",
                                        "-o",
                                        folder.path() + "/device",
                                        kPrograms + "/device.cpp"};
    command.insert(command.end(), flags.begin(), flags.end());
    output_of(command);
  }
}

TEST(DevicePrograms, WantTheirHeaderFirst) {
  const support::TemporaryFolder folder;
  const std::string source = folder.path() + "/late.cpp";
  support::write_file(source, "#include \"panda_kernels.hpp\"\n#include <jourdain/device_ensemble.hpp>\n");
  const support::ProcessResult result =
      support::run_process({"sh", kPrograms + "/cuda/build.sh", source, folder.path() + "/late", "-I",
                            kRoot + "/runtime", "-I", kRoot + "/generated/panda"});
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("include jourdain/device_ensemble.hpp before emitted headers"),
            std::string::npos)
      << result.output;
}

TEST(EnsemblesPage, HoldsPolesOnADevice) {
  const std::string text = support::read_file(kRoot + "/runtime/ensembles.md"),
                    section = text.substr(text.find("## On graphics processors")), fence = "```sh\n";
  const std::size_t first = section.find(fence) + fence.size();
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(kRoot, section.substr(first, section.find("\n```", first) - first),
                 {"BUILD=" + build_folder(), "PROJECT=" + folder.path()});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string line = "8242 of 10000 gains hold the pole for 10 s, from 16.44 N/rad\n";
  EXPECT_NE(result.output.find(line), std::string::npos) << result.output;
  EXPECT_EQ(output_in_halves(folder.path() + "/poles.cpp", folder.path() + "/device",
                             {"-I", kRoot + "/runtime", "-I", folder.path()}),
            line);
}

}  // namespace
}  // namespace jourdain::tests
