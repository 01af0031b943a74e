// Whole files in, whole files out.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::support {

/// A file that is to be written.
struct FileText {
  std::string name;
  std::string text;
};

/// A file and the hash of its text.
struct FileHash {
  std::string path;
  std::string sha256;
};

/// Reads a whole file or pipe. Throws EnvironmentError naming the path when it cannot be read, is a device or
/// larger than 256 MiB, or a pipe keeps silent for ten seconds.
std::string read_file(const std::string& path);

/// Writes through a temporary file in the same folder and renames it, so that no reader sees half a file. A
/// file with that text stays as it is. Devices and pipes are written to, links followed.
/// Throws EnvironmentError naming the path.
void write_file(const std::string& path, std::string_view text);

/// The same with a file that `make` writes under the name that it is given, which is not `path`, however large it is.
/// An interruption leaves nothing behind; no file is made in place of a device.
void write_file_by(const std::string& path, const std::function<void(const std::string&)>& make);

/// Writes all files into `folder`, which is made where it is missing: all under temporary names, then all
/// renamed; those with that text stay as they are. Then removes the files in it that are named `stale`. Throws
/// EnvironmentError naming the path; nothing of it is left then. A signal waits until it is done.
void write_files(const std::string& folder, const std::vector<FileText>& files,
                 const std::vector<std::string>& stale = {});

/// Throws EnvironmentError where no file can be written into `folder`, or where it cannot be made. Leaves
/// nothing behind.
void check_writable(const std::string& folder);

}  // namespace jourdain::support
