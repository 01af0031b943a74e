// XML files with their elements and attributes changed.
#pragma once

#include <string>
#include <vector>

#include "properties/random.hpp"

namespace jourdain::tests {

/// What a format's files are changed to.
struct XmlWords {
  std::vector<std::string> elements, values;
  std::vector<std::string> attributes = {};  ///< put in anywhere; none: attributes that are there change
};

/// The file with elements and attributes deleted, doubled, renamed, moved and filled with what no one expects; `times`
/// changes. What is no XML comes back as it is.
std::string mutated_xml(const std::string& text, const XmlWords& words, int times, Random& random);

}  // namespace jourdain::tests
