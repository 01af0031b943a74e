// Numbers that look random and depend on nothing but what they are drawn for.
#pragma once

#include <cstdint>

#include "ir/program.hpp"

namespace jourdain::ir {

/// One step of splitmix64 (Steele, Lea and Flood 2014) from a state that `word` was mixed into.
inline std::uint64_t scrambled(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) + 0x9e3779b97f4a7c15u;
  state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
  state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
  return state ^ (state >> 31);
}

/// What a leaf is drawn from; the same in all programs.
inline std::uint64_t seed_of_leaf(const Node& leaf) {
  return scrambled(scrambled(0, static_cast<std::uint64_t>(leaf.leaf)), leaf.index);
}

/// Uniform in [0, 1).
inline double unit_of(std::uint64_t scrambled_bits) {
  return static_cast<double>(scrambled_bits >> 11) * 0x1p-53;
}

}  // namespace jourdain::ir
