#include "fuzz/readers/said.hpp"
#include "model/read/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {  // NOLINT: its name
  jourdain::support::Diagnostics diagnostics("model.mjcf", std::string(data, data + size));
  jourdain::tests::check_said(diagnostics, jourdain::model::read_mechanism(diagnostics).has_value());
  return 0;
}
