#include "fuzz/readers/said.hpp"
#include "model/units.hpp"

/// As a unit alone, and as a number with one.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {  // NOLINT: its name
  using namespace jourdain::model;
  const std::string text(data, data + size);
  const auto parsed = parse_unit(text);
  if (const auto* error = std::get_if<UnitError>(&parsed))
    jourdain::tests::require(error->offset <= size && !error->message.empty());
  else
    in_si(2.5, std::get<Unit>(parsed));
  if (const auto quantity = split_quantity(text)) parse_unit(quantity->second);
  return 0;
}
