// What emitted files are made from, for build systems.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

/// A rule of Makefile syntax, as Ninja and make read it: `targets` depend on `sources`. Paths are made absolute, and
/// what means something to make (blanks, '#', '$') is escaped.
std::string dependency_rule(const std::vector<std::string>& targets, const std::vector<std::string>& sources);

}  // namespace jourdain::commands
