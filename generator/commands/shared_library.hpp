// Emitted C as a library that other programs load.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

/// The compiler of C on this machine: the words of the environment variable CC, else cc.
std::vector<std::string> machine_c_compiler();

/// Compiles `sources`, names of files in `folder`, to `folder`/`library`, with `flags` behind the compiler's name and
/// what a library needs. Throws EnvironmentError with the compiler's first words where it fails.
void build_shared_library(const std::string& folder, const std::vector<std::string>& sources,
                          const std::string& library, const std::vector<std::string>& compiler,
                          const std::vector<std::string>& flags);

/// A source in C++17 that is compiled by itself.
struct CppSource {
  std::string name;  ///< in the folder, with ".cpp"
  std::vector<std::string> compiler, flags;
};

/// The same of a source in C++ as well, by whose compiler all is linked.
void build_shared_library(const std::string& folder, const std::vector<std::string>& sources,
                          const CppSource& cpp_source, const std::string& library,
                          const std::vector<std::string>& compiler, const std::vector<std::string>& flags);

/// The words of a text, which blanks separate.
std::vector<std::string> words_of(const std::string& text);

}  // namespace jourdain::commands
