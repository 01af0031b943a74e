#include "studies/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <memory>

#include "support/check.hpp"

namespace jourdain::studies {

namespace {

constexpr long kMaximumSteps = 10000000;

int right_hand_side(realtype t, N_Vector x, N_Vector f, void* user) {
  const auto& flow = *static_cast<const Flow<double>*>(user);
  const double* values = N_VGetArrayPointer(x);
  const std::vector<double> rates = flow.rates(t, {values, values + flow.size()});
  std::copy(rates.begin(), rates.end(), N_VGetArrayPointer(f));
  return 0;
}

void no_messages(int, const char*, const char*, char*, void*) {}

/// CVODE's objects, freed in the opposite order.
class Solver {
 public:
  Solver(const Flow<double>& flow, const Point<double>& start, double tolerance) {
    JD_CHECK(SUNContext_Create(nullptr, &context_) == 0, "no SUNDIALS context");
    const auto size = static_cast<sunindextype>(flow.size());
    x_ = N_VNew_Serial(size, context_);
    std::copy(start.x.begin(), start.x.end(), N_VGetArrayPointer(x_));
    matrix_ = SUNDenseMatrix(size, size, context_);
    linear_ = SUNLinSol_Dense(x_, matrix_, context_);
    memory_ = CVodeCreate(CV_ADAMS, context_);
    JD_CHECK(CVodeInit(memory_, right_hand_side, start.t, x_) == CV_SUCCESS, "CVodeInit");
    CVodeSetErrHandlerFn(memory_, no_messages, nullptr);
    CVodeSetUserData(memory_, const_cast<Flow<double>*>(&flow));
    CVodeSStolerances(memory_, tolerance, 0.1 * tolerance);
    CVodeSetLinearSolver(memory_, linear_, matrix_);
    CVodeSetMaxNumSteps(memory_, kMaximumSteps);
  }
  ~Solver() {
    CVodeFree(&memory_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(matrix_);
    N_VDestroy(x_);
    SUNContext_Free(&context_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  std::optional<std::vector<double>> advance(double t) {
    CVodeSetStopTime(memory_, t);
    double reached = 0;
    if (CVode(memory_, t, x_, &reached, CV_NORMAL) < 0) return {};
    const double* values = N_VGetArrayPointer(x_);
    return std::vector<double>(values, values + N_VGetLength(x_));
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
  void* memory_ = nullptr;
};

}  // namespace

std::optional<std::vector<Point<double>>> solved_by_cvode(const Flow<double>& flow,
                                                          const Point<double>& start, double interval,
                                                          long count, double tolerance) {
  Solver solver(flow, start, tolerance);
  std::vector<Point<double>> points = {start};
  for (long k = 1; k <= count; ++k) {
    const double t = start.t + static_cast<double>(k) * interval;
    std::optional<std::vector<double>> x = solver.advance(t);
    if (!x) return {};
    points.push_back({t, std::move(*x)});
    const Residuals open = flow.residuals(points.back());
    if (std::max(open.position, open.velocity) <= tolerance) continue;
    points.back() = flow.closed(points.back());
    solver.restart(points.back());
  }
  return points;
}

}  // namespace jourdain::studies
