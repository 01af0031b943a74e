#include "loops/plan/start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "loops/plan/given_values.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "reference/minimal.hpp"
#include "support/matrix_index.hpp"
#include "support/uniform.hpp"

namespace jourdain::loops {

using support::shown;

namespace {

using support::at;

/// Velocities that agree to this share of the largest are written with too few digits.
constexpr long double kRounded = 1e-6L;
/// ġ below this share of the largest velocity counts as zero.
constexpr long double kAgrees = 1e-10L;

using Entries = std::vector<std::size_t>;

class StartSearch {
 public:
  StartSearch(const model::Mechanism& mechanism, const NumericClosure& closure, const Entries& independent,
              const LoopPlan* plan, support::Diagnostics& diagnostics)
      : mechanism_(mechanism),
        closure_(closure),
        independent_(independent),
        plan_(plan),
        diagnostics_(diagnostics),
        layout_(model::lay_out_coordinates(mechanism)),
        given_(given_values(mechanism, layout_)),
        initial_(reference::Reference<long double>(mechanism).initial_state()) {}

  std::optional<Start> find() {
    if (!find_positions() || !find_velocities()) return {};
    start_.kept_y = record(initial_.y, start_.configuration.y, layout_.position_names, false);
    start_.kept_z = record(initial_.z, start_.z, layout_.velocity_names, true);
    return start_;
  }

 private:
  /// All velocities but those two lists.
  std::vector<bool> all_but(const Entries& held, const Entries& others) const {
    std::vector<bool> list(layout_.velocity_count(), true);
    for (const std::size_t k : held) list[k] = false;
    for (const std::size_t k : others) list[k] = false;
    return list;
  }

  bool is_closed(const Configuration& config) const { return closure_.closes(config); }

  bool is_start(const Configuration& config) const {
    return is_closed(config) && closure_.reversed(config).empty() && in_range(config, mechanism_, layout_);
  }

  /// Entries whose positions the description gives, all or those that follow parameters.
  Entries given_positions(bool following) const {
    Entries given;
    for (std::size_t k = 0; k < given_.position.size(); ++k)
      if (given_.position[k].is_given() && (given_.position[k].follows || !following)) given.push_back(k);
    return given;
  }

  Configuration planned() const {
    return {0, Eigen::Map<const Eigen::VectorXd>(plan_->y.data(), at(plan_->y.size())).cast<long double>()};
  }

  /// From where the plan starts to the initial positions of `held`, bit by bit.
  Configuration carried(const Entries& held) const {
    constexpr int kSteps = 16;
    const Configuration first = planned();
    Configuration now = first;
    const auto is_held = [&](std::size_t k) { return std::find(held.begin(), held.end(), k) != held.end(); };
    for (int i = 1; i <= kSteps; ++i) {
      const long double share = i / (1.0L * kSteps);
      for (const model::Tangent::Scalar& s : layout_.tangent.scalars)
        if (is_held(s.velocity))
          now.y[at(s.position)] = std::lerp(first.y[at(s.position)], initial_.y[at(s.position)], share);
      for (const model::Tangent::Scalar& s : layout_.tangent.quaternions) {
        if (!is_held(s.velocity)) continue;
        const Eigen::Vector4<long double> from = first.y.segment<4>(at(s.position)),
                                          to = initial_.y.segment<4>(at(s.position));
        const long double sign = i < kSteps && from.dot(to) < 0 ? -1 : 1;
        now.y.segment<4>(at(s.position)) =
            i < kSteps ? ((1 - share) * from + sign * share * to).normalized() : to;
      }
      now = closure_.assembled(now, all_but(independent_, held));
    }
    return now;
  }

  bool take_where_it_starts(const Configuration& config) {
    start_.configuration = config;
    return is_start(config);
  }

