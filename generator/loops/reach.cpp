#include "loops/reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "loops/positivity.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::Interval;
using ir::LeafKind;
using ir::Node;
using ir::Op;
using ir::Program;

namespace {

constexpr double kPi = std::numbers::pi;
/// sin² of 1e-3 rad from a dead position. Linkages that reach one, but for rounding, come closer.
constexpr double kLeastMargin = 1e-6;
/// Divisors have no size of their own: they must not vanish.
constexpr double kLeastDivisor = 0;

class Reach {
 public:
  explicit Reach(const ReachRequest& request) : request_(request) {
    ir::Builder builder = request.builder;
    for (const Requirement& requirement : request.requirements)
      builder.output("f", -1, -1, requirement.value);
    program_ = passes::remove_dead_code(builder.finish("requirements"));
  }

  std::variant<double, std::string> run() {
    if (const std::string failure = lay_out(); !failure.empty()) return failure;
    if (ir::count_operations(program_).atan2 > 0) return "its discriminant has an arctangent, which jumps";
    std::vector<Bound> bounds;
    for (const Requirement& requirement : request_.requirements)
      bounds.push_back({requirement.value, requirement.is_margin ? kLeastMargin : kLeastDivisor});
    const auto proof = prove_bounds(request_.builder, bounds, region_);
    if (const auto* counterexample = std::get_if<Counterexample>(&proof)) return text(*counterexample);
    double smallest = 1;
    for (std::size_t j = 0; j < bounds.size(); ++j)
      if (request_.requirements[j].is_margin)
        smallest = std::min(smallest, std::get<std::vector<double>>(proof)[j]);
    return smallest;
  }

 private:
  /// Intervals of the leaves that matter. Otherwise which one has none.
  std::string lay_out() {
    for (const double value : request_.parameters)
      region_.leaves[LeafKind::kParameter].push_back(Interval::point(value));
    region_.leaves[LeafKind::kPosition].resize(request_.names.size());
    region_.leaves[LeafKind::kTime] = {Interval::line()};
    for (const Node& node : program_.nodes) {
      if (node.op != Op::kLeaf || node.leaf == LeafKind::kParameter) continue;
      if (node.leaf != LeafKind::kPosition) return "its discriminant depends on time";
      const std::size_t k = node.index;
      if (std::find(request_.dependents.begin(), request_.dependents.end(), k) != request_.dependents.end())
        return fmt::format("its discriminant depends on the whole turns of {}", request_.names[k]);
      if (!request_.range[k] && !(request_.angular[k] && is_periodic(k)))
        return fmt::format("its discriminant depends on {}, which has no range", request_.names[k]);
      region_.entries.push_back(k);
      region_.leaves[LeafKind::kPosition][k] =
          request_.range[k] ? Interval{(*request_.range[k])[0], (*request_.range[k])[1]} : circle();
    }
    std::sort(region_.entries.begin(), region_.entries.end());
    return "";
  }

  static Interval circle() { return {-kPi - 1e-9, kPi + 1e-9}; }

  /// Is a position used in sums under sines and cosines alone, so that a whole turn of it changes nothing?
  bool is_periodic(std::size_t entry) const {
    std::vector<bool> turns(program_.nodes.size(), false);
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) {
      const Node& node = program_.nodes[i];
      const int operands = ir::operand_count(node.op);
      const bool operand_turns =
          (operands >= 1 && turns[node.a.value]) || (operands == 2 && turns[node.b.value]);
      const bool is_sum = node.op == Op::kAdd || node.op == Op::kSubtract || node.op == Op::kNegate;
      turns[i] = (operand_turns && is_sum) ||
                 (node.op == Op::kLeaf && node.leaf == LeafKind::kPosition && node.index == entry);
      if (operand_turns && !is_sum && node.op != Op::kSin && node.op != Op::kCos) return false;
    }
    return std::none_of(program_.outputs.begin(), program_.outputs.end(),
                        [&](const ir::Output& output) { return turns[output.value.value]; });
  }

  std::string text(const Counterexample& found) const {
    const Requirement& requirement = request_.requirements[found.bound];
    std::string region, point;
    for (std::size_t i = 0; i < region_.entries.size(); ++i) {
      const std::size_t k = region_.entries[i];
      const char* separator = i == 0 ? "" : ", ";
      const auto& range = request_.range[k];
      region += fmt::format("{}{} in {}", separator, request_.names[k],
                            range ? fmt::format("[{}, {}]", (*range)[0], (*range)[1]) : "[-pi, pi]");
      point += fmt::format("{}{} = {:.4g}", separator, request_.names[k], found.position[i]);
    }
    std::string message =
        fmt::format("{} of {} not proven positive", requirement.is_margin ? "discriminant" : "divisor",
                    requirement.dependents);
    if (!region.empty())
      message += fmt::format(" over {}: it {} {}", region,
                             found.violated ? "vanishes or is negative at" : "is not decided near", point);
    return message;
  }

  const ReachRequest& request_;
  Program program_;
  Region region_;
};

}  // namespace

std::variant<double, std::string> smallest_margin(const ReachRequest& request) {
  return Reach(request).run();
}

}  // namespace jourdain::loops
