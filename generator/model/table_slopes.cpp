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

/// Between two intervals.
double monotone_slope(double width, double next_width, double slope, double next_slope) {
  if (!have_one_sign(slope, next_slope)) return 0;
  const double before = width + 2 * next_width, after = 2 * width + next_width;
  return (before + after) / (before / slope + after / next_slope);
}

std::vector<double> monotone_slopes(const Chords& chords, bool repeats) {
  const auto& [h, s] = chords;
  const std::size_t last = h.size();
  std::vector<double> slopes(last + 1);
  for (std::size_t i = 1; i < last; ++i) slopes[i] = monotone_slope(h[i - 1], h[i], s[i - 1], s[i]);
  const double seam = monotone_slope(h[last - 1], h[0], s[last - 1], s[0]);
  slopes[0] = repeats ? seam : end_slope(h[0], h[1], s[0], s[1]);
  slopes[last] = repeats ? seam : end_slope(h[last - 1], h[last - 2], s[last - 1], s[last - 2]);
  return slopes;
}

/// lower m before + diagonal m + upper m after = right
struct Row {
  double lower = 0, diagonal = 0, upper = 0, right = 0;
};

/// Of the tridiagonal system by elimination; each row's diagonal is the sum of its neighbours at least.
std::vector<double> solved(std::vector<Row> rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double factor = rows[i].lower / rows[i - 1].diagonal;
    rows[i].diagonal -= factor * rows[i - 1].upper;
    rows[i].right -= factor * rows[i - 1].right;
  }
  std::vector<double> values(rows.size());
  for (std::size_t i = rows.size(); i-- > 0;)
    values[i] =
        (rows[i].right - (i + 1 == rows.size() ? 0 : rows[i].upper * values[i + 1])) / rows[i].diagonal;
  return values;
}

/// One curvature on both sides of the point between two intervals.
Row smooth_row(double width, double next_width, double slope, double next_slope) {
  return {next_width, 2 * (next_width + width), width, 3 * (next_width * slope + width * next_slope)};
}

std::vector<double> natural_spline_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  std::vector<Row> rows = {{0, 2, 1, 3 * s.front()}};
  for (std::size_t i = 1; i < h.size(); ++i) rows.push_back(smooth_row(h[i - 1], h[i], s[i - 1], s[i]));
  rows.push_back({1, 2, 0, 3 * s.back()});
  return solved(std::move(rows));
}

/// Those at the points inside are linear in the one at the seam, which the row there tells.
std::vector<double> periodic_spline_slopes(const Chords& chords) {
  const auto& [h, s] = chords;
  std::vector<Row> with_none, by_seam;
  for (std::size_t i = 1; i < h.size(); ++i) {
    with_none.push_back(smooth_row(h[i - 1], h[i], s[i - 1], s[i]));
    by_seam.push_back(with_none.back());
    by_seam.back().right = 0;
  }
  by_seam.front().right -= by_seam.front().lower;
  by_seam.back().right -= by_seam.back().upper;
  const std::vector<double> base = solved(std::move(with_none)), share = solved(std::move(by_seam));
  const Row row = smooth_row(h.back(), h.front(), s.back(), s.front());
  const double seam = (row.right - row.lower * base.back() - row.upper * base.front()) /
                      (row.diagonal + row.lower * share.back() + row.upper * share.front());
  std::vector<double> slopes = {seam};
  for (std::size_t i = 0; i < base.size(); ++i) slopes.push_back(base[i] + seam * share[i]);
  slopes.push_back(seam);
  return slopes;
}

}  // namespace

std::vector<double> slopes(Interpolation kind, Points points, Points values, bool repeats) {
  const Chords chords = chords_of(points, values);
  if (points.size() == 2) return {chords.slopes[0], chords.slopes[0]};
  JD_CHECK(kind != Interpolation::kLinear, "straight lines have two slopes at a point");
  if (kind == Interpolation::kMonotone) return monotone_slopes(chords, repeats);
  return repeats ? periodic_spline_slopes(chords) : natural_spline_slopes(chords);
}

}  // namespace jourdain::model
