#include "loops/closed_form/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "loops/intervals/positivity.hpp"
#include "loops/rows/timeless.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::LeafKind;
using ir::Node;
using ir::Op;
using ir::Program;
using support::Interval;

namespace {

constexpr double kPi = std::numbers::pi;
/// sin² of 1e-3 rad from a dead position. Linkages that reach one, but for rounding, come closer.
constexpr double kLeastMargin = 1e-6;
/// Divisors have no size of their own: they must not vanish.
constexpr double kLeastDivisor = 0;

class Reach {
 public:
  explicit Reach(const ReachRequest& request)
      : request_(request), names_(request.names), angular_(request.angular), range_(request.range) {
    ir::Builder builder = request.builder;
    for (const Requirement& requirement : request.requirements)
      builder.output("f", -1, -1, requirement.value);
    const Program program = without_time(builder.finish("requirements"));
    program_ = passes::remove_dead_code(program);
  }

  std::variant<Reached, std::string> run(Effort effort) {
    if (std::string failure = lay_out(); !failure.empty()) return failure;
    if (ir::count_operations(program_).atan2 > 0)
      return fmt::format("its {} has an arctangent, which jumps", request_.margin);
    std::vector<Bound> bounds;
    for (const Requirement& requirement : request_.requirements)
      bounds.push_back({values_[bounds.size()], requirement.is_margin ? kLeastMargin : kLeastDivisor});
    const auto proof = prove_bounds(builder_, bounds, region_, effort);
    if (const auto* counterexample = std::get_if<Counterexample>(&proof)) return text(*counterexample);
    Reached result;
    for (std::size_t j = 0; j < bounds.size(); ++j)
      if (request_.requirements[j].is_margin)
        result.margin = std::min(result.margin, std::get<std::vector<double>>(proof)[j]);
    for (const auto& [kind, k] : region_.entries)
      if (kind == LeafKind::kPosition && range_[k])
        result.positions.push_back({k, (*range_[k])[0], (*range_[k])[1]});
    return result;
  }

 private:
  /// Copies the requirements into `builder_`, driven angles as positions of their own.
  Program without_time(const Program& program) {
    Timeless timeless = without_clock(builder_, program, names_.size());
    values_ = std::move(timeless.values);
    names_.resize(names_.size() + timeless.driven.size(), "the driven angle");
    angular_.resize(names_.size(), true);
    range_.resize(names_.size());
    ir::Builder builder = builder_;
    for (const ir::Signed value : values_) builder.output("f", -1, -1, value);
    return builder.finish("requirements");
  }

  /// Intervals of the leaves that matter. Otherwise which one has none.
  std::string lay_out() {
    for (std::size_t k = 0; k < request_.parameters.size(); ++k)
      region_.leaves[LeafKind::kParameter].push_back(parameter(k));
    region_.leaves[LeafKind::kPosition].resize(names_.size());
    region_.leaves[LeafKind::kTime] = {Interval::line()};
    for (const Node& node : program_.nodes) {
      if (node.op != Op::kLeaf) continue;
      if (node.leaf == LeafKind::kParameter) {
        if (parameter(node.index).width() > 0) region_.entries.push_back({LeafKind::kParameter, node.index});
        continue;
      }
      if (node.leaf != LeafKind::kPosition) return fmt::format("its {} depends on time", request_.margin);
      const std::size_t k = node.index;
      if (std::find(request_.dependents.begin(), request_.dependents.end(), k) != request_.dependents.end())
        return fmt::format("its {} depends on the whole turns of {}", request_.margin, names_[k]);
      if (!range_[k] && !(angular_[k] && is_periodic(program_, k)))
        return fmt::format("its {} depends on {}, which has no range", request_.margin, names_[k]);
      region_.entries.push_back({LeafKind::kPosition, k});
      region_.leaves[LeafKind::kPosition][k] =
          range_[k] ? Interval{(*range_[k])[0], (*range_[k])[1]} : circle();
    }
    std::sort(region_.entries.begin(), region_.entries.end(), [](const Variable& a, const Variable& b) {
      return std::pair(a.kind != LeafKind::kPosition, a.index) <
             std::pair(b.kind != LeafKind::kPosition, b.index);
    });
    return "";
  }

  Interval parameter(std::size_t k) const {
    const bool varies = k < request_.parameter_range.size() && request_.parameter_range[k];
    if (!varies) return Interval::point(request_.parameters[k]);
    return {(*request_.parameter_range[k])[0], (*request_.parameter_range[k])[1]};
  }

  static Interval circle() { return {-kPi - 1e-9, kPi + 1e-9}; }

  std::string text(const Counterexample& found) const {
    const Requirement& requirement = request_.requirements[found.bound];
    std::string region, point;
    for (std::size_t i = 0; i < region_.entries.size(); ++i) {
      const auto [kind, k] = region_.entries[i];
      const bool is_position = kind == LeafKind::kPosition;
      const std::string& name = is_position ? names_[k] : request_.parameter_names[k];
      const char* separator = i == 0 ? "" : ", ";
      const auto& range = is_position ? range_[k] : request_.parameter_range[k];
      region += fmt::format("{}{} in {}", separator, name,
                            range ? fmt::format("[{}, {}]", (*range)[0], (*range)[1]) : "[-pi, pi]");
      point += fmt::format("{}{} = {:.4g}", separator, name, found.position[i]);
    }
    std::string message =
        fmt::format("{} of {} not proven positive", requirement.is_margin ? request_.margin : "divisor",
                    requirement.dependents);
    if (!region.empty())
      message += fmt::format(" over {}: it {} {}", region,
                             found.violated ? "vanishes or is negative at" : "is not decided near", point);
    return message;
  }

  const ReachRequest& request_;
  std::vector<std::string> names_;  ///< of positions, driven angles after them; so are the next two
  std::vector<bool> angular_;
  std::vector<std::optional<std::array<double, 2>>> range_;
  ir::Builder builder_;
  std::vector<ir::Signed> values_;  ///< the requirements
  Program program_;                 ///< of them
  Region region_;
};

}  // namespace

std::variant<Reached, std::string> smallest_margin(const ReachRequest& request, Effort effort) {
  return Reach(request).run(effort);
}

}  // namespace jourdain::loops
