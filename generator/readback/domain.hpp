// What numbers are while text is executed: nodes of expressions, or numbers of many digits.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::readback {

/// A number, by its place in the domain that made it.
using Number = std::uint32_t;

/// A closed set of numbers and operations; whoever executes text decides what they are.
class Domain {
 public:
  virtual ~Domain() = default;

  virtual Number literal(double value) = 0;
  /// The number of an array of constants, as operations take it.
  virtual Number array(std::vector<double> values);
  /// Counts the operation. `b` of binary operations only.
  Number operate(ir::Op op, Number a, Number b = 0);
  /// Is a < b, a ≤ b? Throws Refusal where numbers have no order.
  virtual bool is_less(Number a, Number b);
  virtual bool is_at_most(Number a, Number b);

  /// Operations since the last `clear_count`; quotients of two literals count as literals.
  const ir::Operations& count() const { return count_; }
  /// What is one addition here takes that many more.
  void count_additions(std::size_t more) { count_.add += more; }
  void clear_count() { count_ = {}; }

 protected:
  virtual Number apply(ir::Op op, Number a, Number b) = 0;
  virtual bool is_literal(Number a) const = 0;

 private:
  ir::Operations count_;
};

}  // namespace jourdain::readback
