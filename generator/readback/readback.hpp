// The gate between the finished text and the user: the bytes that are about to be written are read as C++ or C
// and JSON, and must say what was validated.
#pragma once

#include <string>
#include <vector>

#include "readback/expected.hpp"
#include "support/files.hpp"

namespace jourdain::readback {

/// What was looked at.
struct Record {
  std::size_t functions = 0;  ///< executed and compared with their programs
  std::size_t nodes = 0;      ///< distinct operations, leaves and literals of all of them
  std::size_t numbers = 0;    ///< results compared
  std::size_t steps = 0;      ///< steps compared with their methods
  std::size_t points = 0;     ///< random points of all steps, in 70 digits
};

struct Readback {
  std::vector<std::string> differences;  ///< sentences; empty where text and validated model agree
  Record record;
};

/// Reads NAME.hpp, NAME_kernels.hpp, NAME.cpp and NAME.json, in this order; of C NAME.h and NAME.c, NAME_f.h and
/// NAME_f.c, NAME.json, as far as they are expected. Functions with a program are
/// compared with it node by node, which holds for all states; steps with their methods at random points;
/// names, sizes, defaults, limits and counts with what is expected. What cannot be read is a difference;
/// nothing is thrown.
Readback read_back(const std::vector<support::FileText>& files, const Expected& expected);

/// The differences alone.
std::vector<std::string> differences(const std::vector<support::FileText>& files, const Expected& expected);

}  // namespace jourdain::readback
