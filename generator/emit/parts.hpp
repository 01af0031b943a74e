// A long list of statements, cut into parts that hand values on through an array.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace jourdain::emit {

/// Statements of a function. A compiler's time grows faster than the length of a function, and what passes from part to
/// part goes through memory: TALOS' forward dynamics (1865) take 0.9 of the time, and 0.9 of the code, in one part
/// instead of two; its derivatives (26 000) compile in 44 s in parts of 1500, in 53 s in parts of 3000.
struct Lengths {
  std::size_t whole = 4000;  ///< a longer one is cut
  std::size_t part = 1500;   ///< its parts hold at most so many
};

/// Declares value `value`, and `width` − 1 more with it, of values that other statements declare.
struct Declaration {
  std::size_t value = 0, width = 1;
  std::set<std::size_t> reads = {};
};

struct Parts {
  std::size_t count = 1;
  std::map<std::size_t, std::size_t> part_of;  ///< by value
  /// Of the array, the first of `width`, for each value that a later part reads.
  std::map<std::size_t, std::size_t> entries;
  std::size_t size = 0;  ///< of the array; its entries are used again
};

/// `pairs`: values that are declared where another one is. `results` are read after all declarations.
Parts cut_into_parts(const std::vector<Declaration>& declarations,
                     const std::map<std::size_t, std::size_t>& pairs, const std::set<std::size_t>& results,
                     const Lengths& lengths);

}  // namespace jourdain::emit
