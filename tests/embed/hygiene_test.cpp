// What the emitted sources may use: warnings, symbols, data, heap.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "agreement/compiled_batch.hpp"
#include "properties/effort.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> emitted_models() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(JOURDAIN_EMITTED)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name[0] != '.') names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string source(const std::string& model) {
  return fmt::format("{}/{}/{}.cpp", JOURDAIN_EMITTED, model, model);
}

support::ProcessResult compile(const std::string& compiler, const std::string& input,
                               const std::string& object, const std::vector<std::string>& more = {"-c"}) {
  std::vector<std::string> command = {compiler, "-O2"};
  for (const std::string& flag : strict_flags()) command.push_back(flag);
  command.insert(command.end(), more.begin(), more.end());
  command.insert(command.end(), {input, "-I" JOURDAIN_SOURCE_DIR "/models", "-o", object});
  return support::run_process(command);
}

/// Symbols of an object: type letter and name, as nm prints them.
std::vector<std::pair<char, std::string>> symbols(const std::string& object) {
  std::istringstream lines(support::run_process({"nm", "-P", object}).output);
  std::vector<std::pair<char, std::string>> found;
  for (std::string name, type, rest; lines >> name >> type && std::getline(lines, rest);)
    found.emplace_back(type[0], name);
  return found;
}

TEST(EmittedCode, CompilesCleanAndNeedsNothingButElementaryFunctions) {
  const std::set<std::string> allowed = {"sin",   "cos",     "sincos", "sqrt",   "sinf",   "cosf",
                                         "sqrtf", "sincosf", "atan2",  "atan2f", "memcpy", "memset",
                                         "exp",   "expf",    "tanh",   "tanhf"};
  const support::TemporaryFolder folder;
  ASSERT_GE(emitted_models().size(), 7u);
  for (const std::string compiler : {"g++", "clang++"}) {
    ASSERT_TRUE(have_compiler(compiler)) << "no " << compiler;
    std::size_t number = compiler == "g++" ? 0 : 1;  // each has half of them
    for (const std::string& model : emitted_models()) {
      if (!draws(number++, 2)) continue;
      const std::string object = folder.path() + "/model.o";
      const support::ProcessResult result = compile(
          compiler, source(model), object, {"-c", "-I" + fs::path(source(model)).parent_path().string()});
      ASSERT_EQ(result.status, 0) << compiler << " " << model << "\n" << result.output.substr(0, 2000);
      EXPECT_EQ(result.output, "");
      for (const auto& [type, name] : symbols(object)) {
        EXPECT_TRUE(type != 'U' || allowed.count(name)) << compiler << " " << model << " needs " << name;
        EXPECT_EQ(std::string("DdBbSsGgC").find(type), std::string::npos)
            << compiler << " " << model << " has writable data " << name;
      }
    }
  }
}

TEST(EmittedCode, InFloatNeverTouchesDouble) {
  const support::TemporaryFolder folder;
  const std::string unit = folder.path() + "/float.cpp", object = folder.path() + "/float.o";
  for (const std::string& model : emitted_models()) {
    support::write_file(
        unit, fmt::format("#include \"{0}_kernels.hpp\"\n"
                          "#if __has_include(\"{0}_functions.hpp\")\n"
                          "#include \"{0}_functions.hpp\"\n"
                          "#endif\n"
                          "template struct {0}::Model<float>;\n"
                          "template void {0}::rk4_step(const {0}::Model<float>&, {0}::State<float>&, const "
                          "{0}::Input<float>&, float) noexcept;\n",
                          model));
    const std::string include = fmt::format("-I{}/{}", JOURDAIN_EMITTED, model);
    ASSERT_EQ(compile("g++", unit, object, {"-c", include}).status, 0);
    const std::string assembly = support::run_process({"objdump", "-d", object}).output;
    EXPECT_NE(assembly.find("mulss"), std::string::npos) << model;
    for (const char* instruction : {"mulsd", "addsd", "subsd", "divsd", "cvtss2sd", "mulpd", "addpd"})
      EXPECT_EQ(assembly.find(instruction), std::string::npos) << model << " uses " << instruction;
    for (const auto& [type, name] : symbols(object))
      EXPECT_FALSE(type == 'U' && (name == "sin" || name == "cos" || name == "sincos"))
          << model << " needs " << name;
  }
}

TEST(EmittedCode, StepsWithoutTheHeap) {
  const support::TemporaryFolder folder;
  const std::string unit = folder.path() + "/trap.cpp", program = folder.path() + "/trap";
  support::write_file(unit, R"(#include <stdlib.h>
#include "panda.hpp"
static bool armed = false;
extern "C" void* __libc_malloc(size_t);
extern "C" void* malloc(size_t size) {
  if (armed) abort();
  return __libc_malloc(size);
}
int main() {
  const panda::Model<> model;
  panda::State<> state = panda::initial_state(model);
  armed = true;
  for (int i = 0; i < 1000; ++i) panda::rk4_step(model, state, {}, 1e-3);
  double M[7][7];
  panda::mass_matrix(model, state, M);
  armed = false;
  return state.t > 0.999 && M[0][0] > 0 ? 0 : 1;
}
)");
  const std::string include = fmt::format("-I{}/panda", JOURDAIN_EMITTED);
  const support::ProcessResult built = compile("g++", unit, program, {include, source("panda")});
  ASSERT_EQ(built.status, 0) << built.output;
  EXPECT_EQ(support::run_process({program}).status, 0);
}

}  // namespace
}  // namespace jourdain::tests
