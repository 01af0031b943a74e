#include "support/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "support/check.hpp"
#include "support/interruption.hpp"

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

/// `text` in a new file next to `path`.
std::filesystem::path write_temporary(const std::string& path, std::string_view text) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail(path, "written", "it is a folder");
  const std::filesystem::path temporary = temporary_beside(path);
  errno = 0;
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (out) return temporary;
  const std::string why = last_error();
  std::filesystem::remove(temporary, error);
  fail(path, "written", why);
}

/// Makes `folder` where it is missing; the outermost folder that was made, empty where none was.
std::filesystem::path make_folder(const std::string& folder) {
  std::filesystem::path missing, path = std::filesystem::path(folder).lexically_normal();
  std::error_code error;
  for (; !path.empty() && !std::filesystem::exists(path, error); path = path.parent_path()) missing = path;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    throw EnvironmentError(
        fmt::format("cannot make folder '{}': {}", folder, error ? error.message() : "a file has that name"));
  return missing;
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
  const Uninterrupted all_of_it;
  const std::filesystem::path temporary = write_temporary(path, text);
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  fail(path, "written", error.message());
}

void write_files(const std::string& folder, const std::vector<FileText>& files) {
  const Uninterrupted all_of_it;
  const std::filesystem::path made = make_folder(folder);
  std::vector<std::filesystem::path> temporary;
  const auto path_of = [&folder](const FileText& file) {
    return (std::filesystem::path(folder) / file.name).string();
  };
  std::error_code ignored;
  try {
    for (const FileText& file : files) temporary.push_back(write_temporary(path_of(file), file.text));
    for (std::size_t i = 0; i < files.size(); ++i) {
      std::error_code error;
      std::filesystem::rename(temporary[i], path_of(files[i]), error);
      if (error) fail(path_of(files[i]), "written", error.message());
    }
  } catch (...) {
    for (const auto& path : temporary) std::filesystem::remove(path, ignored);
    if (!made.empty()) std::filesystem::remove_all(made, ignored);
    throw;
  }
}

void check_writable(const std::string& folder) {
  const std::filesystem::path made = make_folder(folder);
  std::error_code ignored;
  try {
    std::filesystem::remove(write_temporary((std::filesystem::path(folder) / "report").string(), ""),
                            ignored);
  } catch (...) {
    if (!made.empty()) std::filesystem::remove_all(made, ignored);
    throw;
  }
  if (!made.empty()) std::filesystem::remove_all(made, ignored);
}

}  // namespace jourdain::support
