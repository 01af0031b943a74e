// A bar on the terminal for work that takes a while.
#pragma once

#include <chrono>
#include <string>

namespace jourdain::commands {

/// Drawn on stderr where that is a terminal, from the first word on; gone at the end of its life.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` from 0 to 1.
  void show(const std::string& what, double done);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_, drawn_ = false;
  std::string last_what_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace jourdain::commands
