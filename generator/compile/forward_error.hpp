// What rounding does to accelerations, sampled: at the description's parameters and where one of them is extreme.
#pragma once

#include <string>
#include <vector>

#include "ir/program.hpp"
#include "validate/samples.hpp"

namespace jourdain {

/// In units of the largest acceleration's unit roundoff: the median over some states, infinite where double
/// has no value at one of them.
struct SampledError {
  double units = 0;
  std::string where;  ///< "l2 = 1e+06", or empty: at the description's parameters
};

class ForwardError {
 public:
  explicit ForwardError(const model::Mechanism& mechanism);

  /// The worst of: the description's parameters; each parameter at the ends of its range, or a million times
  /// more and less. Of large programs only the first.
  SampledError of(const ir::Program& zdot) const;

 private:
  struct Case {
    std::string where;
    std::vector<validate::Point> points;
  };
  void add(const std::string& where, std::size_t parameter, double value);

  const model::Mechanism& mechanism_;
  std::vector<validate::Sample> samples_;
  std::vector<Case> cases_;
};

}  // namespace jourdain
