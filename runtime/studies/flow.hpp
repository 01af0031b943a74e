// A loaded model with its inputs as a system of first-order equations dx/dt = f(t, x), x = (y, z).
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "jourdain/long_real.hpp"
#include "jourdain/model_table.h"
#include "studies/inputs.hpp"

namespace jourdain::studies {

/// Doubles per number in a table.
template <class Real>
inline constexpr int kParts = 1;
template <>
inline constexpr int kParts<LongReal> = 4;

/// The number that kParts<Real> doubles are the sum of.
template <class Real>
Real number_at(const double* parts) {
  if constexpr (kParts<Real> == 1)
    return *parts;
  else
    return Real::joined(parts, kParts<Real>);
}

/// Time (s) and x = (y, z).
template <class Real>
struct Point {
  Real t = Real(0.0);
  std::vector<Real> x;
};

/// What a method remembers, as jourdain_method describes it.
using Memory = std::vector<double>;

/// How far loops are open: m, and m/s (rows without a length: without unit, 1/s).
struct Residuals {
  double position = 0, velocity = 0;
};

/// Memory at the start of a trajectory.
Memory fresh_memory(const jourdain_model_table& table, const jourdain_method& method);

/// Real: double (also for tables that compute in float) or LongReal; the table must have kParts<Real>.
template <class Real>
class Flow {
 public:
  /// Both must outlive this. `inputs` gives as many values as the table has inputs.
  Flow(const jourdain_model_table& table, const Inputs& inputs);

  const jourdain_model_table& table() const { return table_; }
  const Inputs& inputs() const { return inputs_; }
  std::size_t position_count() const { return static_cast<std::size_t>(table_.position_count); }
  std::size_t size() const { return position_count() + static_cast<std::size_t>(table_.velocity_count); }

  bool has_loops() const { return table_.correct != nullptr; }

  /// The state that the description starts from, or the one that was set, with the positions that a step of no
  /// length leaves: its quaternions have unit length in this number type. Its loops are closed, if they can be
  /// from there.
  Point<Real> start() const;
  void set_start(const std::vector<double>& x) { start_ = x; }
  /// What was set; empty: nothing.
  const std::vector<double>& start_set() const { return start_; }
  /// From now on steps get inputs as numbers, those of their begin, and hold them.
  void hold_inputs() { held_ = true; }
  /// f(t, x).
  std::vector<Real> rates(const Real& t, const std::vector<Real>& x) const;
  /// An empty memory for `method`.
  Memory fresh_memory(const jourdain_method& method) const;
  /// A memory that holds the rates at `earlier` points, newest first; as many as `method` remembers. A fresh
  /// one for methods that remember no rates.
  Memory memory_of(const jourdain_method& method, const std::vector<Point<Real>>& earlier) const;
  /// `count` steps of length h; inputs are sampled at the stages, unless they are held.
  void step(const jourdain_method& method, Point<Real>& point, double h, long count, Memory& memory) const;
  /// Kinetic and potential energy together, J.
  double energy(const Point<Real>& point) const;
  double kinetic_energy(const Point<Real>& point) const;

  /// `point` after the correction that steps end with; itself where there are no loops.
  Point<Real> corrected(const Point<Real>& point) const;
  /// Corrected until nothing changes beyond rounding, or sixty times.
  Point<Real> closed(Point<Real> point) const;
  /// Of the last call of `step` on this thread; there must be loops.
  jourdain_closing last_closing() const;
  /// Was the closing regular, and were positions within the ranges for which it is proven, in all steps of the
  /// last call of `step`?
  bool is_trusted() const;
  /// Largest |g| and |dg/dt| over all rows; zero where there are no loops.
  Residuals residuals(const Point<Real>& point) const;
  /// Rows that do not agree with the others, by rounded numbers: closing leaves them open.
  void leave_open(std::vector<std::size_t> rows) { left_open_ = std::move(rows); }
  /// Largest |g| and |dg/dt| over the others.
  Residuals residuals_of_closed_rows(const Point<Real>& point) const;

 private:
  Residuals residuals_but(const Point<Real>& point, const std::vector<std::size_t>& rows) const;

  const jourdain_model_table& table_;
  const Inputs& inputs_;
  std::vector<std::size_t> left_open_;
  std::vector<double> start_;  ///< empty: the description's
  bool held_ = false;
};

/// Generalized forces (N m, N) that are missing for `zdot` at zero inputs.
template <class Real>
std::vector<Real> inverse_dynamics(const jourdain_model_table& table, const Real& t,
                                   const std::vector<Real>& y, const std::vector<Real>& z,
                                   const std::vector<Real>& zdot);

extern template class Flow<double>;
extern template class Flow<LongReal>;

}  // namespace jourdain::studies
