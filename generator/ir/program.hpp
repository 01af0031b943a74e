// The straight-line program that the passes work on: arrays of operations in SSA form.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/check.hpp"
#include "support/elementary_functions.hpp"
#include "support/index.hpp"
#include "support/leaf_kind.hpp"
#include "support/scaled_real.hpp"

namespace jourdain::ir {

using ValueId = support::Index<struct ValueTag>;

enum class Op : std::uint8_t {
  kLiteral,
  kLeaf,
  kNegate,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kSqrt,
  kSin,
  kCos,
  kAtan2,  ///< atan2(a, b): the angle of (b, a), in (−π, π]
  // The other functions, in their order.
  kExp,
  kLog,
  kSinh,
  kCosh,
  kTanh,
  kPower,
  kAbs,
  kFloor,
  kMin,
  kMax,
  kWhereNegative,
  kWhereNotNegative,
  kEntry,
  kArgument,
  kCall
};

constexpr Op op_of(support::Function function) {
  return static_cast<Op>(static_cast<std::uint8_t>(Op::kAtan2) + static_cast<std::uint8_t>(function));
}
constexpr bool is_function(Op op) { return op >= Op::kAtan2; }
/// Of an op with is_function(op).
constexpr support::Function function_of(Op op) {
  return static_cast<support::Function>(static_cast<std::uint8_t>(op) -
                                        static_cast<std::uint8_t>(Op::kAtan2));
}
/// Takes one of its operands, or a part of one, as it is: costs about as much as a sum.
constexpr bool is_selection(Op op) { return is_function(op) && support::facts_of(function_of(op)).has_kinks; }

/// A call of user code, or a list of its arguments, which is no value.
constexpr bool is_call(Op op) { return op == Op::kCall || op == Op::kArgument; }

using support::kLeafKinds;
using support::LeafKind;

struct Node {
  Op op = Op::kLiteral;
  LeafKind leaf = LeafKind::kParameter;  ///< kLeaf
  std::uint32_t index = 0;               ///< kLeaf: entry of that array
  double literal = 0;                    ///< kLiteral: what is written, the nearest double
  std::array<double, 3> tail = {};       ///< kLiteral: what the constant is beyond that, see support::split
  ValueId a{}, b{};                      ///< operands; b of binary operations only

  friend bool operator==(const Node&, const Node&) = default;
};

/// The constant of a kLiteral to 63 digits.
cln::cl_R exact_literal(const Node& node);

/// Number of operands of an operation: 0, 1 or 2.
int operand_count(Op op);
const char* op_name(Op op);
const char* leaf_name(LeafKind kind);

/// One result of a program: entry `index` of the array `name`, or a scalar where `index` is negative.
struct Output {
  std::string name;
  int row = -1;
  int column = -1;
  ValueId value{};
};

/// A value's index is its position; operands come earlier, so the order is a schedule.
struct Program {
  std::string name;
  std::vector<Node> nodes;
  std::vector<std::string> labels;  ///< mechanical name of a value ("w3_x"), or empty
  std::vector<Output> outputs;
  /// Values that may be computed at once, by one operation on several numbers: two or more, of one op, next to each
  /// other, none of which needs another. A value stands there once.
  std::vector<std::vector<ValueId>> lanes;

  const Node& operator[](ValueId id) const {
    JD_CHECK(id.value < nodes.size(), "value {} of {}", id.value, nodes.size());
    return nodes[id.value];
  }
};

/// Operations of a program by kind. Leaves and literals cost nothing.
struct Operations {
  std::size_t add = 0, subtract = 0, multiply = 0, divide = 0, sqrt = 0, negate = 0, sin = 0, cos = 0,
              atan2 = 0;
  std::size_t functions = 0;  ///< exp, log, sinh, cosh, tanh, powers with real exponents, calls of user code
  std::size_t selections =
      0;  ///< abs, floor, min, max, what is taken where a sign says so, entries of arrays

  /// add + subtract + multiply + divide + sqrt; the others are counted apart.
  std::size_t arithmetic() const { return add + subtract + multiply + divide + sqrt; }
  friend bool operator==(const Operations&, const Operations&) = default;
};

Operations count_operations(const Program& program);

/// Human-readable listing, one value a line: `%12 S3_xx = mul %4 %7`; then the outputs.
std::string print(const Program& program);

/// How often each value is used, by operations and outputs.
std::vector<std::size_t> use_counts(const Program& program);

/// Values of leaves by kind; a span may be empty where a program has no such leaf.
template <class Real>
struct LeafValues {
  std::array<std::vector<Real>, kLeafKinds> of;

  std::vector<Real>& operator[](LeafKind kind) { return of[static_cast<std::size_t>(kind)]; }
  const std::vector<Real>& operator[](LeafKind kind) const { return of[static_cast<std::size_t>(kind)]; }
};

/// A value of a program, not a leaf, from those that are before it.
template <class Real>
Real computed(const Node& node, const std::vector<Real>& earlier);

/// The outputs of a program, in order, computed in `Real` arithmetic: double, float, long double take literals
/// as they are written, support::ScaledReal takes the constants that they stand for.
template <class Real>
std::vector<Real> interpret(const Program& program, const LeafValues<Real>& leaves);

}  // namespace jourdain::ir
