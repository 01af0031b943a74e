// Other ways to compute the values of a program: what each equals as a function of all leaves.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ir/fingerprints.hpp"
#include "passes/definition.hpp"
#include "passes/exact_values.hpp"

namespace jourdain::passes {

using ir::Fingerprint;
using ir::Residue;

/// Looks up values by residues that do not tell a value from its negative.
class ResidueIndex {
 public:
  explicit ResidueIndex(const std::vector<Residue>& keys);

  struct Entry {
    std::uint64_t key = 0;
    std::size_t value = 0;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : a.value < b.value;
    }
  };

  /// Values of that key, in their order.
  std::span<const Entry> values_of(Residue key) const;
  /// False where there are none; true may be wrong.
  bool may_have(Residue key) const {
    const std::uint64_t bit = size_of(key) & mask_;
    return (present_[bit / 64] >> (bit % 64) & 1) != 0;
  }

 private:
  static std::uint64_t size_of(Residue key) { return key.is_negative() ? (-key).value() : key.value(); }

  std::vector<Entry> sorted_;
  std::vector<std::uint64_t> present_;  ///< a bit for each remainder of sizes
  std::uint64_t mask_ = 0;
};

/// Values are compared with those near them, which have to do with the same operands: nearly all of what could be
/// found among all of them is found there, in a time that grows with the program.
class EqualValues {
 public:
  EqualValues(const ir::Program& program, std::vector<Fingerprint> fingerprints);

  /// How a value can be computed from values before it: as a number, or from one of them and numbers, which are not
  /// known yet.
  std::vector<Definition> lines(ir::ValueId id) const;
  /// As sum or product of two values, of which one is near it.
  std::vector<Definition> pairs(ir::ValueId id);
  /// With its numbers. None where these cannot be told to all the digits of a literal.
  std::optional<Definition> with_numbers(ir::ValueId id, Definition definition);

 private:
  std::optional<Definition> line(std::size_t v, std::size_t x) const;
  std::vector<std::size_t> near(std::size_t v);
  void add_sums(std::size_t v, ir::Signed x, std::vector<Definition>& list) const;
  void add_products(std::size_t v, std::size_t x, std::vector<Definition>& list) const;

  const ir::Program& program_;
  std::vector<Fingerprint> fingerprints_;
  std::vector<Residue> first_, inverses_;  ///< at the first point
  std::vector<Residue>
      line_keys_;  ///< the same for values of which each is another one times and plus numbers
  ResidueIndex by_value_, by_line_;
  std::array<ExactValues, 3> exact_;             ///< two to tell numbers from, one to see that they hold
  std::vector<std::vector<std::size_t>> users_;  ///< of each value, in their order
  std::vector<std::size_t> visited_;             ///< the visit in which a value was last near
  std::size_t visit_ = 0;
};

}  // namespace jourdain::passes
