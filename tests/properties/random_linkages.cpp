#include "properties/random_linkages.hpp"

#include <fmt/format.h>

#include <cmath>

#include "properties/consistent_state.hpp"
#include "properties/placed_scene.hpp"
#include "properties/planar_draws.hpp"
#include "properties/spatial_draws.hpp"

namespace jourdain::tests {

namespace {

constexpr double kFastest = 2;  // norm of the rates at the start, rad/s and m/s

/// Where a linkage is near a dead position, its loop or its dyad is: near two of them at once it is near a
/// singular position.
struct Starts {
  Start loop, dyad;
  Starts(Start start, Random& random) : loop(start), dyad(start) {
    (random.chance(0.5) ? loop : dyad) = Start::kAnywhere;
  }
};

void draw_two_loops(PlacedScene& scene, Start start, Random& random) {
  const Starts starts(start, random);
  switch (random.below(3)) {
    case 0: {
      const auto links = draw_five_bar(scene, starts.loop, random);
      return add_dyad(scene, links[1], links[3], starts.dyad, random);
    }
    case 1: {
      const auto links = draw_slider_crank(scene, starts.loop, random);
      return add_dyad(scene, links[2], links[0], starts.dyad, random);
    }
    default: {
      const auto links = draw_four_bar(scene, random.chance(0.5), start, random);
      return add_slide(scene, links[2], random);
    }
  }
}

void draw_six_bar(PlacedScene& scene, bool watt, Start start, Random& random) {
  const Starts starts(start, random);
  const auto links = draw_four_bar(scene, random.chance(0.5), starts.loop, random);
  const std::size_t first = random.below(4);
  add_dyad(scene, links[first], links[(first + (watt ? 1 : 2)) % 4], starts.dyad, random);
}

void draw_three_loops(PlacedScene& scene, Start start, Random& random) {
  const Starts starts(start, random);
  const auto links = draw_four_bar(scene, random.chance(0.5), starts.loop, random);
  add_dyad(scene, links[1], links[3], starts.dyad, random);
  add_dyad(scene, links[2], links[0], Start::kAnywhere, random);
}

/// Some planar linkage.
void draw_planar(PlacedScene& scene, Start start, Random& random) {
  switch (random.below(4)) {
    case 0:
      return draw_six_bar(scene, random.chance(0.5), start, random);
    case 1:
      draw_slider_crank(scene, start, random);
      return;
    default:
      draw_four_bar(scene, random.chance(0.5), start, random);
  }
}

void draw_free_bodies(PlacedScene& scene, Start start, Random& random) {
  switch (random.below(3)) {
    case 0:
      return draw_rssr(scene, random);
    case 1:
      draw_four_bar(scene, random.chance(0.5), start, random);
      return scene.turn(random_rotation(random));
    default:
      draw_slider_crank(scene, start, random);
  }
}

void draw(PlacedScene& scene, LinkageClass kind, Start start, Random& random) {
  switch (kind) {
    case LinkageClass::kGrashof:
    case LinkageClass::kNonGrashof:
      draw_four_bar(scene, kind == LinkageClass::kGrashof, start, random);
      return;
    case LinkageClass::kSliderCrank:
      draw_slider_crank(scene, start, random);
      return;
    case LinkageClass::kFiveBar:
      draw_five_bar(scene, start, random);
      return;
    case LinkageClass::kWatt:
    case LinkageClass::kStephenson:
      return draw_six_bar(scene, kind == LinkageClass::kWatt, start, random);
    case LinkageClass::kTwoLoops:
      return draw_two_loops(scene, start, random);
    case LinkageClass::kThreeLoops:
      return draw_three_loops(scene, start, random);
    case LinkageClass::kRssr:
      return draw_rssr(scene, random);
    case LinkageClass::kRssp:
      return draw_rssp(scene, random);
    case LinkageClass::kBennett:
      return draw_bennett(scene, random);
    case LinkageClass::kSarrus:
      return draw_sarrus(scene, random);
    case LinkageClass::kStewart:
      return draw_stewart(scene, random);
    case LinkageClass::kDelta:
      return draw_delta(scene, random);
    case LinkageClass::kFreeBodies:
      return draw_free_bodies(scene, start, random);
    case LinkageClass::kSpatialClosing:
      return draw_planar(scene, start, random);
  }
}

SceneOptions options_of(LinkageClass kind, std::uint64_t seed, Random& random) {
  SceneOptions options;
  options.tunable = seed % 2 == 1;
  options.absolute = kind == LinkageClass::kFreeBodies;
  const bool in_plane = kind <= LinkageClass::kThreeLoops;
  options.planar = in_plane || (kind == LinkageClass::kSpatialClosing && random.chance(0.5));
  options.spatial_closing = !in_plane;
  return options;
}

/// Rates that the loops allow.
void start_moving(model::Mechanism& mechanism, Random& random) {
  const reference::DescriptorReference<long double> form(mechanism);
  const LoopState start = reference::Reference<long double>(mechanism).initial_state();
  const auto motions = loop_freedom(form.loop_constraints(0, start.y, start.z)).motions;
  if (motions.cols() == 0) return;
  reference::VectorX<long double> z = reference::VectorX<long double>::Zero(motions.rows());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) z += random.uniform(-1, 1) * motions.col(k);
  z *= random.uniform(0, kFastest) / z.norm();
  const auto rate = [&](std::size_t entry) { return static_cast<double>(z[Eigen::Index(entry)]); };
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    model::Joint& joint = mechanism.joints[j];
    const model::JointEntries& entries = form.layout().joints[j];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c)
      joint.coordinates[c].initial_velocity = rate(*entries.velocity[c]);
    const bool is_free = joint.type == model::JointType::kFree;
    if (!is_free && joint.type != model::JointType::kSpherical) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_free) joint.initial_origin_velocity[i] = rate(entries.first_velocity + i);
      joint.initial_spin[i] = rate(entries.first_velocity + (is_free ? 3 : 0) + i);
    }
  }
}

