// Over which independent coordinates a closed form holds.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ir/builder.hpp"
#include "loops/intervals/positivity.hpp"
#include "loops/record/proven_box.hpp"

namespace jourdain::loops {

/// A value that must be positive for a closed form to hold.
struct Requirement {
  ir::Signed value;
  bool is_margin = true;   ///< of ReachRequest::margin, its least value is reported; otherwise of a divisor
  std::string dependents;  ///< names of what is found by it
};

struct ReachRequest {
  const ir::Builder& builder;
  const std::vector<Requirement>& requirements;
  const std::vector<double>& parameters;
  const std::vector<bool>& angular;                                          ///< by entry of y
  const std::vector<std::optional<std::array<double, 2>>>& range;            ///< by entry of y
  const std::vector<std::string>& names;                                     ///< by entry of y
  const std::vector<std::size_t>& dependents;                                ///< entries of y
  const std::vector<std::optional<std::array<double, 2>>>& parameter_range;  ///< none: as in `parameters`
  const std::vector<std::string>& parameter_names;
  const char* margin = "discriminant";  ///< what a margin is of, in messages
};

struct Reached {
  double margin = 1;                   ///< 1 where no root is taken
  std::vector<ProvenRange> positions;  ///< that matter and have a range
};

/// The least margin that is proven wherever the independent coordinates may be: within their range, an angle
/// without one or one that time drives anywhere; and for all parameters within their ranges. Otherwise what is
/// not proven, a phrase for the user.
std::variant<Reached, std::string> smallest_margin(const ReachRequest& request, Effort effort = {});

}  // namespace jourdain::loops
