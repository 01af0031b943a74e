#include "studies/alternatives.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string_view>

#include "studies/cvode.hpp"
#include "studies/dormand_prince.hpp"
#include "studies/work.hpp"

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kEngineMethod = "semi_implicit_euler";
constexpr double kEngineStep = 2e-3;     ///< s, MuJoCo's default
constexpr double kShortestBlock = 1e-3;  ///< s
constexpr int kMostBlocks = 15, kFewestBlocks = 5;
constexpr int kFirstRung = 3, kLastRung = 39;  ///< thirds of a decade
constexpr double kRoundings = 10;              ///< a tolerance below so many means nothing

using MakeIntegrator = std::unique_ptr<AdaptiveIntegrator> (*)(CountedRates&, const Point<double>&, double,
                                                               double);

struct Kind {
  const char* name;
  MakeIntegrator make;
};

constexpr Kind kKinds[] = {
    {"Dormand-Prince 5(4)",
     [](CountedRates& rates, const Point<double>& start, double end,
        double tolerance) -> std::unique_ptr<AdaptiveIntegrator> {
       return std::make_unique<DormandPrince>(rates, start, end, tolerance);
     }},
    {"CVODE, Adams",
     [](CountedRates& rates, const Point<double>& start, double end, double tolerance) {
       return make_cvode(CvodeKind::kAdams, rates, start, end, tolerance);
     }},
    {"CVODE, BDF", [](CountedRates& rates, const Point<double>& start, double end, double tolerance) {
       return make_cvode(CvodeKind::kBdf, rates, start, end, tolerance);
     }}};

/// What is compared with what.
struct Course {
  const Flow<double>& flow;
  const ReferenceSolution& reference;
  Point<double> start;
  double error = 0;           ///< asked for
  std::size_t stride = 1;     ///< of the reference's points
  std::vector<double> times;  ///< of those compared, without the start

  double end() const { return times.back(); }
  double compared() const { return static_cast<double>(stride) * reference.interval; }
  double duration() const { return end() - start.t; }
};

Course course_of(const Flow<double>& flow, const ReferenceSolution& reference, double error,
                 double compared) {
  Course course{flow, reference, flow.start(), error, 1, {}};
  course.stride = static_cast<std::size_t>(std::lround(compared / reference.interval));
  for (std::size_t k = course.stride; k < reference.points.size(); k += course.stride)
    course.times.push_back(reference.points[k].t);
  return course;
}

ErrorNorms largest_errors(const Course& course, const std::vector<Point<double>>& points) {
  ErrorNorms largest;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::vector<double>& exact = course.reference.points[(k + 1) * course.stride].x;
    const ErrorNorms errors = errors_at(points[k].x, exact, course.flow.position_count());
    largest.position = std::max(largest.position, errors.position);
    largest.velocity = std::max(largest.velocity, errors.velocity);
  }
  return largest;
}

AdaptiveRun adaptive_run(const Course& course, const Kind& kind, double tolerance, long call_limit) {
  CountedRates rates(course.flow);
  const auto integrator = kind.make(rates, course.start, course.end(), tolerance);
  return follow(*integrator, rates, course.times, tolerance, call_limit);
}

/// The loosest tolerance that keeps the error, or the most accurate run.
Alternative at_equal_error(const Course& course, const Kind& kind, long call_limit) {
  Alternative best;
  best.name = kind.name;
  const double tightest = kRoundings * course.flow.table().unit_roundoff;
  for (int rung = kFirstRung; rung <= kLastRung && call_limit > 0 && !best.keeps; ++rung) {
    const double tolerance = std::pow(10.0, -rung / 3.0);
    if (tolerance < tightest) break;
    const AdaptiveRun run = adaptive_run(course, kind, tolerance, call_limit);
    call_limit -= run.calls;
    if (!run.finished) continue;
    const ErrorNorms error = largest_errors(course, run.points);
    const bool better =
        std::isfinite(error.position) && (!best.finished || error.position < best.error.position);
    if (better)
      best = {kind.name, tolerance,       {}, error, true, error.position <= course.error, run.steps,
              run.calls, run.worst_calls, {}};
  }
  return best;
}

Alternative of_fixed_step(const Course& course, std::size_t index, double h, double block,
                          const std::string& name) {
  const jourdain_method& method = course.flow.table().methods[index];
  const WorkPoint point = measure_errors(course.flow, index, h, block, course.reference, false);
  const long steps = std::lround(course.duration() / h);
  return {name,
          {},
          h,
          point.largest,
          point.finite,
          point.finite && point.largest.position <= course.error,
          steps,
          steps * method.evaluations,
          method.evaluations,
          {}};
}

