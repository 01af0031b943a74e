// Slopes of curves through points.
#include <cmath>

#include "model/lookup_table.hpp"

namespace jourdain::model {

namespace {

using Points = std::span<const double>;

/// Intervals and the slopes of the chords over them.
struct Chords {
  std::vector<double> widths, slopes;
};

Chords chords_of(Points points, Points values) {
  Chords chords;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    chords.widths.push_back(points[i + 1] - points[i]);
    chords.slopes.push_back((values[i + 1] - values[i]) / chords.widths[i]);
  }
  return chords;
}

bool have_one_sign(double a, double b) { return (a > 0 && b > 0) || (a < 0 && b < 0); }

/// Of the parabola through three points, at the first, but without overshoot.
double end_slope(double width, double next_width, double slope, double next_slope) {
  const double parabola = ((2 * width + next_width) * slope - width * next_slope) / (width + next_width);
  if (!have_one_sign(parabola, slope)) return 0;
  const bool turns = !have_one_sign(slope, next_slope);
  return turns && std::fabs(parabola) > 3 * std::fabs(slope) ? 3 * slope : parabola;
}

std::vector<double> monotone_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  const std::size_t last = h.size();
  std::vector<double> slopes(last + 1);
  for (std::size_t i = 1; i < last; ++i) {
    if (!have_one_sign(s[i - 1], s[i])) continue;
    const double before = h[i - 1] + 2 * h[i], after = 2 * h[i - 1] + h[i];
    slopes[i] = (before + after) / (before / s[i - 1] + after / s[i]);
  }
  slopes[0] = end_slope(h[0], h[1], s[0], s[1]);
  slopes[last] = end_slope(h[last - 1], h[last - 2], s[last - 1], s[last - 2]);
  return slopes;
}

/// Of the tridiagonal system by elimination; each row's diagonal is the sum of its neighbours at least.
std::vector<double> spline_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  const std::size_t last = h.size();
  std::vector<double> diagonal(last + 1), right(last + 1), upper(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const bool first = i == 0, end = i == last;
    const double lower = first ? 0 : end ? 1 : h[i];
    upper[i] = first ? 1 : end ? 0 : h[i - 1];
    diagonal[i] = 2 * (lower + upper[i]);
    right[i] = first ? 3 * s[0] : end ? 3 * s[last - 1] : 3 * (h[i] * s[i - 1] + h[i - 1] * s[i]);
    if (first) continue;
    const double factor = lower / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  std::vector<double> slopes(last + 1);
  for (std::size_t i = last + 1; i-- > 0;)
    slopes[i] = (right[i] - (i == last ? 0 : upper[i] * slopes[i + 1])) / diagonal[i];
  return slopes;
}

}  // namespace

std::vector<double> slopes(Interpolation kind, Points points, Points values) {
  const Chords chords = chords_of(points, values);
  if (points.size() == 2) return {chords.slopes[0], chords.slopes[0]};
  JD_CHECK(kind != Interpolation::kLinear, "straight lines have two slopes at a point");
  return kind == Interpolation::kMonotone ? monotone_slopes(chords) : spline_slopes(chords);
}

}  // namespace jourdain::model
