// The programs of a mechanism with loops as they are lowered, before any pass, called like functions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "programs/closed_system.hpp"

namespace jourdain::tests {

/// Of one mechanism, at the parameters' default values.
class LoopFunctions {
 public:
  explicit LoopFunctions(const model::Mechanism& mechanism);
  LoopFunctions(const LoopFunctions&) = delete;

  const loops::LoopPlan& plan() const { return plan_; }

  /// The outputs of a function, in order.
  std::vector<double> operator()(const std::string& function, const std::vector<double>& y,
                                 const std::vector<double>& z, const std::vector<double>& zdot = {},
                                 const std::vector<double>& u = {}) const;

  /// y with the entries that `function` ("close_loops", "project") sets.
  std::vector<double> closed(const std::string& function, std::vector<double> y) const;

 private:
  model::Mechanism mechanism_;
  loops::LoopPlan plan_;
  programs::ClosedSystem closed_;
};

}  // namespace jourdain::tests
