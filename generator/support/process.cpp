#include "support/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>

#include "support/check.hpp"
#include "support/interruption.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::support {

namespace {

/// The variables of the environment, with another folder for temporary files.
std::vector<std::string> environment_with(const std::string& temporary) {
  constexpr std::string_view kName = "TMPDIR=";
  std::vector<std::string> variables = {std::string(kName) + temporary};
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with(kName)) variables.emplace_back(*variable);
  return variables;
}

/// As the functions of the system take them, ended by a null pointer.
std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts `command` with both its outputs going to `output`; throws EnvironmentError.
pid_t start(const std::vector<std::string>& command, const std::vector<std::string>& environment,
            int output) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);  // so that all that it starts can be ended with it
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int error = posix_spawnp(&child, command[0].c_str(), &actions, &attributes,
                                 pointers_to(command).data(), pointers_to(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw EnvironmentError("cannot run '" + command[0] + "': " + std::strerror(error));
  return child;
}

/// A pipe, closed at the end of its life.
struct Pipe {
  int ends[2] = {-1, -1};

  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw EnvironmentError(std::string("cannot make a pipe: ") + std::strerror(errno));
  }
  ~Pipe() {
    close(ends[0]);
    close_input();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void close_input() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
};

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command) {
  const TemporaryFolder leavings;  // a compiler that is ended may forget a file
  Pipe pipe;
  pid_t child = 0;
  std::optional<EndedOnInterruption> ended;
  {
    const Uninterrupted until_known;
    child = start(command, environment_with(leavings.path()), pipe.ends[1]);
    ended.emplace(child);
  }
  pipe.close_input();
  ProcessResult result;
  char buffer[4096];
  for (ssize_t count; (count = read(pipe.ends[0], buffer, sizeof buffer)) > 0;)
    result.output.append(buffer, static_cast<std::size_t>(count));
  int status = 0;
  waitpid(child, &status, 0);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace jourdain::support
