#include "model/coupler.hpp"

#include <utility>

namespace jourdain::model {

Loop coupler(std::string name, std::span<const CouplerTerm> terms, const Expression& offset,
             SourceRange where) {
  Loop loop;
  loop.name = std::move(name);
  loop.type = LoopType::kResidual;
  loop.where = where;
  for (const CouplerTerm& term : terms) {
    const Variable position{Variable::Kind::kPosition, term.joint.value, term.coordinate};
    loop.residual = Expression::binary(
        Expression::Op::kAdd, loop.residual,
        Expression::binary(Expression::Op::kMultiply, term.factor, Expression::variable(position)));
  }
  loop.residual = Expression::binary(Expression::Op::kSubtract, loop.residual, offset);
  return loop;
}

}  // namespace jourdain::model