/// One run of a fixed step; its time, s.
double time_fixed(const Course& course, std::size_t index, double h, long steps) {
  const jourdain_method& method = course.flow.table().methods[index];
  Point<double> point = course.start;
  Memory memory = course.flow.fresh_memory(method);
  const auto begin = Clock::now();
  course.flow.step(method, point, h, steps, memory);
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// One run of an adaptive integrator that gives the state at `times`; its time without what it sets up, s.
double time_adaptive(const Course& course, const Kind& kind, double tolerance,
                     const std::vector<double>& times) {
  CountedRates rates(course.flow);
  const auto integrator = kind.make(rates, course.start, course.end(), tolerance);
  const auto begin = Clock::now();
  follow(*integrator, rates, times, tolerance, std::numeric_limits<long>::max());
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Mean time of a run over a block that takes a millisecond at least, s.
double block_time(const std::function<double()>& run) {
  double sum = 0;
  long count = 0;
  while (sum < kShortestBlock && count < 10000) {
    sum += run();
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// Of one call, nominal, s.
double call_time(const jourdain_model_table& table) {
  return kStepTime + kOperationTime * static_cast<double>(table.dynamics_operations);
}

struct Contender {
  Alternative& row;
  std::function<double()> run;  ///< gives its time, s
};

/// Blocks of all runs in turns, fewer of them where runs are long.
void time_in_turns(const std::vector<Contender>& contenders, const Course& course, double seconds) {
  double round = 0;
  for (const Contender& c : contenders)
    round += std::max(kShortestBlock, call_time(course.flow.table()) * static_cast<double>(c.row.calls));
  const int blocks =
      static_cast<int>(std::clamp(seconds / round, double(kFewestBlocks), double(kMostBlocks)));
  std::vector<std::vector<double>> samples(contenders.size());
  for (int block = 0; block < blocks; ++block)
    for (std::size_t i = 0; i < contenders.size(); ++i)
      samples[i].push_back(block_time(contenders[i].run) / course.duration());
  for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].row.run_time = spread_of(samples[i]);
}

std::optional<std::size_t> find_method(const jourdain_model_table& table, std::string_view name) {
  for (int m = 0; m < table.method_count; ++m)
    if (name == table.methods[m].name) return static_cast<std::size_t>(m);
  return {};
}

/// The engine's step, or the one next to it of which whole numbers make `block`.
double engine_step(double block) { return block / std::max(1.0, std::round(block / kEngineStep)); }

/// Of at most kMostParts equal parts of `block` the shortest, whole numbers of the reference's intervals.
double part_of(double block, const ReferenceSolution& reference) {
  constexpr long kMostParts = 32;
  const long intervals = std::lround(block / reference.interval);
  long parts = std::min(kMostParts, intervals);
  while (intervals % parts != 0) --parts;
  return block / static_cast<double>(parts);
}

/// All rows without their times.
Alternatives counted_rows(const Course& course, const Advice& advice, double block, double seconds,
                          const Progress& progress) {
  const jourdain_model_table& table = course.flow.table();
  const auto limit = static_cast<long>(seconds / call_time(table));
  Alternatives study{course.error, course.compared(), {}};
  study.rows.push_back(
      of_fixed_step(course, advice.method, advice.h, block, table.methods[advice.method].name));
  study.rows.back().error = advice.error;
  study.rows.back().keeps = advice.error.position <= course.error;
  for (std::size_t i = 0; i < std::size(kKinds); ++i) {
    progress("other integrators", double(i) / double(std::size(kKinds) + 1));
    study.rows.push_back(at_equal_error(course, kKinds[i], limit));
  }
  if (const auto engine = find_method(table, kEngineMethod))
    study.rows.push_back(of_fixed_step(course, *engine, engine_step(block), block, "semi-implicit Euler"));
  return study;
}

}  // namespace

Alternatives study_alternatives(const Flow<double>& flow, const Advice& advice,
                                const std::optional<double>& tolerance, double sampling,
                                const ReferenceSolution& reference, double seconds,
                                const Progress& progress) {
  const double block = std::max(advice.h, sampling);
  const double compared = flow.has_loops() ? block : part_of(block, reference);
  const Course course = course_of(flow, reference, tolerance.value_or(advice.error.position), compared);
  Alternatives study = counted_rows(course, advice, block, seconds, progress);
  const std::vector<double> times = flow.has_loops() ? course.times : std::vector{course.end()};
  const std::size_t engine = find_method(flow.table(), kEngineMethod).value_or(0);
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < study.rows.size(); ++i) {
    Alternative& row = study.rows[i];
    if (!row.finished) continue;
    const std::size_t method = i == 0 ? advice.method : engine;
    if (row.h)
      contenders.push_back({row, [&, method] { return time_fixed(course, method, *row.h, row.steps); }});
    else
      contenders.push_back(
          {row, [&, i] { return time_adaptive(course, kKinds[i - 1], *row.tolerance, times); }});
  }
  time_in_turns(contenders, course, seconds);
  return study;
}

double time_ratio(const Alternatives& study, const Alternative& row) {
  return row.run_time.least / study.rows.front().run_time.least;
}

}  // namespace jourdain::studies
