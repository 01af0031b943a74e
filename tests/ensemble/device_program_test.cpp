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

/// Of a model whose files are in generated/: its coordinates and what is trusted, in all digits.
void expect_host_bits(const std::string& model, const std::string& real) {
  SCOPED_TRACE(model + " in " + real);
  const support::TemporaryFolder folder;
  const std::vector<std::string> flags = flags_of(model, real);
  const std::string device = output_in_halves(kPrograms + "/device.cpp", folder.path() + "/device", flags);
  const std::string host = output_of_host(kPrograms + "/device.cpp", folder.path() + "/host", flags);
  EXPECT_EQ(device, host);
  EXPECT_EQ(device.find("nan"), std::string::npos);
  EXPECT_NE(device.substr(0, device.find('\n')), device.substr(device.rfind('\n', device.size() - 2) + 1));
  const std::string assembly = support::read_file(folder.path() + "/device.ptx");
  EXPECT_NE(assembly.find(".entry"), std::string::npos);
  EXPECT_EQ(assembly.find(".f64") != std::string::npos, real == "double") << "float is float";
}

TEST(DevicePrograms, HaveTheBitsOfTheHost) {
  expect_host_bits("panda", "double");
  expect_host_bits("quadruped", "float");
}

TEST(DevicePrograms, ReadTables) { expect_host_bits("wind_turbine", "float"); }

TEST(DevicePrograms, CloseLoops) { expect_host_bits("four_bar", "double"); }

/// Debian's compiler of NVIDIA is no part of what tests need.
TEST(DevicePrograms, AreCompiledByNvccWithoutWarnings) {
  if (support::run_process({"sh", "-c", "command -v nvcc"}).status != 0) GTEST_SKIP() << "no nvcc";
  for (const auto& [model, real] : {std::pair("wind_turbine", "float"), std::pair("four_bar", "double")}) {
    SCOPED_TRACE(model);
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
    const std::vector<std::string> flags = flags_of(model, real);
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
