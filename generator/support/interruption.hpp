// What happens when the user or the system ends the program half-way: temporary folders go, nothing half-written stays.
#pragma once

#include <sys/types.h>

#include <string>

namespace jourdain::support {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT end the program with a message and exit status 3 after the folders
/// and processes below were removed, and a file that grows beyond the limit of its size is an error of writing it
/// instead of a signal, here and in the processes that are started. Call it once, before any thread starts.
void handle_interruptions();

/// A folder, or a file, that is removed when the program is interrupted, while this lives.
class RemovedOnInterruption {
 public:
  explicit RemovedOnInterruption(std::string folder);
  ~RemovedOnInterruption();
  RemovedOnInterruption(const RemovedOnInterruption&) = delete;
  RemovedOnInterruption& operator=(const RemovedOnInterruption&) = delete;

 private:
  std::string folder_;
};

/// A process that is ended with the program, while this lives.
class EndedOnInterruption {
 public:
  explicit EndedOnInterruption(pid_t process);
  ~EndedOnInterruption();
  EndedOnInterruption(const EndedOnInterruption&) = delete;
  EndedOnInterruption& operator=(const EndedOnInterruption&) = delete;

 private:
  pid_t process_;
};

/// While this lives, an interruption waits.
class Uninterrupted {
 public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

}  // namespace jourdain::support
