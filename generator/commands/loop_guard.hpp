// When a run of a mechanism with closed loops must end: what closes them says so.
#pragma once

#include <string>
#include <vector>

#include "commands/load.hpp"
#include "studies/flow.hpp"

namespace jourdain::commands {

/// The limits of one model's emitted State (regularity, opening), and the ranges for which something was proven.
class LoopGuard {
 public:
  /// Refers to both; steps are of length `h`, s.
  LoopGuard(const studies::Flow<double>& flow, const LoadedMechanism& loaded, double h);

  /// What is wrong with the last steps of the flow, which ended at `point`: a sentence for the user that says
  /// what to do. Empty where nothing is.
  std::string problem(const studies::Point<double>& point) const;

 private:
  std::string singular(double t, double regularity) const;
  /// Where State says that a position is.
  std::string out_of_range(const studies::Point<double>& point) const;

  const studies::Flow<double>& flow_;
  const LoadedMechanism& loaded_;
  std::vector<double> parameters_;
  double h_;
};

}  // namespace jourdain::commands
