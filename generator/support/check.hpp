// Assertions that stay on in Release: a broken invariant of ours must never become a wrong emitted model.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace jourdain::support {

/// We are wrong: an invariant of the compiler does not hold. `main` maps it to exit status 70.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The environment failed (file, compiler, memory); the text names the path. `main` maps it to exit status 3.
class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail_check(const char* condition, const char* file, int line,
                                    const std::string& operands) {
  const std::string path = file;
  const auto slash = path.find_last_of('/');
  throw InternalError(fmt::format("{}:{}: '{}' does not hold{}{}",
                                  slash == std::string::npos ? path : path.substr(slash + 1), line, condition,
                                  operands.empty() ? "" : ": ", operands));
}

}  // namespace jourdain::support

/// JD_CHECK(condition, "format {}", operands...): throws InternalError with the operands printed.
#define JD_CHECK(condition, ...) \
  ((condition)                   \
       ? void(0)                 \
       : ::jourdain::support::fail_check(#condition, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)))
