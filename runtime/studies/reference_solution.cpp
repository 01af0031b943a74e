#include "studies/reference_solution.hpp"

#include <algorithm>
#include <cmath>

#include "studies/cvode.hpp"
#include "studies/extrapolation.hpp"
#include "studies/work.hpp"
#include "support/check.hpp"

namespace jourdain::studies {

namespace {

constexpr double kTolerance = 1e-23, kLooserTolerance = 1e-20;
constexpr double kCvodeTolerance = 1e-13, kLooserCvodeTolerance = 1e-12;
constexpr const char* kByCvode = "CVODE (Adams) in double";
constexpr std::size_t kFewestSamples = 4;
/// Two integrators agree within so many times what CVODE's solution is known to, and a little. Where rates jump all
/// nodes of the extrapolation's step may lie on one side, whatever its tolerance.
constexpr double kKnown = 100, kLeast = 1e-10;
/// Of CVODE for one of the study. It ends a step at each: where these are what limits its steps, two tolerances give
/// one solution, whose error does not show.
constexpr std::size_t kFinerSamples = 8;
constexpr long kMostEvaluations = 50000000;     ///< where the user insists
constexpr double kEvaluationsPerInterval = 45;  ///< of extrapolation to kTolerance, about

/// Largest difference of an entry, over 1 + |x|; infinite where one is no number.
template <class Real>
double difference(const Point<Real>& a, const Point<Real>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    const double apart = std::fabs(double(a.x[i] - b.x[i])) / (1 + std::fabs(double(a.x[i])));
    largest = std::isnan(apart) ? INFINITY : std::max(largest, apart);
  }
  return largest;
}

/// Of two solutions at the times that both have.
struct Parted {
  double largest = 0;   ///< of an entry, over 1 + |x|
  double position = 0;  ///< rad or m
};

/// `a` and `b` have so many points for one that both have; the first `positions` entries are those.
template <class Real>
Parted parted(const std::vector<Point<Real>>& a, std::size_t of_a, const std::vector<Point<Real>>& b,
              std::size_t of_b, std::size_t positions) {
  Parted result;
  for (std::size_t k = 0; k * of_a < a.size() && k * of_b < b.size(); ++k) {
    const Point<Real>&own = a[k * of_a], &other = b[k * of_b];
    result.largest = std::max(result.largest, difference(own, other));
    for (std::size_t i = 0; i < positions; ++i)
      result.position = std::max(result.position, std::fabs(double(own.x[i] - other.x[i])));
  }
  return result;
}

/// How many samples two solutions have together before they part; `a` and `b` have so many points for a sample.
template <class Real>
std::size_t samples_together(const std::vector<Point<Real>>& a, std::size_t of_a,
                             const std::vector<Point<Real>>& b, std::size_t of_b) {
  std::size_t samples = 0;
  while ((samples + 1) * of_b < b.size() &&
         difference(a[(samples + 1) * of_a], b[(samples + 1) * of_b]) < kParted)
    ++samples;
  return samples;
}

/// Largest residuals of the loops.
template <class Real>
Residuals residuals(const Flow<Real>& flow, const std::vector<Point<Real>>& points) {
  Residuals largest;
  for (const Point<Real>& point : points) {
    const Residuals open = flow.residuals(point);
    largest.position = std::max(largest.position, open.position);
    largest.velocity = std::max(largest.velocity, open.velocity);
  }
  return largest;
}

std::optional<ReferenceSolution> by_extrapolation(const Flow<LongReal>& flow, double interval, long count,
                                                  int halvings, double seconds, bool required,
                                                  const Progress& progress) {
  progress("reference in 50 digits", 0);
  const double evaluation = long_rates_time(flow.table());
  const double coarsest = evaluation * kEvaluationsPerInterval * static_cast<double>(count);
  if (!required && coarsest > seconds) return {};
  int level = 0;
  while (level < halvings && coarsest * std::ldexp(1.0, level + 1) <= seconds) ++level;
  const long fine = count << level;
  ExtrapolationOptions options{.tolerance = kLooserTolerance};
  options.evaluation_limit = required ? kMostEvaluations : static_cast<long>(3 * seconds / evaluation);
  const int looser_level = std::max(0, level - 1);
  auto looser =
      extrapolated(flow, flow.start(), std::ldexp(interval, -looser_level), count << looser_level, options);
  if (!looser) return {};
  progress("reference in 50 digits", 0.3);
  options.tolerance = kTolerance;
  auto exact = extrapolated(flow, flow.start(), std::ldexp(interval, -level), fine, options);
  if (!exact) return {};
  const std::size_t of_exact = std::size_t(1) << level, of_looser = std::size_t(1) << looser_level;
  const std::size_t samples = samples_together(*exact, of_exact, *looser, of_looser);
  if (samples < kFewestSamples) return {};
  exact->resize(1 + samples * of_exact);
  looser->resize(1 + samples * of_looser);
  ReferenceSolution solution;
  solution.method = "Gragg-Bulirsch-Stoer in 50 digits";
  solution.interval = std::ldexp(interval, -level);
  const std::size_t stride = std::size_t(1) << (level - looser_level);
  const Parted apart = parted(*exact, stride, *looser, 1, flow.position_count());
  solution.error = apart.largest;
  solution.position_error = apart.position;
  for (const Point<LongReal>& point : *exact) {
    Point<double>& rounded = solution.points.emplace_back();
    rounded.t = double(point.t);
    for (const LongReal& entry : point.x) rounded.x.push_back(double(entry));
  }
  solution.open = residuals(flow, *exact);
  solution.digits = InFiftyDigits::kSolved;
  solution.exact = std::move(*exact);
  progress("reference in 50 digits", 1);
  return solution;
}

std::optional<ReferenceSolution> by_cvode(const Flow<double>& flow, double sampling, long wanted,
                                          const Progress& progress) {
  const double interval = sampling / kFinerSamples;
  const long count = wanted * static_cast<long>(kFinerSamples);
  progress("reference by CVODE", 0);
  auto points = solved_by_cvode(flow, flow.start(), interval, count, kCvodeTolerance);
  auto looser = solved_by_cvode(flow, flow.start(), interval, count, kLooserCvodeTolerance);
  if (!points || !looser) return {};
  const std::size_t samples = samples_together(*points, kFinerSamples, *looser, kFinerSamples);
  if (samples < kFewestSamples) return {};
  points->resize(1 + samples * kFinerSamples);
  looser->resize(points->size());
  ReferenceSolution solution;
  solution.method = kByCvode;
  solution.interval = interval;
  const Parted apart = parted(*points, 1, *looser, 1, flow.position_count());
  solution.error = apart.largest;
  solution.position_error = apart.position;
  solution.open = residuals(flow, *points);
  solution.points = std::move(*points);
  return solution;
}

/// At the samples that both have.
Parted parted(const ReferenceSolution& a, const ReferenceSolution& b, double sampling,
              std::size_t positions) {
  const auto points = [sampling](const ReferenceSolution& solution) {
    return static_cast<std::size_t>(std::lround(sampling / solution.interval));
  };
  return parted(a.points, points(a), b.points, points(b), positions);
}

}  // namespace

