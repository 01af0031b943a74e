// What was decided about a mechanism's loops, for people.
#pragma once

#include <string>
#include <vector>

#include "loops/record/loop_plan.hpp"

namespace jourdain::loops {

/// How the loops are closed, in sentences for the emitted header.
std::vector<std::string> sentences(const model::Mechanism& mechanism, const LoopPlan& plan);

/// What brings a step's end back to the closed loops: "2 Newton iterations".
std::string closing_text(const LoopPlan& plan);

/// What the assembly moved, for a person; empty where nothing moved. `where`: "at these parameters ".
std::string assembly_text(const std::vector<Moved>& moved, const std::string& where = "");

}  // namespace jourdain::loops
