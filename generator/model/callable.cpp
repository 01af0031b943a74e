#include "model/callable.hpp"

namespace jourdain::model {

Expression with_arguments(const Expression& value, std::span<const Expression> arguments) {
  return value.substituted([&arguments](const Variable& v) {
    return v.kind == Variable::Kind::kArgument ? arguments[v.component] : Expression::variable(v);
  });
}

}  // namespace jourdain::model
