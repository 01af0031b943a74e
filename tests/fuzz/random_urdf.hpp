// Valid URDF files drawn at random, and such files with their elements and attributes changed.
#pragma once

#include <string>

#include "properties/random.hpp"

namespace jourdain::tests {

/// A robot of 1 to 5 moving links with mass and inertia on revolute, continuous and prismatic joints, at times a fixed
/// one; with what files of other programs carry beside: visuals, limits, transmissions. It must be accepted, with its
/// root fixed or free.
std::string random_urdf(Random& random);

/// The file with elements and attributes deleted, doubled, renamed, moved and filled with what no one expects; `times`
/// changes.
std::string mutated_urdf(const std::string& text, int times, Random& random);

}  // namespace jourdain::tests
