#include "readback/domain.hpp"

#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

std::size_t* counter(ir::Operations& count, ir::Op op) {
  switch (op) {
    case ir::Op::kLiteral:
    case ir::Op::kLeaf:
    case ir::Op::kArgument:
      return nullptr;
    case ir::Op::kNegate:
      return &count.negate;
    case ir::Op::kAdd:
      return &count.add;
    case ir::Op::kSubtract:
      return &count.subtract;
    case ir::Op::kMultiply:
      return &count.multiply;
    case ir::Op::kDivide:
      return &count.divide;
    case ir::Op::kSqrt:
      return &count.sqrt;
    case ir::Op::kSin:
      return &count.sin;
    case ir::Op::kCos:
      return &count.cos;
    case ir::Op::kAtan2:
      return &count.atan2;
    default:
      return ir::is_selection(op) ? &count.selections : &count.functions;
  }
}

}  // namespace

Number Domain::operate(ir::Op op, Number a, Number b) {
  const bool is_fraction = op == ir::Op::kDivide && is_literal(a) && is_literal(b);
  if (std::size_t* counted = counter(count_, op); counted && !is_fraction) ++*counted;
  return apply(op, a, b);
}

Number Domain::array(std::vector<double> values) { return literal(support::number_of_array(values)); }

bool Domain::is_less(Number, Number) {
  throw Refusal("numbers are compared where the result must not depend on them");
}
bool Domain::is_at_most(Number a, Number b) { return is_less(a, b); }

}  // namespace jourdain::readback
