// The parts of `check_mechanism`; readers run those whose input they could read.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Numbers that a joint or body needs for itself: masses not negative, axes of moving joints not zero, all
/// finite at the parameters' default values.
void check_numbers(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// The joints make a tree: every body is the child of one joint, no loops, at least one degree of freedom.
/// False if they do not; the rest of the mechanism cannot be judged then.
bool check_graph(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Each loop joint constrains something: a coordinate that is not prescribed moves its ends against each other, or moves what its
/// residual depends on. No reaction or drive is asked for beside a residual. The joints must have passed `check_graph`.
void check_loops(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Inertia about the centre of mass positive semidefinite for each body, triangle inequality of the principal
/// moments after merging bodies joined by fixed joints, both at the parameters' default values. Lumped bodies
/// need no more than moments of inertia about their origin that are not negative; nothing is merged with
/// them. The joints must have passed `check_graph`. Where `triangle` is a warning, so is an indefinite inertia; the bodies that have
/// one are returned.
std::vector<std::string> check_inertias(const Mechanism& mechanism, support::Diagnostics& diagnostics,
                                        support::Severity triangle);

/// The parameters' default values, in order.
std::vector<double> default_values(const Mechanism& mechanism);

}  // namespace jourdain::model
