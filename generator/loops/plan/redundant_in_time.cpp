#include "loops/plan/redundant_in_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/regular_rows.hpp"
#include "model/loop_kinds.hpp"
#include "model/time_dependence.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using support::at;

namespace {

/// Closed at a later time, by steps that open no row by much; nothing where the way ends.
class Later {
 public:
  Later(const NumericClosure& closure, Configuration start) : closure_(closure), now_(std::move(start)) {}

  const Configuration& now() const { return now_; }

  bool step() {
    constexpr long double kLongest = 0.05L, kShortest = 1e-6L, kNear = 0.05L;
    length_ = std::min(2 * length_, kLongest);
    for (; length_ > kShortest; length_ /= 2) {
      Configuration next = now_;
      next.t += length_;
      if (closure_.open(next) > kNear) continue;
      next = closure_.assembled(next, {});
      if (!closure_.is_closed(next)) continue;
      now_ = next;
      return true;
    }
    return false;
  }

 private:
  const NumericClosure& closure_;
  Configuration now_;
  long double length_ = 1e-3L;
};

}  // namespace

bool check_later(const model::Mechanism& mechanism, NumericClosure closure, const Configuration& start,
                 const LoopPlan& plan, support::Diagnostics& diagnostics) {
  constexpr int kSteps = 100;
  constexpr double kRounded = 1e-6;
  const std::vector<std::size_t> others = all_but(plan.rows, closure.row_count());
  if (others.empty() || !model::time_dependence(mechanism).positions) return true;
  closure.disregard(others, std::numeric_limits<long double>::max());
  const long double allowed = plan.most_left_open();
  Later later(closure, start);
  long double worst = 0, when = 0;
  std::size_t row = others.front();
  for (int i = 0; i < kSteps && worst <= allowed && later.step(); ++i) {
    const Vector g = closure.value(later.now());
    for (const std::size_t r : others)
      if (const long double open = std::fabs(g[at(r)]); open > worst) {
        worst = open;
        when = later.now().t;
        row = r;
      }
  }
  if (worst <= std::max(kRounded * std::min(1.0, plan.length_unit), 10 * plan.disagreement)) return true;
  const model::Loop& loop = model::loop_of_row(mechanism, row);
  if (worst <= allowed) {
    diagnostics.warning(
        loop.where,
        fmt::format("{} follows from the others but for {:.1g} at t = {:.3g} s, of {} times that were looked "
                    "at: it is left open by that",
                    in_words(loop), static_cast<double>(worst), static_cast<double>(when), kSteps),
        "what prescribes positions does not quite agree");
    return true;
  }
  diagnostics.error(
      loop.where, fmt::format("no positions agree with {} as time goes on", in_words(loop)),
      fmt::format("what prescribes positions contradicts it, at t = {:.3g} s by {:.3g} in {}",
                  static_cast<double>(when), static_cast<double>(worst), row_names(mechanism)[row]));
  return false;
}

}  // namespace jourdain::loops
