#include "loops/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jourdain::tests {

using loops::Scalar;
using loops::Vector2;

namespace {

constexpr double kPi = std::numbers::pi;

double angle_of(Point p) { return std::atan2(p.y, p.x); }
Point bar(double length, double angle) { return {length * std::cos(angle), length * std::sin(angle)}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
double length(Point p) { return std::hypot(p.x, p.y); }

/// Rows in the frame of the ground, of the crank or askew.
void close(Rows& rows, Vector2 gap, Scalar crank, Random& random) {
  switch (random.below(3)) {
    case 0:
      return rows.rows(gap);
    case 1:
      return rows.rows(rows.turned(-crank, gap));
    default:
      return rows.rows_askew(gap, random);
  }
}

/// An interval about `start` on which `margin` stays above `least`.
std::array<double, 2> about(double start, double least, const std::function<double(double)>& margin) {
  std::array<double, 2> ends = {start, start};
  const auto reaches = [&](double x) { return margin(x) > least && std::fabs(x - start) < 3; };
  while (reaches(ends[0] - 0.01)) ends[0] -= 0.01;
  while (reaches(ends[1] + 0.01)) ends[1] += 0.01;
  return ends;
}

void finish(Linkage& linkage, Rows& rows, std::vector<bool> angular) {
  linkage.request.g = rows.finish();
  linkage.request.blocks = {{{0, 1}, {1, 2}}};
  linkage.request.range.resize(angular.size());
  linkage.request.angular = std::move(angular);
}

}  // namespace

Linkage random_four_bar(std::uint64_t seed) {
  Random random(seed);
  double a = 0, b = 0, c = 0, gap = 0, crank = 0;
  Point ground;
  // sin² at the coupler's far pin, of the triangle with sides b, c and the distance from the crank's pin to
  // the ground pivot.
  const auto margin = [&](double angle) {
    const double d = length(ground - bar(a, angle)), cosine = (b * b + c * c - d * d) / (2 * b * c);
    return 1 - cosine * cosine;
  };
  do {
    a = random.uniform(0.2, 2), b = random.uniform(0.2, 2), c = random.uniform(0.2, 2);
    ground = bar(random.uniform(0.2, 2), random.uniform(-kPi, kPi));
    std::array<double, 4> sorted = {a, b, c, length(ground)};
    std::sort(sorted.begin(), sorted.end());
    gap = sorted[1] + sorted[2] - sorted[0] - sorted[3];
    crank = random.uniform(-kPi, kPi);
  } while (std::fabs(gap) < 0.05 || margin(crank) < 0.1);
  Linkage linkage;
  const double shortest = std::min({a, b, c, length(ground)});
  linkage.full_turn = gap > 0 && (shortest == a || shortest == length(ground));
  linkage.reachable = about(crank, 0.02, margin);
  const Point rest = ground - bar(a, crank);
  const double d = length(rest),
               coupler = angle_of(rest) + random.sign() * std::acos((d * d + b * b - c * c) / (2 * d * b)),
               rocker = angle_of(rest - bar(b, coupler));
  const double down1 = random.sign(), down2 = random.sign(), pin = random.chance(0.5) ? 0.3 : 0;
  Rows rows;
  const Scalar q0 = rows.y(0), q1 = down1 * rows.y(1), q2 = down2 * rows.y(2) + pin;
  const std::size_t cut = random.below(3);
  const Scalar at1 = cut == 2 ? q1 : q0 + q1, at2 = cut == 0 ? at1 + q2 : q2;
  const Vector2 fixed = rows.point(ground), chain = rows.bar(a, q0) + rows.bar(b, at1);
  close(rows, cut == 0 ? chain + rows.bar(c, at2) - fixed : chain - (fixed + rows.bar(c, at2)), q0, random);
  const double y1 = cut == 2 ? coupler : coupler - crank,
               y2 = (cut == 0 ? rocker - coupler : rocker + kPi) - pin;
  linkage.request.initial_y = {crank, down1 * y1, down2 * y2};
  linkage.scale = a + b + c + length(ground);
  finish(linkage, rows, {true, true, true});
  return linkage;
}

Linkage random_slider_crank(std::uint64_t seed, bool inverted) {
  Random random(seed);
  Linkage linkage;
  Rows rows;
  const double a = random.uniform(0.3, 1), down = random.sign(), way = random.uniform(-kPi, kPi);
  const Scalar q0 = rows.y(0), q1 = down * rows.y(1), s = rows.y(2);
  const double crank = random.uniform(-kPi, kPi);
  const Vector2 along = rows.bar(1, rows.number(way));
  const bool on_crank = random.chance(0.5);
  if (inverted) {
    // a e(q0) + R(θ) (u + s v) = P: the rod's line stays `offset` from P.
    const double offset = random.uniform(-0.8, 0.8),
                 distance = random.chance(0.5) ? 0 : random.uniform(-1, 1);
    double far = random.uniform(0.1, 2);
    if (far + a < 1.2 * std::fabs(offset)) far += 1;
    if (std::fabs(std::fabs(far - a) - std::fabs(offset)) < 0.02) far += 0.1;
    const Point pivot = bar(far, random.uniform(-kPi, kPi));
    const auto margin = [&](double x) {
      const double d = length(pivot - bar(a, x));
      return 1 - offset * offset / (d * d);
    };
    linkage.full_turn = std::fabs(far - a) > std::fabs(offset);
    double start = crank;
    while (margin(start) < 0.1) start = random.uniform(-kPi, kPi);
    linkage.reachable = about(start, 0.02, margin);
    const Point rest = pivot - bar(a, start);
    const double root = random.sign() * std::sqrt(length(rest) * length(rest) - offset * offset);
    const Point local = bar(1, way);  // u + s v = distance v + offset v⊥ + s v
    const Point w = {root * local.x - offset * local.y, root * local.y + offset * local.x};
    const double turn = angle_of(rest) - angle_of(w);
    const Vector2 u =
        rows.point({distance * local.x - offset * local.y, distance * local.y + offset * local.x});
    const Vector2 rod = rows.turned(on_crank ? q0 + q1 : q1, u + s * along);
    close(rows, rows.bar(a, q0) + rod - rows.point(pivot), q0, random);
    linkage.request.initial_y = {start, down * (on_crank ? turn - start : turn), root - distance};
    linkage.scale = a + far + std::fabs(offset) + std::fabs(distance);
  } else {
    // a e(q0) + b e(θ) = s d + offset d⊥.
    const double offset = random.uniform(-0.5, 0.5);
    double b = random.uniform(std::fabs(offset) + 0.1, 3);
    if (std::fabs(b - a - std::fabs(offset)) < 0.02) b += 0.1;
    const auto margin = [&](double x) {
      const double sine = (offset - a * std::sin(x - way)) / b;
      return 1 - sine * sine;
    };
    linkage.full_turn = b > a + std::fabs(offset);
    double start = crank;
    while (margin(start) < 0.1) start = random.uniform(-kPi, kPi);
    linkage.reachable = about(start, 0.02, margin);
    const double lift = std::asin((offset - a * std::sin(start - way)) / b),
                 theta = way + (random.chance(0.5) ? lift : kPi - lift),
                 slide = a * std::cos(start - way) + b * std::cos(theta - way);
    const Vector2 line = s * along + rows.number(offset) * quarter(along);
    // The rod hangs on the crank's pin or on the slide's.
    const Vector2 gap = on_crank ? rows.bar(a, q0) + rows.bar(b, q0 + q1) - line
                                 : line + rows.bar(b, rows.number(way) + q1) - rows.bar(a, q0);
    close(rows, gap, q0, random);
    linkage.request.initial_y = {start, down * (on_crank ? theta - start : theta + kPi - way), slide};
    linkage.scale = a + b + std::fabs(offset);
  }
  finish(linkage, rows, {true, true, false});
  return linkage;
}

}  // namespace jourdain::tests
