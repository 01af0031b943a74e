#include "fuzz/child.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "commands/command_line.hpp"
#include "model/read/read.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

#ifdef JOURDAIN_SANITIZED
// So that what a sanitizer finds is no refusal.
extern "C" const char* __asan_default_options() { return "exitcode=99:detect_leaks=0"; }       // NOLINT
extern "C" const char* __ubsan_default_options() { return "exitcode=99:print_stacktrace=1"; }  // NOLINT
#endif

namespace jourdain::tests {

namespace {

#ifdef JOURDAIN_SANITIZED
constexpr double kSlower = 10;
#else
constexpr double kSlower = 1;
#endif
constexpr double kWaiting = 6;  ///< times the processor time: the machine may be busy

void redirect(const std::string& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

void limit(int resource, rlim_t value) {
  const rlimit limits{value, value};
  setrlimit(resource, &limits);
}

void set_limits() {
  limit(RLIMIT_CPU, static_cast<rlim_t>(kMaximumSeconds * kSlower) + 1);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 200'000'000);
#ifndef JOURDAIN_SANITIZED
  limit(RLIMIT_AS, rlim_t{kMaximumMegabytes + 200} << 20);
#endif
}

/// Whether the reader takes the description; what else is wrong with it is the command's business.
bool is_read(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument == "model.toml" || argument == "model.urdf") {
      support::Diagnostics diagnostics(argument, support::read_file(argument));
      return model::read_mechanism(diagnostics).has_value();
    }
  return false;
}

[[noreturn]] void run_here(const std::string& folder, const std::vector<std::string>& arguments,
                           volatile bool* read) {
  redirect(folder + "/output", STDOUT_FILENO);
  redirect(folder + "/errors", STDERR_FILENO);
  redirect("/dev/null", STDIN_FILENO);
  setenv("TMPDIR", (folder + "/tmp").c_str(), 1);
  if (chdir((folder + "/case").c_str()) != 0) _exit(98);
  set_limits();
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), "jourdain");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int status = commands::run_command_line(static_cast<int>(words.size()), pointers.data());
  std::fflush(nullptr);
  try {
    *read = status == 0 || is_read(arguments);
  } catch (const std::exception&) {  // the command has said so
  }
  _exit(status);
}

std::string beginning(const std::string& path) {
  constexpr std::size_t kShown = 1'000'000;
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.substr(0, kShown);
}

/// Asks it to end, so that it ends what it has started, and then ends it.
void end(pid_t child) {
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  kill(child, SIGKILL);
}

/// Waits until the child has ended or has taken too long; its status, and what it used.
bool wait_for(pid_t child, int& status, rusage& used) {
  using Clock = std::chrono::steady_clock;
  const auto last = Clock::now() + std::chrono::duration<double>(kMaximumSeconds * kSlower * kWaiting);
  auto pause = std::chrono::microseconds(200);
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (Clock::now() > last) {
      end(child);
      wait4(child, &status, 0, &used);
      return false;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::microseconds(5'000));
  }
  return true;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildResult run_in_child(const std::string& folder, const std::vector<std::string>& arguments) {
  static auto* const read = static_cast<volatile bool*>(
      mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  *read = false;
  const pid_t child = fork();
  if (child == 0) run_here(folder, arguments, read);
  ChildResult result;
  int status = 0;
  rusage used{};
  const bool in_time = wait_for(child, status, used);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  result.too_slow = !in_time || result.seconds > kMaximumSeconds * kSlower || result.status == 128 + SIGXCPU;
  result.read = *read;
  result.output = beginning(folder + "/output");
  result.errors = beginning(folder + "/errors");
#ifndef JOURDAIN_SANITIZED
  result.too_large =
      used.ru_maxrss > kMaximumMegabytes << 10 || result.errors.find("std::bad_alloc") != std::string::npos;
#endif
  return result;
}

}  // namespace jourdain::tests
