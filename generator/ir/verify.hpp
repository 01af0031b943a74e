// What every program must be, whatever pass wrote it: broken programs are found where they arise, not in wrong numbers.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::ir {

/// How many leaves of each kind a program may read; zero: none of that kind.
struct LeafCounts {
  std::array<std::size_t, kLeafKinds> of{};

  std::size_t& operator[](LeafKind kind) { return of[static_cast<std::size_t>(kind)]; }
  std::size_t operator[](LeafKind kind) const { return of[static_cast<std::size_t>(kind)]; }
};

/// What is wrong with a program, in sentences that name it; empty where nothing is. Operands and outputs are
/// values of the program, operands precede their operation, leaves are among `leaves`, literals are finite,
/// each value has its place for a label and is needed by an output, no output is given twice.
std::vector<std::string> defects(const Program& program, const LeafCounts& leaves);

}  // namespace jourdain::ir
