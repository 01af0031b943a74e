// Models of models/ emitted while a test runs.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.hpp"

namespace jourdain::tests {

/// The model's files in `folder`, by the command with more options.
inline void emit_model(const std::string& model, const std::string& folder,
                       const std::vector<std::string>& options) {
  std::vector<std::string> command = {
      "env", "-C",  JOURDAIN_SOURCE_DIR, JOURDAIN_BINARY, "compile", fmt::format("models/{}.toml", model),
      "-o",  folder};
  command.insert(command.end(), options.begin(), options.end());
  const support::ProcessResult result = support::run_process(command);
  ASSERT_EQ(result.status, 0) << result.output;
}

}  // namespace jourdain::tests
