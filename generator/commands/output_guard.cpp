#include "commands/output_guard.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "commands/printable.hpp"

namespace jourdain::commands {

namespace {

namespace fs = std::filesystem;

/// Devices and pipes take whatever is written, and may take it from several.
bool is_file(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return !path.empty() && path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
  if (error) return false;
  const fs::path second = fs::weakly_canonical(fs::absolute(b, error), error);
  return !error && first == second;
}

bool refuse_output(const std::string& path, const std::string& why) {
  fmt::print(stderr, "error: {}: {}\n", printable(path), why);
  return false;
}

}  // namespace

bool are_outputs_apart(const std::vector<std::string>& written, const std::vector<std::string>& read,
                       const std::string& why) {
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (!is_file(written[i])) continue;
    for (const std::string& path : read)
      if (is_file(path) && is_same_file(written[i], path)) return refuse_output(written[i], why);
    for (std::size_t k = 0; k < i; ++k)
      if (is_file(written[k]) && is_same_file(written[i], written[k]))
        return refuse_output(written[i], "two files are to be written there");
  }
  return true;
}

}  // namespace jourdain::commands
