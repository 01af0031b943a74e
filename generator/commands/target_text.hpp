// Costs on a target, as text and JSON.
#pragma once

#include "commands/target_cost.hpp"
#include "studies/report.hpp"

namespace jourdain::commands {

struct TargetReport {
  const studies::ReportHead& head;
  const CompiledModel& compiled;
  const Target& target;
  TargetCosts costs;
  double step = 0;  ///< s, that steps are called with
};

/// For a terminal, lines of 110 characters at most.
std::string target_text(const TargetReport& report);

std::string target_json(const TargetReport& report);

}  // namespace jourdain::commands