  bool find_positions() {
    const Entries given = given_positions(false);
    if (plan_ &&
        (take_where_it_starts(carried(given)) || take_where_it_starts(carried(given_positions(true)))))
      return true;
    const Configuration initial{0, initial_.y},
        kept = closure_.assembled(initial, all_but(independent_, given));
    if (take_where_it_starts(kept)) return true;
    if (take_where_it_starts(closure_.assembled(kept, all_but(independent_, {}))) ||
        take_where_it_starts(closure_.assembled(initial, all_but(independent_, {}))))
      return true;
    if (is_closed(kept) && closure_.reversed(kept).empty()) start_.configuration = kept;
    const Configuration nearest = start_.configuration;
    if (is_closed(nearest) && !report_reversed()) return false;
    if (is_closed(initial)) return true;  // as given, wherever its ranges are
    if (find_beside(initial, given, given) || (!given.empty() && find_beside(initial, given, {})))
      return true;
    if (!is_closed(nearest)) return report_open();
    warn_of_range(nearest);
    return true;
  }

  /// From a dead point, such as bars that all lie on one line, no step leads anywhere, and from others out of range:
  /// from positions beside, the same ones on every machine. Coordinates in `given` start as they are, those in `held`
  /// stay.
  bool find_beside(const Configuration& initial, const Entries& given, const Entries& held) {
    constexpr int kTries = 4;  // at each distance
    support::Uniform uniform(4201);
    const std::vector<bool> moving = all_but(independent_, given);
    if (std::count(moving.begin(), moving.end(), true) == 0) return false;
    const model::Loop& open = most_open().first;
    const bool is_out = is_closed(start_.configuration);
    for (const double distance : {0.2, 0.6, 1.5})  // in units
      for (int i = 0; i < kTries; ++i) {
        Vector by = Vector::Zero(at(moving.size()));
        for (std::size_t k = 0; k < moving.size(); ++k)
          if (moving[k]) by[at(k)] = closure_.units().velocities[k] * uniform(-distance, distance);
        const Configuration found =
            closure_.assembled(closure_.displaced(initial, by), all_but(independent_, held));
        if (!is_start(found)) continue;
        start_.configuration = found;
        start_.is_beside = true;
        report_beside(open, is_out);
        return true;
      }
    return false;
  }

  void report_beside(const model::Loop& loop, bool is_out) {
    diagnostics_.warning(
        loop.where,
        fmt::format(
            "from the initial positions no step closes the loops{}: they are closed from others beside "
            "them",
            is_out ? " within the ranges" : ""),
        "there may be several ways to close them: for another one, give joints positions that are near to "
        "it");
  }

  void warn_of_range(const Configuration& config) {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c) {
        const model::Coordinate& coordinate = mechanism_.joints[j].coordinates[c];
        const auto entry = layout_.joints[j].position[c];
        if (!coordinate.range || !entry) continue;
        const auto value = static_cast<double>(config.y[at(*entry)]);
        if (value < (*coordinate.range)[0] || value > (*coordinate.range)[1])
          diagnostics_.warning(
              mechanism_.joints[j].where,
              fmt::format("the loops close with '{}' at {:.4g}, outside its range from {:g} to {:g}",
                          shown(layout_.position_names[*entry]), value, (*coordinate.range)[0],
                          (*coordinate.range)[1]),
              "give positions that are nearer to what is meant");
      }
  }

  /// Whose row is the worst, and that row.
  std::pair<const model::Loop&, Eigen::Index> most_open() const {
    Eigen::Index worst = 0;
    closure_.value(start_.configuration).cwiseAbs().maxCoeff(&worst);
    return {model::loop_of_row(mechanism_, static_cast<std::size_t>(worst)), worst};
  }

  bool report_open() {
    const auto [loop, worst] = most_open();
    const long double residual = std::abs(closure_.value(start_.configuration)[worst]);
    diagnostics_.error(loop.where, fmt::format("{} cannot be closed from the initial values", in_words(loop)),
                       fmt::format("the nearest configuration found leaves constraint {} open by {:.3g}{}",
                                   row_name(worst), static_cast<double>(residual), as_given(independent_)));
    return false;
  }

