#include "support/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>

#include "support/check.hpp"
#include "support/interruption.hpp"

namespace jourdain::support {

namespace {

constexpr std::size_t kLargestFile = std::size_t(256) << 20;

[[noreturn]] void fail(const std::string& path, const char* what, const std::string& why) {
  throw EnvironmentError(fmt::format("{}: cannot be {}: {}", path, what, why));
}

std::string last_error() { return errno == 0 ? "unknown error" : std::strerror(errno); }

/// An open file, closed at the end of its life.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  bool close() {
    const bool closed = number_ < 0 || ::close(number_) == 0;
    number_ = -1;
    return closed;
  }

 private:
  int number_;
};

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// `text` in a new file next to `path`, under a name that no file has.
std::filesystem::path write_temporary(const std::string& path, std::string_view text) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, "written", "it is a folder");
  std::random_device random;
  for (;;) {
    const std::string temporary = fmt::format("{}.{:08x}.tmp", path, random());
    errno = 0;
    OpenFile out(temporary, O_WRONLY | O_CREAT | O_EXCL);
    if (!out.is_open() && errno == EEXIST) continue;
    if (!out.is_open()) fail(path, "written", last_error());
    if (write_all(out.number(), text) && out.close()) return temporary;
    const std::string why = last_error();
    std::filesystem::remove(temporary, ignored);
    fail(path, "written", why);
  }
}

/// Is there a file with just this text? Then it keeps its time, and what is built from it need not be built again.
bool is_written(const std::string& path, std::string_view text) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) ||
      std::filesystem::file_size(path, error) != text.size())
    return false;
  std::ifstream in(path, std::ios::binary);
  return std::equal(text.begin(), text.end(), std::istreambuf_iterator<char>(in),
                    std::istreambuf_iterator<char>());
}

/// Devices and pipes take text as it comes: a file in the place of one would be no device any more.
bool is_stream(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// A pipe that nobody reads is an error, not a wait.
void write_stream(const std::string& path, std::string_view text) {
  errno = 0;
  OpenFile out(path, O_WRONLY | O_NONBLOCK);
  const bool written = out.is_open() && fcntl(out.number(), F_SETFL, O_WRONLY) == 0 &&
                       write_all(out.number(), text) && out.close();
  if (!written) fail(path, "written", last_error());
}

/// The file that a link leads to; where it leads nowhere, and of all else, `path`.
std::string behind_links(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path found = std::filesystem::canonical(path, error);
  return error ? path : found.string();
}

/// What is left in a file or a pipe, at most kLargestFile bytes.
std::string read_all(const std::string& path, int file) {
  constexpr int kPatience = 10000;  // ms
  std::string text;
  char buffer[65536];
  for (;;) {
    const ssize_t count = read(file, buffer, sizeof buffer);
    if (count == 0) return text;
    if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    if (text.size() > kLargestFile)
      fail(path, "read", fmt::format("it is larger than {} MiB", kLargestFile >> 20));
    if (count > 0 || errno == EINTR) continue;
    if (errno != EAGAIN) fail(path, "read", last_error());
    pollfd waiting{file, POLLIN, 0};
    if (poll(&waiting, 1, kPatience) == 0) fail(path, "read", "nothing arrives");
  }
}

/// A file or a link, where there is one; no folder.
void remove_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path, error);
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_symlink(status)) return;
  std::filesystem::remove(path, error);
  if (error) fail(path, "removed", error.message());
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
  errno = 0;
  const OpenFile in(path, O_RDONLY | O_NONBLOCK);
  struct stat status {};
  if (!in.is_open() || fstat(in.number(), &status) != 0) fail(path, "read", last_error());
  if (S_ISDIR(status.st_mode)) fail(path, "read", "it is a folder");
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) fail(path, "read", "it is a device");
  return read_all(path, in.number());
}

void write_file(const std::string& given, std::string_view text) {
  if (is_written(given, text)) return;
  if (is_stream(given)) return write_stream(given, text);
  const std::string path = behind_links(given);
  const Uninterrupted all_of_it;
  const std::filesystem::path temporary = write_temporary(path, text);
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  fail(path, "written", error.message());
}

void write_file_by(const std::string& given, const std::function<void(const std::string&)>& make) {
  if (is_stream(given)) fail(given, "written", "it is a device");
  const std::string path = behind_links(given);
  std::filesystem::path temporary;
  std::optional<RemovedOnInterruption> removed;
  {
    const Uninterrupted until_known;
    temporary = write_temporary(path, "");
    removed.emplace(temporary.string());
  }
  std::error_code error;
  try {
    make(temporary.string());
    std::filesystem::rename(temporary, path, error);
    if (error) fail(path, "written", error.message());
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
}

void write_files(const std::string& folder, const std::vector<FileText>& files,
                 const std::vector<std::string>& stale) {
  const Uninterrupted all_of_it;
  const std::filesystem::path made = make_folder(folder);
  std::vector<std::filesystem::path> temporary;
  const auto path_of = [&folder](const FileText& file) {
    return (std::filesystem::path(folder) / file.name).string();
  };
  std::error_code ignored;
  try {
    for (const FileText& file : files)
      temporary.push_back(is_written(path_of(file), file.text) ? std::filesystem::path()
                                                               : write_temporary(path_of(file), file.text));
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (temporary[i].empty()) continue;
      std::error_code error;
      std::filesystem::rename(temporary[i], path_of(files[i]), error);
      if (error) fail(path_of(files[i]), "written", error.message());
    }
  } catch (...) {
    for (const auto& path : temporary) std::filesystem::remove(path, ignored);
    if (!made.empty()) std::filesystem::remove_all(made, ignored);
    throw;
  }
  for (const std::string& name : stale) remove_file((std::filesystem::path(folder) / name).string());
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
