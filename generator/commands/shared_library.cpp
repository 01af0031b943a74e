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

void build_shared_library(const std::string& folder, const std::vector<std::string>& sources,
                          const std::string& library, const std::vector<std::string>& compiler,
                          const std::vector<std::string>& flags) {
  std::vector<std::string> command = compiler;
  // Of two libraries with one name each calls its own functions.
  command.insert(command.end(), {"-std=c99", "-fPIC", "-shared", "-Wl,-Bsymbolic"});
  command.insert(command.end(), flags.begin(), flags.end());
  for (const std::string& source : sources) command.push_back(folder + "/" + source);
  command.insert(command.end(), {"-o", folder + "/" + library, "-lm"});
  run_tool(command);
}

}  // namespace jourdain::commands
