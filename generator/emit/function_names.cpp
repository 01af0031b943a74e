#include "emit/function_names.hpp"

#include <array>

namespace jourdain::emit {

const char* function_name(support::Function function) {
  constexpr std::array<const char*, support::kFunctions> kNames = {"arctangent2",
                                                                   "exponential",
                                                                   "logarithm",
                                                                   "hyperbolic_sine",
                                                                   "hyperbolic_cosine",
                                                                   "hyperbolic_tangent",
                                                                   "real_power",
                                                                   "absolute",
                                                                   "whole_below",
                                                                   "smaller",
                                                                   "larger",
                                                                   "where_negative",
                                                                   "where_not_negative",
                                                                   "entry",
                                                                   "argument",
                                                                   "call"};
  return kNames[static_cast<std::size_t>(function)];
}

}  // namespace jourdain::emit
