// The keys of a TOML description: what its tables may hold. The command prints them, and models/README.md is
// made from them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::model {

struct Key {
  const char* name;
  const char* type;      ///< "number": also an expression over parameters, or a number with its unit
  const char* unit;      ///< of bare numbers, as people write it; empty: none
  const char* standard;  ///< what stands where it is left out; empty: it is required
  const char* meaning;
};

inline constexpr const char* kRequired = "";  ///< standard of a key that must be there

/// One kind of table. Its example is a fragment; those of all sections, in order, are one model of models/.
struct KeySection {
  const char* name;     ///< "joint"
  const char* heading;  ///< "[[joint]]"
  const char* meaning;
  std::vector<Key> keys;
  const char* example;
};

/// In the order of the page.
std::span<const KeySection> key_sections();

/// The names of a section's keys, in order.
std::vector<std::string> keys_of(std::string_view section);

}  // namespace jourdain::model
