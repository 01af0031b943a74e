// Building programs: equal operations get one value, trivial ones none, signs move outward.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::ir {

/// A value or its negative. Carrying the sign beside the value keeps negations out of the program.
struct Signed {
  ValueId value;
  bool negative = false;
  Signed operator-() const { return {value, !negative}; }
};

/// Hash-consing builder. Constants are folded to 63 digits.
/// Operations with 0 and ±1, of equal operands and of two literals are simplified; operands of commutative
/// operations are put in order of their index, so that the program depends on the calls alone.
class Builder {
 public:
  Builder() = default;
  /// With room for so many values.
  explicit Builder(std::size_t count);

  Signed literal(double value);
  Signed literal(const cln::cl_R& value);  ///< exact to 63 digits
  Signed leaf(LeafKind kind, std::size_t index);
  Signed add(Signed a, Signed b);
  Signed subtract(Signed a, Signed b) { return add(a, -b); }
  Signed multiply(Signed a, Signed b);
  Signed divide(Signed a, Signed b);
  Signed unary(Op op, Signed a);  ///< kNegate, kSqrt, kSin (odd), kCos (even)
  /// The angle of (b, a). Signs stay inside: atan2(−a, b) is not −atan2(a, b) where a = 0 and b < 0. Of literals only
  /// atan2(0, b > 0) = 0 is folded: the others' last digit is the machine's.
  Signed atan2(Signed a, Signed b);
  /// f(a, b), or f(a). Of what is taken where a sign says so the sign moves outward; else only what literals decide is
  /// simplified.
  Signed function(support::Function function, Signed a, Signed b);

  /// The operation of `node` on operands of this builder.
  Signed apply(const Node& node, Signed a, Signed b);

  /// Gives a value a mechanical name, unless it has one.
  void label(ValueId value, const std::string& name);
  void output(const std::string& name, int row, int column, Signed value);

  /// Is it a literal, and which? (with the sign)
  bool is_literal(Signed a, double value) const;

  const Program& program() const { return program_; }
  Program finish(std::string name);

 private:
  ValueId intern(const Node& node);
  ValueId with_its_sign(Signed a);
  cln::cl_R literal_of(Signed a) const;
  bool is_literal(Signed a) const;  ///< one that can be folded

  void grow(std::size_t size);  ///< of the hash table

  Program program_;
  /// Hash table with open addressing: a value's index + 1, or 0; its size is a power of two.
  std::vector<std::uint32_t> known_;
};

}  // namespace jourdain::ir
