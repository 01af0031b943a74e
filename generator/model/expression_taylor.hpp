// Derivatives of expressions by one number.
#pragma once

#include <span>
#include <vector>

#include "model/expression.hpp"
#include "model/taylor.hpp"

namespace jourdain::model {

/// Value and derivatives at these parameters; `variable` gives those of a Variable.
template <class Scalar, class VariableTaylor>
Taylor<Scalar> taylor_of(const Expression& expression, std::span<const Scalar> parameters,
                         const VariableTaylor& variable) {
  std::vector<Taylor<Scalar>> constants;
  for (const Scalar& parameter : parameters) constants.push_back({parameter, Scalar(0), Scalar(0)});
  return expression.evaluate<Taylor<Scalar>>(
      constants,
      [](double v) {
        return Taylor<Scalar>{Scalar(v), Scalar(0), Scalar(0)};
      },
      variable);
}

}  // namespace jourdain::model
