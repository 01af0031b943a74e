#include "properties/spatial_draws.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace jourdain::tests {

namespace {

using model::JointType;
using std::numbers::pi;

constexpr double kRodChance = 0.3;

Point3 draw_point(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

Point3 draw_direction(Random& random) {
  Point3 p;
  do p = draw_point(random, 1);
  while (p.norm() < 0.3);
  return p.normalized();
}

Point3 around_z(double radius, double angle, double height) {
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

void add_coupler(PlacedScene& scene, std::size_t a, const Point3& from, std::size_t b, const Point3& to,
                 Random& random) {
  if (random.chance(kRodChance)) return scene.add(PlacedRod{a, b, from, to});
  const std::size_t coupler = scene.add_body();
  scene.add({.type = JointType::kSpherical, .a = a, .b = coupler, .point = from});
  scene.add({.type = JointType::kSpherical, .a = coupler, .b = b, .point = to});
}

/// A crank on the ground; where its pin is.
Point3 add_crank(PlacedScene& scene, std::size_t crank, const Point3& pivot, Random& random) {
  const Point3 axis = draw_direction(random), pin = pivot + random.uniform(0.2, 0.6) * axis.unitOrthogonal();
  scene.add_revolute({}, crank, pivot, axis);
  return pin;
}

}  // namespace

void draw_rssr(PlacedScene& scene, Random& random) {
  const std::size_t crank = scene.add_body(), rocker = scene.add_body();
  const Point3 from = add_crank(scene, crank, Point3::Zero(), random),
               to = add_crank(scene, rocker, random.uniform(0.6, 1.2) * draw_direction(random), random);
  add_coupler(scene, crank, from, rocker, to, random);
}

void draw_rssp(PlacedScene& scene, Random& random) {
  const std::size_t crank = scene.add_body(), slide = scene.add_body();
  const Point3 from = add_crank(scene, crank, Point3::Zero(), random),
               to = random.uniform(0.7, 1.2) * draw_direction(random);
  scene.add(
      {.type = JointType::kPrismatic, .a = {}, .b = slide, .point = to, .axis = draw_direction(random)});
  add_coupler(scene, crank, from, slide, to, random);
}

/// A skew quadrangle with equal opposite sides: it turns into itself by half a turn about z.
void draw_bennett(PlacedScene& scene, Random& random) {
  const double p = random.uniform(0.2, 0.6), q = random.uniform(0.2, 0.6), h = random.uniform(0.1, 0.3),
               angle = random.uniform(0.6, pi - 0.6);
  const std::array<Point3, 4> P = {around_z(p, 0, h), around_z(q, angle, -h), around_z(p, pi, h),
                                   around_z(q, angle + pi, -h)};
  std::array<OptionalBody, 4> bodies;
  for (std::size_t i = 1; i < 4; ++i) bodies[i] = scene.add_body();
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3 before = P[i] - P[(i + 3) % 4], after = P[(i + 1) % 4] - P[i];
    scene.add_revolute(bodies[i], bodies[(i + 1) % 4], P[i], before.cross(after).normalized());
  }
  scene.turn(random_rotation(random));
}

void draw_sarrus(PlacedScene& scene, Random& random) {
  const std::size_t platform = scene.add_body();
  const double height = random.uniform(0.4, 0.9), angle = random.uniform(0.6, pi - 0.6);
  double turn = random.uniform(-pi, pi);
  for (int chain = 0; chain < 2; ++chain, turn += angle) {
    const Point3 out = around_z(1, turn, 0), axis(-out.y(), out.x(), 0),
                 foot = random.uniform(0.2, 0.5) * out,
                 knee =
                     foot + random.uniform(0.1, 0.5) * out + Point3(0, 0, random.uniform(0.3, 0.7) * height),
                 top = random.uniform(0.2, 0.5) * out + Point3(0, 0, height);
    const std::size_t lower = scene.add_body(), upper = scene.add_body();
    scene.add_revolute({}, lower, foot, axis);
    scene.add_revolute(lower, upper, knee, axis);
    scene.add_revolute(upper, platform, top, axis);
  }
}

void draw_stewart(PlacedScene& scene, Random& random) {
  const std::size_t platform = random.chance(0.5) ? scene.add_free_body() : scene.add_body();
  const double height = random.uniform(0.5, 0.9), wide = random.uniform(0.5, 0.8),
               narrow = random.uniform(0.25, 0.45);
  for (int leg = 0; leg < 6; ++leg) {
    const double pair = 2 * pi / 3 * (leg / 2), side = leg % 2 == 0 ? 1.0 : -1.0;
    const Point3 foot = around_z(wide, pair + side * random.uniform(0.15, 0.3), 0),
                 top = around_z(narrow, pair + side * random.uniform(0.7, 0.9), height),
                 way = (top - foot).normalized(), first = way.unitOrthogonal();
    const std::size_t lower = scene.add_body(), upper = scene.add_body();
    scene.add({.type = JointType::kUniversal,
               .a = {},
               .b = lower,
               .point = foot,
               .axis = first,
               .second_axis = way.cross(first)});
    scene.add({.type = JointType::kPrismatic,
               .a = lower,
               .b = upper,
               .point = foot + 0.5 * (top - foot),
               .axis = way,
               .stiffness = random.uniform(300, 900)});
    scene.add({.type = JointType::kSpherical, .a = upper, .b = platform, .point = top});
  }
}

void draw_delta(PlacedScene& scene, Random& random) {
  const bool rods = random.chance(0.5);
  const std::size_t platform = rods ? scene.add_free_body() : scene.add_body();
  const double base = random.uniform(0.15, 0.3), arm = random.uniform(0.2, 0.4),
               top = random.uniform(0.05, 0.1), depth = random.uniform(0.4, 0.7);
  const Point3 aside(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0);
  for (int i = 0; i < 3; ++i) {
    const double turn = 2 * pi / 3 * i, lift = random.uniform(-0.5, 0.5);
    const Point3 out = around_z(1, turn, 0), axis(-out.y(), out.x(), 0), shoulder = base * out,
                 elbow = shoulder + arm * (std::cos(lift) * out - Point3(0, 0, std::sin(lift))),
                 wrist = aside + top * out - Point3(0, 0, depth);
    const std::size_t upper = scene.add_body();
    scene.add_revolute({}, upper, shoulder, axis);
    if (rods) {
      for (const double side : {-0.04, 0.04})
        scene.add(PlacedRod{upper, platform, elbow + side * axis, wrist + side * axis});
      continue;
    }
    const std::size_t lower = scene.add_body();
    const Point3 across = axis.cross(wrist - elbow).normalized();
    scene.add({.type = JointType::kUniversal,
               .a = upper,
               .b = lower,
               .point = elbow,
               .axis = axis,
               .second_axis = across});
    scene.add({.type = JointType::kUniversal,
               .a = lower,
               .b = platform,
               .point = wrist,
               .axis = across,
               .second_axis = axis});
  }
}

}  // namespace jourdain::tests
