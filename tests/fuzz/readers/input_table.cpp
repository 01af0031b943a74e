#include "commands/input_table.hpp"

#include "fuzz/readers/said.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {  // NOLINT: its name
  jourdain::support::Diagnostics diagnostics("inputs.csv", std::string(data, data + size));
  const auto inputs = jourdain::commands::read_input_table(diagnostics, {"force", "torque"});
  jourdain::tests::check_said(diagnostics, inputs != nullptr);
  if (inputs) jourdain::tests::require(inputs->at(0.05).size() == 2);
  return 0;
}
