#include "studies/work_precision.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "reference/decompositions.hpp"
#include "studies/work.hpp"

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTimingRepeats = 15;
constexpr double kShortestBlock = 1e-3;  ///< s
constexpr double kAgreement = 0.12;      ///< of neighbouring slopes on one straight line
constexpr double kAboveFloor = 30;
constexpr std::size_t kFitted = 5;      ///< points that a line is fitted to where the last slopes disagree
constexpr double kStandardError = 0.3;  ///< of its slope
constexpr double kAstray =
    1e3;  ///< times the largest position of the reference: a run that far off has failed
constexpr double kLargest = 0.1;  ///< relative error up to which slopes mean anything

double largest_entry(const std::vector<Point<double>>& points, std::size_t first, std::size_t last) {
  double largest = 0;
  for (const Point<double>& point : points)
    for (std::size_t i = first; i < last; ++i) largest = std::max(largest, std::fabs(point.x[i]));
  return largest;
}

void widen(double& largest, double value) { largest = std::max(largest, value); }

bool all_finite(const std::vector<double>& x) {
  return std::all_of(x.begin(), x.end(), [](double entry) { return std::isfinite(entry); });
}

ErrorNorms divided(const ErrorNorms& errors, const ErrorNorms& scale) {
  return {scale.position > 0 ? errors.position / scale.position : 0,
          scale.velocity > 0 ? errors.velocity / scale.velocity : 0};
}

/// Smallest position error of all points but zero: what rounding leaves.
double smallest_error(const std::vector<WorkPoint>& points) {
  double smallest = 1;
  for (const WorkPoint& point : points)
    if (point.finite && point.largest.position > 0) smallest = std::min(smallest, point.largest.position);
  return smallest;
}

/// Of the points with this step.
double least_error(const std::vector<WorkPoint>& points, double h) {
  double least = INFINITY;
  for (const WorkPoint& point : points)
    if (point.h < 1.001 * h && point.finite) least = std::min(least, point.largest.position);
  return least;
}

std::optional<double> order_of(std::size_t method, const std::vector<WorkPoint>& points, double floor) {
  std::vector<double> h, errors;
  for (const WorkPoint& point : points) {
    if (point.method != method || !point.finite || point.relative_largest.position > kLargest) continue;
    h.push_back(point.h);
    errors.push_back(point.largest.position);
  }
  return measured_order(h, errors, floor);
}

/// Runs blocks of steps of one method; the time of a step, s.
class Timer {
 public:
  Timer(const jourdain_model_table& table, const jourdain_method& method, const Point<double>& start,
        const std::vector<double>& inputs, double h)
      : table_(table), method_(method), start_(start), inputs_(inputs), h_(h) {
    while (seconds() < kShortestBlock && block_ < 1000000) block_ *= 2;
  }

  double step_time() { return seconds() / static_cast<double>(block_); }

 private:
  double seconds() {
    Point<double> point = start_;
    Memory memory = fresh_memory(table_, method_);
    const jourdain_inputs inputs{inputs_.data(), nullptr, nullptr};
    const auto begin = Clock::now();
    method_.steps(&point.t, point.x.data(), point.x.data() + table_.position_count, &inputs, &h_, block_,
                  memory.data());
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  const jourdain_model_table& table_;
  const jourdain_method& method_;
  const Point<double>& start_;
  const std::vector<double>& inputs_;
  double h_;
  long block_ = 16;
};

}  // namespace

ErrorNorms errors_at(const std::vector<double>& x, const std::vector<double>& reference,
                     std::size_t positions) {
  ErrorNorms norms;
  for (std::size_t i = 0; i < x.size(); ++i)
    widen(i < positions ? norms.position : norms.velocity, std::fabs(x[i] - reference[i]));
  return norms;
}

StepTime spread_of(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  return {samples.front(), samples[samples.size() / 4], samples[3 * samples.size() / 4]};
}

WorkPoint measure_errors(const Flow<double>& flow, std::size_t index, double h, double sampling,
                         const ReferenceSolution& reference, bool conserves_energy) {
  const jourdain_method& method = flow.table().methods[index];
  const std::size_t positions = flow.position_count();
  const long steps_of_all = std::lround(sampling / h), intervals = std::lround(sampling / reference.interval);
  const long meetings = std::gcd(steps_of_all, intervals), steps = steps_of_all / meetings;
  const auto stride = static_cast<std::size_t>(intervals / meetings);
  WorkPoint result;
  result.method = index;
  result.h = h;
  Point<double> point = flow.start();
  Memory memory = flow.fresh_memory(method);
  const double astray = kAstray * (1 + largest_entry(reference.points, 0, positions));
  const double energy = flow.energy(point);
  double drift = 0;
  for (std::size_t k = stride; k < reference.points.size(); k += stride) {
    flow.step(method, point, h, steps, memory);
    result.finite = all_finite(point.x) && flow.is_trusted();
    if (!result.finite) return result;
    result.end = errors_at(point.x, reference.points[k].x, positions);
    result.finite = result.end.position < astray;
    if (!result.finite) return result;
    widen(result.largest.position, result.end.position);
    widen(result.largest.velocity, result.end.velocity);
    if (conserves_energy) widen(drift, std::fabs(flow.energy(point) - energy));
  }
  const ErrorNorms scale{largest_entry(reference.points, 0, positions),
                         largest_entry(reference.points, positions, flow.size())};
  result.relative_end = divided(result.end, scale);
  result.relative_largest = divided(result.largest, scale);
  if (conserves_energy) result.energy_drift = drift;
  return result;
}

