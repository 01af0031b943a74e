#include "properties/planar_draws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace jourdain::tests {

namespace {

using std::numbers::pi;

constexpr double kChangePoint = 5e-3;  // m; four-bars whose lengths are nearer to one are left out
constexpr double kShortest = 0.2, kLongest = 1.2;  // m; of bars

Point3 bar(double length, double angle) { return {length * std::cos(angle), length * std::sin(angle), 0}; }
double draw_length(Random& random) { return random.uniform(kShortest, kLongest); }

/// How far from being in line, rad.
double draw_deviation(Random& random) { return std::pow(10.0, random.uniform(-6, -3)); }

/// A point at these distances from two others, on the side that `side` says.
std::optional<Point3> meet(const Point3& P, double r, const Point3& Q, double s, double side) {
  const Point3 way = Q - P;
  const double d = way.norm();
  if (d < 1e-6 || d > r + s || d < std::fabs(r - s)) return {};
  const double along = (d * d + r * r - s * s) / (2 * d);
  const double aside = std::sqrt(std::max(0.0, r * r - along * along));
  const Point3 u = way / d, v(-u.y(), u.x(), 0);
  return P + along * u + side * aside * v;
}

/// Distance of the ends of two bars that are in line, stretched or folded, but for `deviation`.
double nearly_in_line(double r, double s, double deviation, Random& random) {
  const double cosine = random.sign() * std::cos(deviation);
  return std::sqrt(r * r + s * s + 2 * r * s * cosine);
}

struct FourBarPoints {
  Point3 A, B, C, D;
};

/// Pins of a four-bar with sides a, b, c, d, if they can be joined.
std::optional<FourBarPoints> draw_points(const std::array<double, 4>& sides, Start start, Random& random) {
  const auto& [a, b, c, d] = sides;
  FourBarPoints p{Point3::Zero(), {}, {}, bar(d, random.uniform(-pi, pi))};
  const double side = random.sign(), other = random.sign();
  if (start == Start::kAnywhere) {
    p.B = bar(a, random.uniform(-pi, pi));
  } else if (random.chance(0.5)) {  // coupler and rocker
    const auto B = meet(p.A, a, p.D, nearly_in_line(b, c, draw_deviation(random), random), other);
    if (!B) return {};
    p.B = *B;
  } else {  // crank and coupler
    const auto C = meet(p.A, nearly_in_line(a, b, draw_deviation(random), random), p.D, c, other);
    const auto B = C ? meet(p.A, a, *C, b, side) : C;
    if (!B) return {};
    p.B = *B, p.C = *C;
    return p;
  }
  const auto C = meet(p.B, b, p.D, c, side);
  if (!C) return {};
  p.C = *C;
  return p;
}

/// A point of the link, beside its bar or on its end.
Point3 point_of(const PlacedLink& link, Random& random) {
  const Point3 way = link.to - link.from, across(-way.y(), way.x(), 0);
  return link.from + random.uniform(0.3, 1.2) * way + random.uniform(-0.5, 0.5) * across;
}

}  // namespace

std::vector<PlacedLink> draw_four_bar(PlacedScene& scene, bool grashof, Start start, Random& random) {
  std::optional<FourBarPoints> points;
  while (!points) {
    std::array<double, 4> sides;
    for (double& side : sides) side = draw_length(random);
    std::array<double, 4> sorted = sides;
    std::sort(sorted.begin(), sorted.end());
    const double gap = sorted[1] + sorted[2] - sorted[0] - sorted[3];
    if (std::fabs(gap) < kChangePoint || (gap > 0) != grashof) continue;
    if (sorted[3] > sorted[0] + sorted[1] + sorted[2] - kChangePoint) continue;
    points = draw_points(sides, start, random);
  }
  const auto& [A, B, C, D] = *points;
  const std::size_t crank = scene.add_body(), coupler = scene.add_body(), rocker = scene.add_body();
  scene.add_revolute({}, crank, A);
  scene.add_revolute(crank, coupler, B);
  scene.add_revolute(coupler, rocker, C);
  scene.add_revolute({}, rocker, D);
  return {{{}, A, D}, {crank, A, B}, {coupler, B, C}, {rocker, D, C}};
}