  /// Whether no axes point against each other.
  bool report_reversed() {
    const std::vector<std::size_t> reversed = closure_.reversed(start_.configuration);
    for (const std::size_t loop : reversed)
      diagnostics_.error(
          mechanism_.loops[loop].where,
          fmt::format("{} closes with its axes against each other", in_words(mechanism_.loops[loop])),
          "turn 'to_axis' round, or start nearer to the configuration that is meant");
    return reversed.empty();
  }

  /// ġ at these velocities.
  Vector opening(const Vector& z) const { return closure_.opening_rate(start_.configuration, z); }

  bool agrees(const Vector& z) const {
    return opening(z).lpNorm<Eigen::Infinity>() <= kAgrees * (1 + z.lpNorm<Eigen::Infinity>());
  }

  /// The velocities nearest to the initial ones that agree with the loops, `held` and `held_` as they are;
  /// where there are none, those that open the loops least.
  Vector nearest(const Entries& held) const {
    return closure_.consistent(start_.configuration, initial_.z, all_but(held_, held));
  }

  /// Independent velocities that the description does not give yield to those that it gives.
  bool find_velocities() {
    held_ = independent_;
    start_.z = nearest({});
    if (!agrees(start_.z)) return report_opening();
    Entries all, moving;
    for (std::size_t k = 0; k < given_.velocity.size(); ++k) {
      if (!given_.velocity[k].is_given()) continue;
      all.push_back(k);
      if (initial_.z[at(k)] != 0) moving.push_back(k);
    }
    if (keeps_given(all, moving)) return true;
    std::erase_if(held_, [&](std::size_t k) { return !given_.velocity[k].is_given(); });
    if (keeps_given(all, moving)) return true;
    return plan_ ? keep_what_agrees(all) : report_conflict(moving);
  }

  /// Those that follow parameters first, zeros last.
  bool keep_what_agrees(Entries all) {
    const auto rank = [&](std::size_t k) {
      return std::pair(initial_.z[at(k)] == 0, !given_.velocity[k].follows);
    };
    std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    Entries held;
    for (const std::size_t k : all) add_where_it_agrees(held, k);
    return keeps(held);
  }

  bool keeps_given(const Entries& all, Entries moving) {
    if (keeps(all) || keeps_rounded(all)) return true;
    if (!keeps(moving)) return keeps_rounded(moving);
    for (const std::size_t k : all) add_where_it_agrees(moving, k);
    return keeps(moving);
  }

  bool keeps(const Entries& held) {
    const Vector z = nearest(held);
    if (agrees(z)) start_.z = z;
    return agrees(z);
  }

  /// Others move first, and what they cannot do is left to all.
  bool keeps_rounded(const Entries& held) {
    const Vector z = closure_.consistent(start_.configuration, nearest(held), all_but(held_, {}));
    long double change = 0;
    for (const std::size_t k : held) change = std::max(change, std::abs(z[at(k)] - initial_.z[at(k)]));
    const bool good = agrees(z) && change <= kRounded * z.lpNorm<Eigen::Infinity>();
    if (good) start_.z = z;
    return good;
  }

  void add_where_it_agrees(Entries& held, std::size_t entry) const {
    if (std::find(held.begin(), held.end(), entry) != held.end()) return;
    held.push_back(entry);
    if (!agrees(nearest(held))) held.pop_back();
  }

  bool report_opening() {
    Eigen::Index worst = 0;
    const long double rate = opening(start_.z).cwiseAbs().maxCoeff(&worst);
    const model::Loop& loop = model::loop_of_row(mechanism_, static_cast<std::size_t>(worst));
    diagnostics_.error(
        loop.where, fmt::format("no velocities agree with {} at the start", in_words(loop)),
        fmt::format("the best ones found open constraint {} at {:.3g}/s{}: start from another configuration",
                    row_name(worst), static_cast<double>(rate), as_given(independent_)));
    return false;
  }

