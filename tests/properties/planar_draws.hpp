// Planar linkages drawn at random where they stand, for PlacedScene: points of the xy plane, every joint axis along z.
#pragma once

#include "properties/placed_scene.hpp"

namespace jourdain::tests {

/// Whether a linkage starts near a dead position: two bars in line, to within 1e-6 … 1e-3 rad.
enum class Start { kAnywhere, kDead };

/// Links of a loop as bodies (none: the ground), each with the points where it meets the others.
struct PlacedLink {
  OptionalBody body;
  Point3 from, to;
};

/// A four-bar: ground, crank, coupler, rocker. Grashof: some bar turns round. Lengths 0.2 to 1.2 m, at least 5
/// mm from a change point.
std::vector<PlacedLink> draw_four_bar(PlacedScene& scene, bool grashof, Start start, Random& random);

/// Ground, crank, rod; a slide on the ground, whose line passes the crank's pivot at a distance, holds the rod's end.
std::vector<PlacedLink> draw_slider_crank(PlacedScene& scene, Start start, Random& random);

/// Ground and four bars.
std::vector<PlacedLink> draw_five_bar(PlacedScene& scene, Start start, Random& random);

/// Two bars, joined by a pin, from a point of one link to a point of the other; adds a loop and no freedom.
void add_dyad(PlacedScene& scene, const PlacedLink& from, const PlacedLink& to, Start start, Random& random);

/// A bar from a point of `from` to a slide on the ground.
void add_slide(PlacedScene& scene, const PlacedLink& from, Random& random);

}  // namespace jourdain::tests
