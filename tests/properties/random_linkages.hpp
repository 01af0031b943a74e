// Seeded random mechanisms with closed loops of the kinds that people build, swinging free: what the
// compiler's own choice of a treatment is judged with. They know nothing of treatments.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::tests {

enum class LinkageClass {
  kGrashof,      ///< four-bars some bar of which turns round
  kNonGrashof,   ///< four-bars whose bars all swing: every coordinate has dead positions
  kSliderCrank,  ///< with offset
  kFiveBar,      ///< two degrees of freedom
  kWatt,         ///< six bars: a four-bar and a dyad between two neighbours
  kStephenson,   ///< six bars: a four-bar and a dyad between opposite links
  kTwoLoops,     ///< planar: slides, five-bars with a dyad
  kThreeLoops,   ///< planar: four-bars with two dyads
  kRssr,         ///< two cranks, a coupler with a ball at each end
  kRssp,         ///< a crank and a slide, the same
  kBennett,      ///< overconstrained
  kSarrus,       ///< overconstrained
  kStewart,      ///< six sprung legs
  kDelta,        ///< three arms
  kFreeBodies,  ///< planar and spatial ones, every joint a loop between free bodies; planar ones have redundant rows
  kSpatialClosing,  ///< planar ones closed by joints in space: redundant rows
};

struct LinkageKind {
  LinkageClass kind;
  std::string_view name;
  std::uint64_t count;    ///< of seeds in the bench: 0 … count − 1
  bool has_dead = false;  ///< a quarter starts near a dead position
  bool overconstrained = false;
};

const std::vector<LinkageKind>& linkage_kinds();

struct RandomLinkage {
  model::Mechanism mechanism;
  /// The same before axes and lengths were rounded or an axis was tilted; equal to `mechanism` where nothing was.
  model::Mechanism ideal;
  double perturbation = 0;  ///< of numbers or of an axis: largest that was made; 0: none
  double size = 1;          ///< m: distances of joints and frames from their bodies' origins, summed
};

/// From rest (half of them) or with rates of up to 2, bodies with mass and inertia, gravity, no damping. Half
/// have tunable lengths. Of the overconstrained ones four in ten are rounded to 4, 6, 9 or 12 decimals, two in
/// ten have an axis tilted by 1e-16 to 1e-4 rad. Loops are closed to rounding at the start, but for those.
RandomLinkage random_linkage(const LinkageKind& kind, std::uint64_t seed);

}  // namespace jourdain::tests
