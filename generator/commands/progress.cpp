#include "commands/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace jourdain::commands {

namespace {

constexpr int kWidth = 40;

}  // namespace

ProgressBar::ProgressBar() : shown_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (drawn_) fmt::print(stderr, "\r{:90}\r", "");
  drawn_ = false;
}

void ProgressBar::show(const std::string& what, double done) {
  const double since = std::chrono::duration<double>(Clock::now() - last_).count();
  if (!shown_ || (what == last_what_ && since < 0.1)) return;
  last_ = Clock::now();
  last_what_ = what;
  drawn_ = true;
  const int filled = static_cast<int>(kWidth * std::clamp(done, 0.0, 1.0));
  fmt::print(stderr, "\r[{:=<{}}{:{}}] {:3.0f}% {:<40}", "", filled, "", kWidth - filled, 100 * done, what);
  std::fflush(stderr);
}

}  // namespace jourdain::commands
