// Programs without time: what holds wherever driven angles may be holds at all times.
#pragma once

#include <vector>

#include "ir/builder.hpp"

namespace jourdain::loops {

/// A program in which angles that time drives, under sines and cosines, are positions of their own.
struct Timeless {
  std::vector<ir::Signed> values;  ///< of the outputs, in the builder
  std::vector<ir::ValueId>
      driven;  ///< of the program as given: the angles, rad; their leaves are numbered as they are
  bool drives_with_positions =
      false;  ///< an angle depends on positions too, other than by a sum: it stands for both
};

/// Copies the outputs of `program` into `builder`. The first driven angle becomes position `first`. Of a sum
/// of positions and driven angles only the latter are replaced. Time that is used otherwise stays.
Timeless without_clock(ir::Builder& builder, const ir::Program& program, std::size_t first);

/// Is a position used in sums under sines and cosines alone, so that a whole turn of it changes no output?
bool is_periodic(const ir::Program& program, std::size_t position);

}  // namespace jourdain::loops
