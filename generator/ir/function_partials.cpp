#include "ir/function_partials.hpp"

namespace jourdain::ir {

using support::Function;

std::pair<Signed, Signed> partials(Builder& builder, Function function, Signed a, Signed b, Signed value,
                                   bool by_b) {
  const Signed zero = builder.literal(0), one = builder.literal(1);
  switch (function) {
    case Function::kAtan2: {
      const Signed of_b = builder.multiply(b, b), square = builder.add(builder.multiply(a, a), of_b);
      const Signed of_a = builder.divide(b, square);
      return {of_a, by_b ? -builder.divide(a, square) : zero};
    }
    case Function::kExp:
      return {value, zero};
    case Function::kLog:
      return {builder.divide(one, a), zero};
    case Function::kSinh:
      return {builder.function(Function::kCosh, a, a), zero};
    case Function::kCosh:
      return {builder.function(Function::kSinh, a, a), zero};
    case Function::kTanh:
      return {builder.subtract(one, builder.multiply(value, value)), zero};
    case Function::kPower: {
      const Signed less = builder.function(Function::kPower, a, builder.subtract(b, one));
      const Signed of_a = builder.multiply(b, less);
      return {of_a, by_b ? builder.multiply(value, builder.function(Function::kLog, a, a)) : zero};
    }
    case Function::kAbs: {
      const Signed below = builder.function(Function::kWhereNegative, a, -one);
      return {builder.add(below, builder.function(Function::kWhereNotNegative, a, one)), zero};
    }
    case Function::kFloor:
    case Function::kEntry:
    case Function::kArgument:  // of calls: Graph::add_slopes
    case Function::kCall:
      return {zero, zero};
    case Function::kMin:
    case Function::kMax: {
      const Signed left = builder.subtract(a, b);
      const bool is_min = function == Function::kMin;
      const Signed difference = is_min ? -left : left;
      return {builder.function(Function::kWhereNotNegative, difference, one),
              builder.function(Function::kWhereNegative, difference, one)};
    }
    case Function::kWhereNegative:
    case Function::kWhereNotNegative:
      return {zero, builder.function(function, a, one)};
  }
  return {zero, zero};
}

}  // namespace jourdain::ir
