#include "support/interruption.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

namespace jourdain::support {

namespace {

constexpr int kExitStatus = 3;

/// A signal concerns the whole program, so this is the one state that the program shares.
struct Interruption {
  std::recursive_mutex mutex;  ///< held while nothing may be interrupted
  std::set<std::string> folders;
  std::set<pid_t> processes;
};

Interruption& interruption() {
  static auto* const instance = new Interruption;  // outlives static destruction: the waiting thread uses it
  return *instance;
}

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&signals, signal);
  return signals;
}

/// Ends a process and its children; compilers remove their own temporary files when they are asked to end.
void end(pid_t process) {
  constexpr int kPatience = 100;  // times 5 ms
  kill(-process, SIGTERM);
  for (int i = 0; i < kPatience && kill(-process, 0) == 0 && waitpid(process, nullptr, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(-process, SIGKILL);
}

/// The rest of the program, or a process that is being ended, may still be writing into it: again, then.
void remove_folder(const std::string& folder) {
  constexpr int kPatience = 100;  // times 5 ms
  std::error_code ignored;
  for (int i = 0; i < kPatience; ++i) {
    std::filesystem::remove_all(folder, ignored);
    if (!std::filesystem::exists(folder, ignored)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

[[noreturn]] void wait_for_signal() {
  const sigset_t signals = ending_signals();
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) continue;
  const std::lock_guard lock(interruption().mutex);
  for (const pid_t process : interruption().processes) end(process);
  for (const std::string& folder : interruption().folders) remove_folder(folder);
  fmt::print(stderr, "\nerror: interrupted; what was not finished was not written\n");
  std::fflush(stderr);
  _exit(kExitStatus);
}

}  // namespace

void handle_interruptions() {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::thread(wait_for_signal).detach();
}

RemovedOnInterruption::RemovedOnInterruption(std::string folder) : folder_(std::move(folder)) {
  const std::lock_guard lock(interruption().mutex);
  interruption().folders.insert(folder_);
}

RemovedOnInterruption::~RemovedOnInterruption() {
  const std::lock_guard lock(interruption().mutex);
  interruption().folders.erase(folder_);
}

EndedOnInterruption::EndedOnInterruption(pid_t process) : process_(process) {
  const std::lock_guard lock(interruption().mutex);
  interruption().processes.insert(process_);
}

EndedOnInterruption::~EndedOnInterruption() {
  const std::lock_guard lock(interruption().mutex);
  interruption().processes.erase(process_);
}

Uninterrupted::Uninterrupted() { interruption().mutex.lock(); }
Uninterrupted::~Uninterrupted() { interruption().mutex.unlock(); }

}  // namespace jourdain::support
