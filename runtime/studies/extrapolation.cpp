#include "studies/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

using Vector = std::vector<LongReal>;

constexpr int kMaximumColumns = 12;
constexpr int kMostHalvings = 12;
constexpr int kFewColumns = 8;  ///< with so few on the whole interval, the next one is tried in longer steps
constexpr double kWild = 1e6;   ///< over the state at the start of an interval

class Extrapolation {
 public:
  Extrapolation(const Flow<LongReal>& flow, const ExtrapolationOptions& options)
      : flow_(flow), options_(options) {}

  /// Advances `point` by `interval` in 2^level steps, the level that the last interval needed; false when the limit is
  /// passed.
  bool advance(Point<LongReal>& point, const LongReal& interval) {
    bool easy = true;
    double done = 0;  // share of the interval
    while (done < 1) {
      if (evaluations_ > options_.evaluation_limit || level_ > kMostHalvings) return false;
      const double share = std::ldexp(1.0, -level_);
      const int columns = step(point, LongReal(share) * interval);
      if (columns == 0) {
        ++level_;
        easy = false;
        continue;
      }
      done += share;
      easy = easy && columns <= kFewColumns;
    }
    if (easy && level_ > 0) --level_;
    return true;
  }

  long evaluations() const { return evaluations_; }

 private:
  /// Moves `point` where the columns agree and gives their number; leaves it otherwise and gives 0.
  int step(Point<LongReal>& point, const LongReal& length) {
    const Vector f0 = rates(point.t, point.x);
    double last_apart = INFINITY;
    std::vector<Vector> row;  // row[k]: column k of the last row of the tableau
    for (int j = 0; j < kMaximumColumns; ++j) {
      const std::optional<Vector> first = midpoint(point, f0, length, 2 * (j + 1));
      if (!first) return 0;
      std::vector<Vector> next = {*first};
      for (int k = 0; k < j; ++k)
        next.push_back(combined(next.back(), row[static_cast<std::size_t>(k)], j, k));
      const double apart = j == 0 ? INFINITY : difference(next.back(), next[next.size() - 2]);
      if (apart < options_.tolerance) {
        point = {point.t + length, next.back()};
        return j + 1;
      }
      if (j > 2 && apart > last_apart) return 0;
      last_apart = apart;
      row = std::move(next);
    }
    return 0;
  }

  Vector rates(const LongReal& t, const Vector& x) {
    ++evaluations_;
    return flow_.rates(t, x);
  }

  static Vector moved(const Vector& x, const LongReal& h, const Vector& f) {
    Vector result;
    result.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result.push_back(x[i] + h * f[i]);
    return result;
  }

  /// Modified midpoint rule with `n` substeps, n even; its error has even powers of the substep only.
  /// Nothing where it runs away, as it does on stiff scenes.
  std::optional<Vector> midpoint(const Point<LongReal>& point, const Vector& f0, const LongReal& length,
                                 int n) {
    const LongReal h = length / LongReal(double(n)), twice = LongReal(2.0) * h;
    Vector before = point.x, now = moved(point.x, h, f0);
    LongReal t = point.t + h;
    for (int i = 1; i < n; ++i) {
      if (is_wild(now, point.x)) return {};
      Vector next = moved(before, twice, rates(t, now));
      before = std::move(now);
      now = std::move(next);
      t = t + h;
    }
    if (is_wild(now, point.x)) return {};
    return now;
  }

  static bool is_wild(const Vector& x, const Vector& start) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const LongReal bound(kWild * (1 + std::fabs(double(start[i]))));
      if (!(-bound < x[i] && x[i] < bound)) return true;  // no number is
    }
    return false;
  }

  /// Aitken and Neville in h², substeps 2 (j + 1).
  static Vector combined(const Vector& better, const Vector& above, int j, int k) {
    const double fine = double(j + 1) * (j + 1), coarse = double(j - k) * (j - k);
    const LongReal weight = LongReal(coarse) / LongReal(fine - coarse);
    Vector result;
    result.reserve(better.size());
    for (std::size_t i = 0; i < better.size(); ++i)
      result.push_back(better[i] + (better[i] - above[i]) * weight);
    return result;
  }

  /// Infinite where an entry is no number.
  static double difference(const Vector& a, const Vector& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double apart = std::fabs(double(a[i] - b[i])) / (1 + std::fabs(double(a[i])));
      largest = std::isnan(apart) ? INFINITY : std::max(largest, apart);
    }
    return largest;
  }

  const Flow<LongReal>& flow_;
  ExtrapolationOptions options_;
  long evaluations_ = 0;
  int level_ = 0;
};

}  // namespace

std::optional<std::vector<Point<LongReal>>> extrapolated(const Flow<LongReal>& flow,
                                                         const Point<LongReal>& start, double interval,
                                                         long count, const ExtrapolationOptions& options) {
  Extrapolation extrapolation(flow, options);
  std::vector<Point<LongReal>> points = {start};
  const LongReal length(interval);
  for (long k = 1; k <= count; ++k) {
    Point<LongReal> next = points.back();
    if (!extrapolation.advance(next, length)) return {};
    constexpr double kTold = 0.03;  // share of the way that tells what the rest will cost
    const double share = static_cast<double>(k) / static_cast<double>(count);
    const auto expected = static_cast<double>(extrapolation.evaluations()) / share;
    if (share > kTold && expected > 1.5 * static_cast<double>(options.evaluation_limit)) return {};
    next.t = start.t + LongReal(double(k)) * length;
    next = flow.closed(std::move(next));
    points.push_back(std::move(next));
  }
  return points;
}

}  // namespace jourdain::studies
