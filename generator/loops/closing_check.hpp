// What closes the loops, checked at states where there is something to close.
#pragma once

#include "ir/module.hpp"
#include "loops/derivative_check.hpp"

namespace jourdain::loops {

/// Worst error of every output of `program` ("close_loops" or "project") at the ray's configuration, its dependent positions (with
/// multipliers all positions, and the velocities) moved off by about 1e-3: against the same steps by dense algebra in long double.
/// Relative to sizes times the condition number of what is solved.
double closing_error(const model::Mechanism& mechanism, const NumericClosure& closure, const LoopPlan& plan,
                     const ir::Module& module, const std::vector<double>& parameters, const Ray& ray,
                     const ir::Program& program);

}  // namespace jourdain::loops
