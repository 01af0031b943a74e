// What the compiled source instantiates, and the macro in front of every function.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "agreement/compiled_batch.hpp"
#include "embed/emit_model.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

constexpr const char* kModels[] = {"pendulum", "crane", "four_bar"};

std::string emitted(const std::string& model, const char* ending) {
  return support::read_file(fmt::format("{0}/{1}/{1}{2}", JOURDAIN_EMITTED, model, ending));
}

TEST(TextChoices, OfRealChangeTheCompiledSourceAlone) {
  for (const std::string model : kModels) {
    const support::TemporaryFolder folder;
    emit_model(model, folder.path(), {"--real", "float"});
    for (const char* ending : {".hpp", "_kernels.hpp"})  // the manifest names the option
      EXPECT_EQ(support::read_file(folder.path() + "/" + model + ending), emitted(model, ending));
    EXPECT_NE(support::read_file(folder.path() + "/" + model + ".cpp"), emitted(model, ".cpp"));
  }
}

TEST(TextChoices, FloatAloneLinksNoDouble) {
  for (const std::string model : kModels) {
    const support::TemporaryFolder folder;
    emit_model(model, folder.path(), {"--real", "float"});
    const std::string object = folder.path() + "/model.o";
    std::vector<std::string> command = {"g++", "-O2"};
    for (const std::string& flag : strict_flags()) command.push_back(flag);
    for (const std::string& more :
         {std::string("-c"), folder.path() + "/" + model + ".cpp", std::string("-o"), object})
      command.push_back(more);
    ASSERT_EQ(support::run_process(command).status, 0);
    const std::string code = support::run_process({"objdump", "-d", "-C", object}).output;
    EXPECT_NE(code.find("rk4_step<float>"), std::string::npos) << model;
    for (const char* word : {"<double>", "mulsd", "addsd", "subsd", "divsd", "cvtss2sd", "mulpd"})
      EXPECT_EQ(code.find(word), std::string::npos) << model << " has " << word;
    const std::string names = support::run_process({"nm", "-u", object}).output;
    for (const char* name : {" sin\n", " cos\n", " sqrt\n", " sincos\n"})
      EXPECT_EQ(names.find(name), std::string::npos) << model << " needs" << name;
  }
}

/// The status of compiling `text` as CUDA for a device, without its toolkit.
support::ProcessResult compile_for_device(const std::string& folder, const std::string& text) {
  support::write_file(folder + "/unit.cu", text);
  return support::run_process({"clang++", "-x", "cuda", "--cuda-device-only", "--cuda-gpu-arch=sm_60",
                               "-nocudainc", "-nocudalib", "-emit-llvm", "-Wno-unknown-cuda-version",
                               "-std=c++17", "-S", "-I" + folder, folder + "/unit.cu", "-o",
                               folder + "/unit.s"});
}

TEST(TextChoices, TheMacroMarksWhatDevicesNeed) {
  const std::string mark = "#define MARK __attribute__((host)) __attribute__((device))\n";
  const support::TemporaryFolder folder;
  if (!have_compiler("clang++") ||
      compile_for_device(folder.path(), mark + "MARK int f() { return 1; }").status != 0)
    GTEST_SKIP() << "no clang++ that compiles for devices";
  std::string library = mark + "extern \"C\" {\n";
  for (const char* name : {"sin", "cos", "sqrt"})
    library += fmt::format("MARK double {0}(double);\nMARK float {0}f(float);\n", name);
  support::write_file(folder.path() + "/math.h",
                      library + "MARK double atan2(double, double);\nMARK float atan2f(float, float);\n}\n");
  for (const std::string model : kModels) {
    const std::string include = fmt::format("#include \"{0}/{1}/{1}.cpp\"\n", JOURDAIN_EMITTED, model),
                      call = fmt::format(
                          "__attribute__((global)) void kernel(double* y) {{\n"
                          "  const {0}::Model<double> model;\n"
                          "  {0}::State<double> state = {0}::initial_state(model);\n"
                          "  {0}::rk4_step(model, state, {{}}, 0.001);\n  *y = state.y[0];\n}}\n",
                          model);
    const auto marked =
        compile_for_device(folder.path(), mark + "#define JOURDAIN_FUNCTION MARK\n" + include + call);
    EXPECT_EQ(marked.status, 0) << model << "\n" << marked.output.substr(0, 2000);
    EXPECT_NE(compile_for_device(folder.path(), mark + include + call).status, 0) << model;
  }
}

}  // namespace
}  // namespace jourdain::tests