std::vector<StepTime> measure_step_times(const jourdain_model_table& table, const Point<double>& start,
                                         const std::vector<double>& inputs, double h) {
  std::vector<Timer> timers;
  for (int m = 0; m < table.method_count; ++m) timers.emplace_back(table, table.methods[m], start, inputs, h);
  std::vector<std::vector<double>> samples(timers.size());
  for (int repeat = 0; repeat < kTimingRepeats; ++repeat)
    for (std::size_t m = 0; m < timers.size(); ++m) samples[m].push_back(timers[m].step_time());
  std::vector<StepTime> times;
  for (const std::vector<double>& sample : samples) times.push_back(spread_of(sample));
  return times;
}

std::vector<double> longer_steps(const ReferenceSolution& reference, double sampling) {
  constexpr long kFewestSteps = 10;
  const auto intervals = static_cast<long>(reference.points.size() - 1);
  const double duration = reference.interval * static_cast<double>(intervals);
  std::vector<double> steps;
  for (double h = 2 * sampling; duration / h >= kFewestSteps; h *= 2) {
    auto count = static_cast<long>(duration / h + 1e-9);
    while (intervals % count != 0) --count;
    if (count >= kFewestSteps) steps.insert(steps.begin(), duration / static_cast<double>(count));
  }
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

WorkPrecision study_work_precision(const Flow<double>& flow, const std::vector<double>& steps,
                                   double sampling, const ReferenceSolution& reference, bool conserves_energy,
                                   const std::vector<double>& held_inputs, const Progress& progress) {
  WorkPrecision study;
  study.duration = reference.interval * static_cast<double>(reference.points.size() - 1);
  const auto methods = static_cast<std::size_t>(flow.table().method_count);
  progress("step times", 0);
  study.step_times = measure_step_times(flow.table(), flow.start(), held_inputs, steps.back());
  for (std::size_t m = 0; m < methods; ++m)
    for (std::size_t i = 0; i < steps.size(); ++i) {
      progress("errors of the methods", double(m * steps.size() + i) / double(methods * steps.size()));
      WorkPoint point =
          measure_errors(flow, m, steps[i], std::max(steps[i], sampling), reference, conserves_energy);
      point.run_time = study.step_times[m].least / steps[i];
      study.points.push_back(point);
    }
  judge_orders(study, reference);
  return study;
}

void judge_orders(WorkPrecision& study, const ReferenceSolution& reference) {
  const double floor = std::max(reference.error, smallest_error(study.points));
  study.orders.clear();
  for (std::size_t m = 0; m < study.step_times.size(); ++m)
    study.orders.push_back(order_of(m, study.points, floor));
  mark_pareto_front(study.points);
}

std::vector<double> go_on_to_shorter_steps(WorkPrecision& study, double h, double tolerance,
                                           const Flow<double>& flow, double sampling,
                                           const ReferenceSolution& reference, bool conserves_energy,
                                           double seconds, const Progress& progress) {
  constexpr double kFalls = 1.5, kMostSteps = 4096;  // of a sampling interval
  double level = 0;
  for (int m = 0; m < flow.table().method_count; ++m)
    level += step_time(flow.table().methods[m]) * study.duration;
  Budget budget(seconds);
  std::vector<double> more;
  for (double best = least_error(study.points, h), before = kFalls * best;
       best > tolerance && before >= kFalls * best && sampling / h < 0.999 * kMostSteps;) {
    h /= 2;
    budget.spend(level / h);
    if (budget.is_over()) break;
    progress("shorter steps", 1 - budget.left() / seconds);
    std::vector<WorkPoint> points;
    for (const WorkPoint& point : study.points) {
      points.push_back(point);
      if (point.h > 2.001 * h) continue;
      WorkPoint next = measure_errors(flow, point.method, h, sampling, reference, conserves_energy);
      next.run_time = study.step_times[point.method].least / h;
      points.push_back(next);
    }
    study.points = std::move(points);
    more.push_back(h);
    before = best;
    best = least_error(study.points, h);
  }
  if (!more.empty()) judge_orders(study, reference);
  return more;
}

void mark_pareto_front(std::vector<WorkPoint>& points) {
  const auto beats = [](const WorkPoint& a, const WorkPoint& b) {
    const double error_a = a.largest.position, error_b = b.largest.position;
    return a.finite && a.run_time <= b.run_time && error_a <= error_b &&
           (a.run_time < b.run_time || error_a < error_b);
  };
  for (WorkPoint& point : points)
    point.pareto = point.finite && std::none_of(points.begin(), points.end(),
                                                [&](const WorkPoint& other) { return beats(other, point); });
}

std::optional<double> measured_order(const std::vector<double>& h, const std::vector<double>& errors,
                                     double floor) {
  std::size_t count = 0;
  while (count < h.size() && errors[count] > kAboveFloor * floor) ++count;
  if (count < 3) return {};
  const auto slope = [&](std::size_t i) {
    return std::log(errors[i] / errors[i + 1]) / std::log(h[i] / h[i + 1]);
  };
  const double last = slope(count - 2), before = slope(count - 3);
  if (std::fabs(last - before) < kAgreement) return 2 * last - before;
  if (count < kFitted) return {};
  Eigen::MatrixXd A(kFitted, 2);
  Eigen::VectorXd b(kFitted);
  for (std::size_t i = 0; i < kFitted; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) << std::log(h[count - kFitted + i]), 1;
    b[row] = std::log(errors[count - kFitted + i]);
  }
  const Eigen::VectorXd line = reference::least_squares<double>(A, b);
  const double scatter = (A * line - b).norm() / std::sqrt(kFitted - 2.0);
  const double range = (A.col(0).array() - A.col(0).mean()).matrix().norm();
  return scatter / range < kStandardError ? std::optional(line[0]) : std::nullopt;
}

}  // namespace jourdain::studies
