// Generalized inertia forces of a tree link by link: outward accelerations, inward the wrenches that they take.
#pragma once

#include <string>
#include <vector>

#include "dynamics/accelerations.hpp"

namespace jourdain::dynamics {

/// The same as derive_generalized_forces, which makes no wrench of a single link, by the recursion of Newton and Euler
/// (J. Y. S. Luh, M. W. Walker, R. P. C. Paul, ASME Journal of Dynamic Systems, Measurement and Control 102, 1980) on
/// links whose inertia is regrouped. With `applied` wrenches on the links. No link is free.
std::vector<std::vector<Ex>> derive_forces_by_links(const Scene& scene,
                                                    const JointAccelerations& accelerations,
                                                    const std::vector<Wrench>& applied,
                                                    const std::string& name);

/// May derive_forces_by_links be asked?
bool has_forces_by_links(const Scene& scene);

}  // namespace jourdain::dynamics
