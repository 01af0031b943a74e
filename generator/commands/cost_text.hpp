// What emitted functions and steps cost, as text and JSON.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands/code_cost.hpp"
#include "studies/report.hpp"
#include "studies/step_cost.hpp"

namespace jourdain::commands {

struct CostReport {
  const studies::ReportHead& head;
  const CompiledModel& compiled;
  const jourdain_model_table& table;
  std::optional<std::map<std::string, CodeCost>>
      code;  ///< by function; none where the compiler does not tell
  std::vector<studies::StepCost> steps;
  double h = 0;           ///< s, of the steps
  double clock_tick = 0;  ///< s
};

/// For a terminal, lines of 110 characters at most.
std::string cost_text(const CostReport& report);

std::string cost_json(const CostReport& report);

}  // namespace jourdain::commands