  /// The first velocity in the file that does not agree with those before it.
  bool report_conflict(Entries given) {
    const auto place = [&](std::size_t k) {
      return std::pair(given_.velocity[k].where.line, given_.velocity[k].where.column);
    };
    std::stable_sort(given.begin(), given.end(),
                     [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    Entries held;
    for (const std::size_t k : given) {
      const std::size_t before = held.size();
      add_where_it_agrees(held, k);
      if (held.size() == before) {
        report_conflict(k, held);
        return false;
      }
    }
    return false;
  }

  void report_conflict(std::size_t entry, const Entries& held) {
    const Vector z = nearest(held);
    const long double fastest = std::max(z.lpNorm<Eigen::Infinity>(), std::abs(initial_.z[at(entry)]));
    const bool rests = std::abs(z[at(entry)]) <= kAgrees * fastest;
    const double possible = rests ? 0 : static_cast<double>(z[at(entry)]);
    Entries with = held_;
    for (const std::size_t k : needed(entry, held)) with.push_back(k);
    diagnostics_.error(given_.velocity[entry].where,
                       fmt::format("'{}' cannot start with {:.10g}", shown(layout_.velocity_names[entry]),
                                   static_cast<double>(initial_.z[at(entry)])),
                       fmt::format("{}the loops leave it {:.10g}: write that, or leave one velocity out",
                                   with.empty() ? "" : as_given(with).substr(1) + " ", possible));
  }

  /// Those of `held` that `entry` conflicts with.
  Entries needed(std::size_t entry, Entries held) const {
    for (std::size_t i = held.size(); i-- > 0;) {
      Entries fewer = held;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      Entries tried = fewer;
      tried.push_back(entry);
      if (!agrees(nearest(tried))) held = fewer;
    }
    return held;
  }

  std::string row_name(Eigen::Index row) const {
    return row_names(mechanism_)[static_cast<std::size_t>(row)];
  }

  /// What may not move, as the end of a phrase.
  std::string as_given(const Entries& entries) const {
    std::vector<std::string> names;
    for (const std::size_t k : entries) names.push_back(shown(layout_.velocity_names[k]));
    return names.empty() ? "" : fmt::format(" with {} as given", fmt::join(names, ", "));
  }

  /// What has not moved.
  std::vector<bool> record(const Vector& before, const Vector& after, const std::vector<std::string>& names,
                           bool velocity) {
    constexpr long double kNoticeable = 1e-12L;
    std::vector<bool> kept;
    for (std::size_t i = 0; i < names.size(); ++i) {
      kept.push_back(!(std::abs(after[at(i)] - before[at(i)]) > kNoticeable));
      if (!kept.back())
        start_.moved.push_back(
            {names[i], static_cast<double>(before[at(i)]), static_cast<double>(after[at(i)]), velocity});
    }
    return kept;
  }

  const model::Mechanism& mechanism_;
  const NumericClosure& closure_;
  const Entries& independent_;
  const LoopPlan* plan_;  ///< at other values of the parameters; null: this is the first start
  Entries held_;          ///< independent velocities that stay
  support::Diagnostics& diagnostics_;
  model::CoordinateLayout layout_;
  GivenValues given_;
  reference::State<long double> initial_;
  Start start_;
};

}  // namespace

std::optional<Start> find_start(const model::Mechanism& mechanism, const NumericClosure& closure,
                                const std::vector<std::size_t>& independent,
                                support::Diagnostics& diagnostics) {
  return StartSearch(mechanism, closure, independent, nullptr, diagnostics).find();
}

std::optional<Start> find_start_again(const model::Mechanism& mechanism, const NumericClosure& closure,
                                      const std::vector<std::size_t>& independent, const LoopPlan& plan,
                                      support::Diagnostics& diagnostics) {
  return StartSearch(mechanism, closure, independent, &plan, diagnostics).find();
}

void take_start(const Start& start, LoopPlan& plan) {
  plan.moved = start.moved;
  plan.starts_beside = start.is_beside;
  plan.kept_y = start.kept_y;
  plan.kept_z = start.kept_z;
  for (const long double entry : start.configuration.y) plan.y.push_back(static_cast<double>(entry));
  for (const long double entry : start.z) plan.z.push_back(static_cast<double>(entry));
}

}  // namespace jourdain::loops