void perturb(RandomLinkage& linkage, std::uint64_t seed, Random& random) {
  static constexpr int kDecimals[] = {4, 6, 9, 12};
  const std::uint64_t which = seed % 10;
  if (which < 4) {
    linkage.perturbation = std::pow(10.0, -kDecimals[which]);
    linkage.mechanism = rounded(linkage.ideal, kDecimals[which]);
  } else if (which < 6) {
    linkage.perturbation = std::pow(10.0, random.uniform(-16, -4));
    linkage.mechanism = tilted(linkage.ideal, linkage.perturbation, random);
  }
}

/// Reaches of all bodies and lengths of rods.
double size_of(const model::Mechanism& mechanism) {
  const std::vector<double> parameters = model::default_values(mechanism);
  double size = 0;
  for (const model::Frame& frame : mechanism.frames)
    size += reference::vector_value<double>(frame.placement.position, parameters).norm();
  for (const model::Joint& joint : mechanism.joints)
    size += reference::vector_value<double>(joint.placement.position, parameters).norm();
  return size;
}

/// In the plane of a planar linkage; platforms hang or stand, as they would otherwise soon swing through
/// singular positions, where there is no reference.
Point3 direction_of_gravity(LinkageClass kind, bool planar, Random& random) {
  const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
  if (planar) return Point3(x, -1, 0).normalized();
  if (kind == LinkageClass::kStewart || kind == LinkageClass::kDelta)
    return Point3(0.2 * x, 0.2 * y, -1).normalized();
  return random_rotation(random).col(0);
}

}  // namespace

const std::vector<LinkageKind>& linkage_kinds() {
  static const std::vector<LinkageKind> kKinds = {
      {LinkageClass::kGrashof, "Grashof four-bar", 120, true},
      {LinkageClass::kNonGrashof, "non-Grashof four-bar", 160, true},
      {LinkageClass::kSliderCrank, "slider-crank", 120, true},
      {LinkageClass::kFiveBar, "five-bar", 60, true},
      {LinkageClass::kWatt, "six-bar, Watt", 60, true},
      {LinkageClass::kStephenson, "six-bar, Stephenson", 60, true},
      {LinkageClass::kTwoLoops, "two planar loops", 60, true},
      {LinkageClass::kThreeLoops, "three planar loops", 60, true},
      {LinkageClass::kRssr, "RSSR", 60},
      {LinkageClass::kRssp, "RSSP", 60},
      {LinkageClass::kBennett, "Bennett", 60, false, true},
      {LinkageClass::kSarrus, "Sarrus", 60, false, true},
      {LinkageClass::kStewart, "Stewart platform", 40},
      {LinkageClass::kDelta, "delta robot", 40},
      {LinkageClass::kFreeBodies, "free bodies", 60, true, true},
      {LinkageClass::kSpatialClosing, "planar, closed in space", 80, true, true},
  };
  return kKinds;
}

RandomLinkage random_linkage(const LinkageKind& kind, std::uint64_t seed) {
  Random random(seed * 64 + static_cast<std::uint64_t>(kind.kind) + 1);
  PlacedScene scene(random);
  const bool dead = kind.has_dead && seed / 2 % 4 == 0;
  draw(scene, kind.kind, dead ? Start::kDead : Start::kAnywhere, random);
  SceneOptions options = options_of(kind.kind, seed, random);
  if (!options.planar && kind.kind == LinkageClass::kSpatialClosing) scene.turn(random_rotation(random));
  RandomLinkage linkage;
  linkage.ideal = scene.mechanism(options);
  linkage.ideal.name = fmt::format("linkage_{}_{}", static_cast<int>(kind.kind), seed);
  const Point3 down = direction_of_gravity(kind.kind, options.planar, random);
  for (Eigen::Index i = 0; i < 3; ++i) linkage.ideal.gravity[std::size_t(i)] = 9.81 * down[i];
  if (seed / 8 % 2 == 1) start_moving(linkage.ideal, random);
  linkage.size = size_of(linkage.ideal);
  linkage.mechanism = linkage.ideal;
  if (kind.overconstrained) perturb(linkage, seed, random);
  return linkage;
}

}  // namespace jourdain::tests