std::optional<ReferenceSolution> reference_at_steps(const Flow<double>& flow,
                                                    const ReferenceSolution& reference, double sampling,
                                                    long steps) {
  const auto stride = static_cast<std::size_t>(std::lround(sampling / reference.interval));
  const std::size_t samples = (reference.points.size() - 1) / stride;
  const long count = static_cast<long>(samples) * steps;
  if (count > kMostPoints) return {};
  ReferenceSolution solution;
  solution.method = kByCvode;
  solution.interval = sampling / static_cast<double>(steps);
  auto points = solved_by_cvode(flow, flow.start(), solution.interval, count, kCvodeTolerance);
  if (!points) return {};
  solution.points = std::move(*points);
  const Parted apart = parted(solution, reference, sampling, flow.position_count());
  solution.error = apart.largest;
  solution.position_error = apart.position;
  return solution;
}

ReferenceSolution solve_reference(const Flow<double>& flow, const Flow<LongReal>* long_flow,
                                  ReferenceKind kind, double interval, long count, int halvings,
                                  double seconds, const Progress& progress) {
  const InFiftyDigits digits =
      kind == ReferenceKind::kCvode ? InFiftyDigits::kNotTried : InFiftyDigits::kTooCostly;
  if (kind != ReferenceKind::kCvode && long_flow) {
    const bool required = kind == ReferenceKind::kExtrapolation;
    if (auto solution =
            by_extrapolation(*long_flow, interval, count, halvings, seconds, required, progress)) {
      auto other = by_cvode(flow, interval, count, progress);
      if (!other) return *solution;
      const Parted apart = parted(*solution, *other, interval, flow.position_count());
      if (apart.largest <= kKnown * other->error + kLeast) return *solution;
      if (!required) {
        other->digits = InFiftyDigits::kContradicted;
        return *other;
      }
      solution->error = std::max(solution->error, apart.largest);
      solution->position_error = std::max(solution->position_error, apart.position);
      return *solution;
    }
    if (required)
      throw support::EnvironmentError(
          "the reference in 50 digits takes too many evaluations; try --reference cvode");
  }
  if (auto solution = by_cvode(flow, interval, count, progress)) {
    solution->digits = digits;
    return *solution;
  }
  throw support::EnvironmentError(
      "CVODE found no reference solution: the motion is not smooth enough, or it ends");
}

}  // namespace jourdain::studies