std::vector<PlacedLink> draw_slider_crank(PlacedScene& scene, Start start, Random& random) {
  // The slide's line is y = e in a frame that is turned at the end.
  std::optional<Point3> B, C;
  while (!B || !C) {
    const double a = draw_length(random), b = draw_length(random), e = random.uniform(-0.6, 0.6);
    if (std::fabs(std::fabs(b - a) - std::fabs(e)) < kChangePoint) continue;
    const double side = random.sign();
    B = C = std::nullopt;
    if (start == Start::kAnywhere || random.chance(0.5)) {
      double angle = random.uniform(-pi, pi);
      if (start == Start::kDead) {  // the rod across the slide
        const double sine = (e + random.sign() * b * std::cos(draw_deviation(random))) / a;
        if (std::fabs(sine) > 1) continue;
        angle = random.chance(0.5) ? std::asin(sine) : pi - std::asin(sine);
      }
      B = bar(a, angle);
      const double height = e - B->y();
      if (std::fabs(height) <= b) C = Point3(B->x() + side * std::sqrt(b * b - height * height), e, 0);
    } else {  // crank and rod in line
      const double reach = nearly_in_line(a, b, draw_deviation(random), random);
      if (reach < std::fabs(e)) continue;
      C = Point3(side * std::sqrt(reach * reach - e * e), e, 0);
      B = meet(Point3::Zero(), a, *C, b, random.sign());
    }
  }
  const Eigen::Matrix3d R = Eigen::AngleAxisd(random.uniform(-pi, pi), Point3::UnitZ()).toRotationMatrix();
  const Point3 crank_pin = R * *B, end = R * *C;
  const std::size_t crank = scene.add_body(), rod = scene.add_body(), slide = scene.add_body();
  scene.add_revolute({}, crank, Point3::Zero());
  scene.add_revolute(crank, rod, crank_pin);
  scene.add_revolute(rod, slide, end);
  scene.add({.type = model::JointType::kPrismatic, .a = {}, .b = slide, .point = end, .axis = R.col(0)});
  return {{{}, Point3::Zero(), end}, {crank, Point3::Zero(), crank_pin}, {rod, crank_pin, end}};
}

std::vector<PlacedLink> draw_five_bar(PlacedScene& scene, Start start, Random& random) {
  std::array<Point3, 5> P;  // ground pivots first and last
  const auto too_close = [&] {
    for (std::size_t i = 0; i < 5; ++i)
      if ((P[i] - P[(i + 1) % 5]).norm() < kShortest) return true;
    return false;
  };
  do {
    for (Point3& p : P) p = {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), 0};
    if (start == Start::kDead) {  // the two bars in the middle
      const Point3 way = P[3] - P[1], across(-way.y(), way.x(), 0);
      P[2] = P[1] + random.uniform(0.3, 1.8) * way + draw_deviation(random) * across;
    }
  } while (too_close());
  std::vector<PlacedLink> links = {{{}, P[0], P[4]}};
  for (std::size_t i = 0; i < 4; ++i) links.push_back({scene.add_body(), P[i], P[i + 1]});
  for (std::size_t i = 0; i < 5; ++i) scene.add_revolute(links[i].body, links[(i + 1) % 5].body, P[i]);
  return links;
}

void add_dyad(PlacedScene& scene, const PlacedLink& from, const PlacedLink& to, Start start, Random& random) {
  Point3 P, Q, X;
  do {
    P = point_of(from, random), Q = point_of(to, random);
    const Point3 way = Q - P, across(-way.y(), way.x(), 0);
    const bool dead = start == Start::kDead;
    X = P + random.uniform(0.2, dead ? 1.8 : 0.8) * way +
        (dead ? draw_deviation(random) : random.sign() * random.uniform(0.2, 1.5)) * across;
  } while ((X - P).norm() < kShortest || (X - Q).norm() < kShortest);
  const std::size_t first = scene.add_body(), second = scene.add_body();
  scene.add_revolute(from.body, first, P);
  scene.add_revolute(first, second, X);
  scene.add_revolute(second, to.body, Q);
}

void add_slide(PlacedScene& scene, const PlacedLink& from, Random& random) {
  const Point3 P = point_of(from, random), way = bar(1, random.uniform(-pi, pi)),
               X = P + bar(draw_length(random), random.uniform(-pi, pi));
  const std::size_t rod = scene.add_body(), slide = scene.add_body();
  scene.add_revolute(from.body, rod, P);
  scene.add_revolute(rod, slide, X);
  scene.add({.type = model::JointType::kPrismatic, .a = {}, .b = slide, .point = X, .axis = way});
}

}  // namespace jourdain::tests
