#include "studies/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "support/check.hpp"

namespace jourdain::studies {

namespace {

constexpr long kMaximumSteps = 10000000;
/// Of one step: a force that jumps where all is at rest makes it shorter by fourteen decades.
constexpr int kMostFailures = 40;

/// Where rates are no numbers, 1: CVODE tries a shorter step, a few times.
int right_hand_side(realtype t, N_Vector x, N_Vector f, void* user) {
  double* const rates = N_VGetArrayPointer(f);
  (*static_cast<CountedRates*>(user))(t, N_VGetArrayPointer(x), rates);
  return std::all_of(rates, rates + N_VGetLength(f), [](double rate) { return std::isfinite(rate); }) ? 0 : 1;
}

void no_messages(int, const char*, const char*, char*, void*) {}

enum class Iteration { kNewton, kFixedPoint };

/// CVODE's objects, freed in the opposite order.
class Solver {
 public:
  Solver(CountedRates& rates, const Point<double>& start, double tolerance, int formula,
         Iteration iteration) {
    JD_CHECK(SUNContext_Create(nullptr, &context_) == 0, "no SUNDIALS context");
    const auto size = static_cast<sunindextype>(rates.size());
    x_ = N_VNew_Serial(size, context_);
    std::copy(start.x.begin(), start.x.end(), N_VGetArrayPointer(x_));
    memory_ = CVodeCreate(formula, context_);
    JD_CHECK(CVodeInit(memory_, right_hand_side, start.t, x_) == CV_SUCCESS, "CVodeInit");
    CVodeSetErrHandlerFn(memory_, no_messages, nullptr);
    CVodeSetUserData(memory_, &rates);
    CVodeSStolerances(memory_, tolerance, 0.1 * tolerance);
    CVodeSetMaxNumSteps(memory_, kMaximumSteps);
    CVodeSetMaxErrTestFails(memory_, kMostFailures);
    CVodeSetMaxConvFails(memory_, kMostFailures);
    if (iteration == Iteration::kFixedPoint) {
      fixed_point_ = SUNNonlinSol_FixedPoint(x_, 0, context_);
      CVodeSetNonlinearSolver(memory_, fixed_point_);
    } else {
      matrix_ = SUNDenseMatrix(size, size, context_);
      linear_ = SUNLinSol_Dense(x_, matrix_, context_);
      CVodeSetLinearSolver(memory_, linear_, matrix_);
    }
  }
  ~Solver() {
    CVodeFree(&memory_);
    if (fixed_point_) SUNNonlinSolFree(fixed_point_);
    if (linear_) SUNLinSolFree(linear_);
    if (matrix_) SUNMatDestroy(matrix_);
    N_VDestroy(x_);
    SUNContext_Free(&context_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void stop_at(double t) { CVodeSetStopTime(memory_, t); }

  /// To `t`, or one step on the way there; the time that is reached, none where CVODE gives up.
  std::optional<double> advance(double t, int task) {
    double reached = 0;
    if (CVode(memory_, t, x_, &reached, task) < 0) return {};
    return reached;
  }

  std::vector<double> state() const {
    const double* values = N_VGetArrayPointer(x_);
    return std::vector<double>(values, values + N_VGetLength(x_));
  }

  /// x(t) within the last step. Spoils x, which CVODE keeps to itself.
  void interpolate(double t, double* x) {
    CVodeGetDky(memory_, t, 0, x_);
    std::copy_n(N_VGetArrayPointer(x_), N_VGetLength(x_), x);
  }

  void restart(const Point<double>& point) {
    std::copy(point.x.begin(), point.x.end(), N_VGetArrayPointer(x_));
    CVodeReInit(memory_, point.t, x_);
  }

 private:
  SUNContext context_ = nullptr;
  N_Vector x_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
  void* memory_ = nullptr;
};

/// Step by step.
class Cvode : public AdaptiveIntegrator {
 public:
  Cvode(CvodeKind kind, CountedRates& rates, const Point<double>& start, double end, double tolerance)
      : solver_(rates, start, tolerance, kind == CvodeKind::kAdams ? CV_ADAMS : CV_BDF,
                kind == CvodeKind::kAdams ? Iteration::kFixedPoint : Iteration::kNewton),
        t_(start.t),
        end_(end) {
    solver_.stop_at(end);
  }

  bool step() override {
    const std::optional<double> reached = solver_.advance(end_, CV_ONE_STEP);
    if (reached) t_ = *reached;
    return reached.has_value();
  }
  double time() const override { return t_; }
  void interpolate(double t, double* x) override { solver_.interpolate(t, x); }
  void restart(const Point<double>& point) override {
    solver_.restart(point);
    solver_.stop_at(end_);
    t_ = point.t;
  }

 private:
  Solver solver_;
  double t_, end_;
};

}  // namespace

std::optional<std::vector<Point<double>>> solved_by_cvode(const Flow<double>& flow,
                                                          const Point<double>& start, double interval,
                                                          long count, double tolerance) {
  CountedRates rates(flow);
  Solver solver(rates, start, tolerance, CV_ADAMS, Iteration::kNewton);
  std::vector<Point<double>> points = {start};
  for (long k = 1; k <= count; ++k) {
    const double t = start.t + static_cast<double>(k) * interval;
    solver.stop_at(t);
    if (!solver.advance(t, CV_NORMAL)) return {};
    points.push_back({t, solver.state()});
    const Residuals open = flow.residuals_of_closed_rows(points.back());
    if (std::max(open.position, open.velocity) <= tolerance) continue;
    points.back() = flow.closed(points.back());
    solver.restart(points.back());
  }
  return points;
}

std::unique_ptr<AdaptiveIntegrator> make_cvode(CvodeKind kind, CountedRates& rates,
                                               const Point<double>& start, double end, double tolerance) {
  return std::make_unique<Cvode>(kind, rates, start, end, tolerance);
}

}  // namespace jourdain::studies
