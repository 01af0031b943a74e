// Whether a description is a mechanism: all checks, and their parts for readers that could not read all of it.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// What a reader cannot see line by line: two parents, cycles, bodies without a joint, negative mass, inertia that is
/// indefinite or violates the triangle inequality (after merging bodies joined by fixed joints), zero axes, more
/// than one root. `triangle` is the severity of a triangle violation (URDF: warning).
void check_mechanism(const Mechanism& mechanism, support::Diagnostics& diagnostics,
                     support::Severity triangle);

/// Numbers that a joint or body needs for itself: masses not negative, axes of moving joints not zero, all
/// finite at the parameters' default values.
void check_numbers(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// The joints make a tree: every body is the child of one joint, no loops, at least one degree of freedom.
/// False if they do not; the rest of the mechanism cannot be judged then.
bool check_graph(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Each loop joint constrains something: a coordinate that is not prescribed moves its ends against each
/// other, or moves what its residual depends on. No reaction or drive is asked for beside a residual. The
/// joints must have passed `check_graph`.
void check_loops(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Motions that follow states have a velocity and an acceleration that are known and finite at the start; multipliers
/// hold loops then. Beside loops there are no external functions in motions or curves.
void check_motions(const Mechanism& mechanism, support::Diagnostics& diagnostics);

/// Inertia about the centre of mass positive semidefinite for each body, triangle inequality of the principal
/// moments after merging bodies joined by fixed joints, both at the parameters' default values. Lumped bodies
/// need no more than moments of inertia about their origin that are not negative; nothing is merged with
/// them. The joints must have passed `check_graph`. Where `triangle` is a warning, so is an indefinite
/// inertia; the bodies that have one are returned. For bodies that are lenient it is one always.
std::vector<std::string> check_inertias(const Mechanism& mechanism, support::Diagnostics& diagnostics,
                                        support::Severity triangle);

}  // namespace jourdain::model
