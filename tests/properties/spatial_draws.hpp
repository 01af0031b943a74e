// Spatial linkages drawn at random where they stand, for PlacedScene.
#pragma once

#include "properties/placed_scene.hpp"

namespace jourdain::tests {

/// Two cranks on the ground, a coupler with a ball at each end (a body, or at times a massless rod).
void draw_rssr(PlacedScene& scene, Random& random);

/// A crank and a slide on the ground, a coupler as of draw_rssr.
void draw_rssp(PlacedScene& scene, Random& random);

/// Four bars, opposite ones equal, whose axes are across the two bars that they join: moves with three redundant rows.
void draw_bennett(PlacedScene& scene, Random& random);

/// A platform on two chains of three parallel hinges each, across each other: goes straight up, with redundant rows.
void draw_sarrus(PlacedScene& scene, Random& random);

/// A platform on six legs with a sprung slide each; legs are universal joints below and balls above. The
/// platform is free or hangs on a leg.
void draw_stewart(PlacedScene& scene, Random& random);

/// A platform on three arms, by bars with universal joints or by two rods each.
void draw_delta(PlacedScene& scene, Random& random);

}  // namespace jourdain::tests
