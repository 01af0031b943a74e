#include "commands/shared_library.hpp"

#include <cstdlib>
#include <iterator>
#include <sstream>

#include "commands/tool.hpp"

namespace jourdain::commands {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

std::vector<std::string> machine_c_compiler() {
  const char* chosen = std::getenv("CC");
  const std::vector<std::string> command = words_of(chosen ? chosen : "");
  return command.empty() ? std::vector<std::string>{"cc"} : command;
}

namespace {

/// A compiler's name and its options, of a language.
std::vector<std::string> compiling(std::vector<std::string> compiler, const char* standard,
                                   const std::vector<std::string>& flags) {
  compiler.insert(compiler.end(), {standard, "-fPIC"});
  compiler.insert(compiler.end(), flags.begin(), flags.end());
  return compiler;
}

// Of two libraries with one name each calls its own functions.
constexpr const char* kLinking[] = {"-shared", "-Wl,-Bsymbolic"};

}  // namespace

void build_shared_library(const std::string& folder, const std::vector<std::string>& sources,
                          const std::string& library, const std::vector<std::string>& compiler,
                          const std::vector<std::string>& flags) {
  std::vector<std::string> command = compiling(compiler, "-std=c99", flags);
  command.insert(command.end(), std::begin(kLinking), std::end(kLinking));
  for (const std::string& source : sources) command.push_back(folder + "/" + source);
  command.insert(command.end(), {"-o", folder + "/" + library, "-lm"});
  run_tool(command);
}

void build_shared_library(const std::string& folder, const std::vector<std::string>& sources,
                          const CppSource& cpp_source, const std::string& library,
                          const std::vector<std::string>& compiler, const std::vector<std::string>& flags) {
  std::vector<std::string> link = compiling(cpp_source.compiler, "-std=c++17", cpp_source.flags);
  link.insert(link.end(), std::begin(kLinking), std::end(kLinking));
  const auto compile = [&](std::vector<std::string> command, const std::string& source) {
    const std::string object = folder + "/" + source + ".o";
    command.insert(command.end(), {"-c", folder + "/" + source, "-o", object});
    run_tool(command);
    link.push_back(object);
  };
  for (const std::string& source : sources) compile(compiling(compiler, "-std=c99", flags), source);
  compile(compiling(cpp_source.compiler, "-std=c++17", cpp_source.flags), cpp_source.name);
  link.insert(link.end(), {"-o", folder + "/" + library, "-lm", "-pthread"});
  run_tool(link);
}

}  // namespace jourdain::commands
