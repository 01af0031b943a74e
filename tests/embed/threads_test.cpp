// Two models in one program, one model twice, eight threads, loading and unloading: under the thread sanitizer.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "jourdain/jourdain_interface.h"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kPrograms = JOURDAIN_SOURCE_DIR "/tests/embed/programs/";

void run_checked(const std::vector<std::string>& command) {
  const support::ProcessResult result = support::run_process(command);
  ASSERT_EQ(result.status, 0) << command[0] << "\n" << result.output;
}

void emit(const std::string& folder, const std::string& model, const std::vector<std::string>& options) {
  std::vector<std::string> command = {JOURDAIN_BINARY, "compile",
                                      JOURDAIN_SOURCE_DIR "/models/" + model + ".toml", "-o", folder};
  command.insert(command.end(), options.begin(), options.end());
  run_checked(command);
}

TEST(Threads, OfTwoModelsInCppDoNotMeet) {
  const support::TemporaryFolder folder;
  for (const char* model : {"double_pendulum", "cart_pole"}) emit(folder.path(), model, {});
  const std::string program = folder.path() + "/threads";
  run_checked({"g++", "-std=c++20", "-O1", "-g", "-fsanitize=thread", "-I", folder.path(),
               kPrograms + "threads.cpp", folder.path() + "/double_pendulum.cpp",
               folder.path() + "/cart_pole.cpp", "-o", program, "-pthread"});
  run_checked({program});
}

TEST(Threads, OfTwoModelsInCDoNotMeet) {
  const support::TemporaryFolder folder;
  for (const char* model : {"double_pendulum", "cart_pole"})
    emit(folder.path(), model, {"--language", "c", "--interface"});
  const std::string program = folder.path() + "/threads";
  std::vector<std::string> command = {
      "gcc", "-std=c99", "-pedantic",         "-Wall", "-Wextra",     "-Werror",
      "-O1", "-g",       "-fsanitize=thread", "-I",    folder.path(), kPrograms + "threads.c"};
  for (const char* model : {"double_pendulum", "cart_pole"})
    for (const char* part : {"", "_interface"})
      command.push_back(fmt::format("{}/{}{}.c", folder.path(), model, part));
  command.insert(command.end(), {"-o", program, "-pthread", "-lm"});
  run_checked(command);
  run_checked({program});
}

/// Loads the library, steps an instance and unloads it, some times.
void load_and_leave(const std::string& library, int& failures) {
  for (int round = 0; round < 20; ++round) {
    void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
      ++failures;
      continue;
    }
    const auto entry = reinterpret_cast<const jourdain_interface* (*)()>(dlsym(handle, "pendulum_interface"));
    const jourdain_interface& table = *entry();
    std::vector<std::max_align_t> memory(table.size / sizeof(std::max_align_t) + 1);
    void* const self = table.create(memory.data(), memory.size() * sizeof(std::max_align_t));
    failures += table.steppers[0].step(self, 1e-3, 10) != JOURDAIN_OK ? 1 : 0;
    dlclose(handle);
  }
}

TEST(Threads, LoadAndUnloadAModel) {
  const support::TemporaryFolder folder;
  emit(folder.path(), "pendulum", {"--language", "c", "--interface"});
  const std::string library = folder.path() + "/pendulum.so";
  run_checked({"gcc", "-std=c99", "-O1", "-fPIC", "-shared", folder.path() + "/pendulum.c",
               folder.path() + "/pendulum_interface.c", "-o", library, "-lm"});
  std::vector<int> failures(8, 0);
  std::vector<std::thread> threads;
  for (int& count : failures) threads.emplace_back([&library, &count] { load_and_leave(library, count); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, std::vector<int>(8, 0));
  EXPECT_FALSE(dlopen(library.c_str(), RTLD_NOW | RTLD_NOLOAD)) << "still loaded";
}

}  // namespace
}  // namespace jourdain::tests
