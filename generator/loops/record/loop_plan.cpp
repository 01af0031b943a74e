#include "loops/record/loop_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/loop_kinds.hpp"

namespace jourdain::loops {

using model::LoopTreatment;

std::vector<std::size_t> LoopPlan::solved_rows() const {
  std::vector<std::size_t> solved;
  std::set_union(rows.begin(), rows.end(), sharing.begin(), sharing.end(), std::back_inserter(solved));
  return solved;
}

std::vector<std::size_t> LoopPlan::carried() const {
  std::vector<std::size_t> list;
  for (const Block& block : blocks)
    if (!block.binds_positions) list.insert(list.end(), block.dependents.begin(), block.dependents.end());
  std::sort(list.begin(), list.end());
  return list;
}

std::string LoopPlan::weak_in_float() const {
  constexpr double kDiscerned = 1e-4;  // of which 2^-24 is 6e-4
  if (treatment != LoopTreatment::kMultipliers || weakest >= kDiscerned) return "";
  return fmt::format(
      "in float multipliers hardly tell the weakest constraint from rounding ({:.1g} of the strongest, by G "
      "M^-1 G^T)",
      weakest);
}

double LoopPlan::most_left_open() const {
  return std::max(kAskew * std::min(1.0, length_unit), 10 * disagreement);
}

double LoopPlan::least_regularity() const {
  switch (treatment) {
    case LoopTreatment::kExplicit:
      return 1e-6;
    case LoopTreatment::kPartitioned:
      return proof ? 1e-6 : 1e-3;
    case LoopTreatment::kMultipliers:
      // Ten times the regularisation: a hundredth of the constraint force is left out. Where rows disagree
      // they tell no better what holds.
      return is_named ? 0 : std::max(1e-9, 10 * disagreement);
  }
  return 0;
}

double LoopPlan::greatest_opening() const {
  constexpr double kLeftOpen = 1e-10;
  switch (treatment) {
    case LoopTreatment::kExplicit:
      return 1e-2;  // closed in any case, but dependent positions were integrated badly
    case LoopTreatment::kPartitioned:
      if (proof) return proof->first_correction * proof->first_correction;
      return std::pow(kLeftOpen, std::ldexp(2.0, -iterations));  // each iteration squares the distance
    case LoopTreatment::kMultipliers:
      return kLeftOpen;  // one step
  }
  return 0;
}

std::vector<std::string> row_names(const model::Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const model::Loop& loop : mechanism.loops)
    for (const model::LoopRow& row : model::loop_kind(loop.type).rows)
      names.push_back(fmt::format("{}.{}", loop.name, row.name));
  return names;
}

}  // namespace jourdain::loops
