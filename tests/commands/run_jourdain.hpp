// The command as users run it, and what it is to say.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.hpp"

namespace jourdain::tests {

/// Runs `jourdain` from the project's root with settings like "CXX=g++" in its environment.
inline support::ProcessResult jourdain(const std::vector<std::string>& settings,
                                       const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {"env", "-C", JOURDAIN_SOURCE_DIR};
  command.insert(command.end(), settings.begin(), settings.end());
  command.emplace_back(JOURDAIN_BINARY);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

inline support::ProcessResult jourdain(const std::vector<std::string>& arguments) {
  return jourdain({}, arguments);
}

inline void expect(const support::ProcessResult& result, int status, const std::string& part) {
  EXPECT_EQ(result.status, status) << result.output;
  EXPECT_NE(result.output.find(part), std::string::npos) << "no '" << part << "' in\n" << result.output;
}

}  // namespace jourdain::tests
