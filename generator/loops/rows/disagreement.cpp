#include "loops/rows/disagreement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/regular_rows.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "reference/minimal.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

/// Rows that agree to this with others are closed with them; in the rows' units.
constexpr long double kAgrees = kClosed / 4;
/// Elsewhere they may fit that many times worse, within limits; in the rows' units.
constexpr long double kNearly = 1000, kLeastLimit = 1e-9L, kMostLimit = 0.03L;
/// A row that differs that much from combinations of others is another one however its numbers are rounded.
constexpr long double kUnlike = 1e-2L;

class Settlement {
 public:
  Settlement(const model::Mechanism& mechanism, NumericClosure& closure,
             const std::vector<std::size_t>& independent, std::size_t configurations,
             support::Diagnostics& diagnostics)
      : mechanism_(mechanism),
        closure_(closure),
        independent_(independent),
        configurations_(configurations),
        diagnostics_(diagnostics),
        layout_(model::lay_out_coordinates(mechanism)),
        names_(row_names(mechanism)) {}

  Disagreement run() {
    if (closure_.binds_velocities()) return {};  // what is left open there is no length
    if (leaves_open(kRowTolerance) || leaves_open(kAskew)) report_disagreement();
    return found_;
  }

 private:
  std::vector<std::size_t> all_but(const std::vector<std::size_t>& rows) const {
    return loops::all_but(rows, names_.size());
  }

  bool leaves_open(long double tolerance) {
    const Configuration initial{0, reference::Reference<long double>(mechanism_).initial_state().y};
    std::vector<bool> moving(layout_.velocity_count(), true);
    for (const std::size_t k : independent_) moving[k] = false;
    const Configuration nearest = closure_.assembled(initial, moving);
    const Matrix G = closure_.in_units(closure_.jacobian(nearest));
    const std::vector<std::size_t> regular = regular_rows({G}, tolerance), others = all_but(regular);
    const long double apart = furthest_apart(nearest, G, regular, others);
    if (others.empty() || apart <= kAgrees || apart > tolerance || !are_sized(others, tolerance))
      return false;
    const long double share = std::clamp(kNearly * apart, kLeastLimit, kMostLimit);
    const long double limit = share * largest_unit(others);
    closure_.disregard(others, limit);
    const std::vector<Configuration> seen =
        walk(closure_, closure_.assembled(nearest, moving), mechanism_, configurations_);
    found_.rows = left_open(seen, others.size(), share);
    closure_.disregard(found_.rows, limit);
    if (found_.rows.empty()) return false;
    for (const Configuration& c : seen) found_.amount = std::max(found_.amount, furthest_open(c));
    return true;
  }

  /// By how much rows are open there, and what `others` add to those that are solved for, in the rows' units.
  long double furthest_apart(const Configuration& nearest, const Matrix& G,
                             const std::vector<std::size_t>& regular,
                             const std::vector<std::size_t>& others) const {
    long double apart = closure_.open(nearest);
    for (const std::size_t r : others) apart = std::max(apart, largest_rest(G, regular, {r}));
    return apart;
  }

  long double unit_of(std::size_t row) const { return closure_.units().rows[row]; }

  long double largest_unit(const std::vector<std::size_t>& rows) const {
    long double largest = 0;
    for (const std::size_t r : rows) largest = std::max(largest, unit_of(r));
    return largest;
  }

  /// Are the rows of a size that is known, so that a small one is no row of its own? Expressions may be of any.
  bool are_sized(const std::vector<std::size_t>& rows, long double tolerance) const {
    std::vector<bool> is_expression;
    for (const model::Loop& loop : mechanism_.loops)
      is_expression.resize(is_expression.size() + model::row_count(loop.type),
                           !model::loop_kind(loop).has_ends());
    return tolerance <= kRowTolerance ||
           std::none_of(rows.begin(), rows.end(), [&](std::size_t r) { return is_expression[r]; });
  }

  /// The `count` rows that are left open best where all stay open by no more than `share` of their units wherever
  /// the others let the mechanism go; none where they do not. Near a singular configuration rows nearly follow from
  /// others, too, but not for long.
  std::vector<std::size_t> left_open(const std::vector<Configuration>& seen, std::size_t count,
                                     long double share) const {
    if (!closure_.is_closed(seen.front()) || seen.size() < configurations_ / 2) return {};
    std::vector<Matrix> jacobians;
    for (const Configuration& c : seen) jacobians.push_back(closure_.in_units(closure_.jacobian(c)));
    const std::vector<std::size_t> open =
        all_but(regular_rows(jacobians, std::clamp(share, kRowTolerance, kUnlike)));
    return open.size() == count ? open : std::vector<std::size_t>();
  }

  double furthest_open(const Configuration& c) const {
    return static_cast<double>(closure_.value(c).lpNorm<Eigen::Infinity>());
  }

  void report_disagreement() {
    std::vector<std::string> names;
    for (const std::size_t r : found_.rows) names.push_back(names_[r]);
    const std::string what = fmt::format(
        "constraints {} hold next to nothing that the others do not: they are left open, by up to {:.1g}",
        fmt::join(names, ", "), found_.amount);
    const support::SourceRange where = mechanism_.loops.front().where;
    if (found_.amount <= kRowTolerance * std::min(1.0L, closure_.units().length))
      diagnostics_.note(where, what, "rounded numbers, or an axis that is askew");
    else
      diagnostics_.warning(where, what,
                           "an axis is askew, or numbers have few digits; strictly the mechanism has fewer "
                           "degrees of freedom");
  }

  const model::Mechanism& mechanism_;
  NumericClosure& closure_;
  const std::vector<std::size_t>& independent_;
  std::size_t configurations_;
  support::Diagnostics& diagnostics_;
  model::CoordinateLayout layout_;
  std::vector<std::string> names_;
  Disagreement found_;
};

}  // namespace

Disagreement settle_disagreement(const model::Mechanism& mechanism, NumericClosure& closure,
                                 const std::vector<std::size_t>& independent, std::size_t configurations,
                                 support::Diagnostics& diagnostics) {
  return Settlement(mechanism, closure, independent, configurations, diagnostics).run();
}

}  // namespace jourdain::loops
