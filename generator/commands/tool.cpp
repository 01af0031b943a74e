#include "commands/tool.hpp"

#include <fmt/format.h>

#include "support/check.hpp"
#include "support/process.hpp"

namespace jourdain::commands {

std::string run_tool(const std::vector<std::string>& command) {
  constexpr std::size_t kWords = 2000;
  const support::ProcessResult result = support::run_process(command);
  if (result.status == 0) return result.output;
  throw support::EnvironmentError(fmt::format("'{}' fails (exit status {}):\n{}", command.front(),
                                              result.status, result.output.substr(0, kWords)));
}

}  // namespace jourdain::commands
