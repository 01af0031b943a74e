// Whole files in, whole files out.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "support/check.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::support {

namespace {

[[noreturn]] void fail(const std::string& path, const char* what, const std::string& why) {
  throw EnvironmentError(fmt::format("{}: cannot be {}: {}", path, what, why));
}

std::string last_error() { return errno == 0 ? "unknown error" : std::strerror(errno); }

/// A name next to `path` that no file has yet.
std::filesystem::path temporary_beside(const std::string& path) {
  std::random_device random;
  for (;;) {
    const std::filesystem::path candidate = fmt::format("{}.{:08x}.tmp", path, random());
    std::error_code ignored;
    if (!std::filesystem::exists(candidate, ignored)) return candidate;
  }
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail(path, "read", "it is a folder");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "read", last_error());
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) fail(path, "read", last_error());
  return text;
}

void write_file(const std::string& path, std::string_view text) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail(path, "written", "it is a folder");
  const std::filesystem::path temporary = temporary_beside(path);
  errno = 0;
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
      const std::string why = last_error();
      std::filesystem::remove(temporary, error);
      fail(path, "written", why);
    }
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    fail(path, "written", why);
  }
}

}  // namespace jourdain::support
