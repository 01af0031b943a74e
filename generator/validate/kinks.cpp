#include "validate/kinks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "validate/programs.hpp"

namespace jourdain::validate {

using ir::Op;
using ir::ValueId;

namespace {

/// Of its scale: nearer to a kink than this rounding in double may choose the side, rounding in float surely.
constexpr double kNear = 1e-9;

ValueId appended(ir::Program& program, const ir::Node& node) {
  program.nodes.push_back(node);
  program.labels.emplace_back();
  return ValueId(program.nodes.size() - 1);
}

bool is_whole(double value) { return value == std::floor(value); }

/// Which values are whole numbers for all arguments: sums of whole numbers are, and what is chosen among them.
std::vector<bool> whole_values(const ir::Program& program) {
  std::vector<bool> whole;
  for (const ir::Node& node : program.nodes) {
    const auto all_entries = [&] {
      const auto& values = support::array_of(static_cast<std::uint32_t>(program[node.b].literal));
      return std::all_of(values.begin(), values.end(), [](double value) { return is_whole(value); });
    };
    const bool is_sum = node.op == Op::kAdd || node.op == Op::kSubtract;
    const bool selects = node.op == Op::kWhereNegative || node.op == Op::kWhereNotNegative;
    whole.push_back((node.op == Op::kLiteral && is_whole(node.literal)) || node.op == Op::kFloor ||
                    (node.op == Op::kEntry && all_entries()) ||
                    (node.op == Op::kNegate && whole[node.a.value]) || (selects && whole[node.b.value]) ||
                    (is_sum && whole[node.a.value] && whole[node.b.value]));
  }
  return whole;
}

/// An entry of an array goes over to the next one where its place does, unless that is a whole number already.
bool has_kink(const ir::Node& node, const std::vector<bool>& whole) {
  return ir::is_selection(node.op) && !(node.op == Op::kEntry && whole[node.a.value]);
}

/// How far an operand is beyond the kink of node `i`; of floor and of entries, the sine of π times that.
ValueId distance(ir::Program& program, std::size_t i) {
  const ir::Node node = program.nodes[i];
  if (node.op == Op::kMin || node.op == Op::kMax)
    return appended(program, {.op = Op::kSubtract, .a = node.a, .b = node.b});
  if (node.op != Op::kFloor && node.op != Op::kEntry) return node.a;
  const ValueId pi = appended(program, {.op = Op::kLiteral, .literal = 3.141592653589793});
  const ValueId angle = appended(program, {.op = Op::kMultiply, .a = pi, .b = node.a});
  return appended(program, {.op = Op::kSin, .a = angle});
}

bool is_near_zero(const ScaledReal& distance) {
  return std::fabs(static_cast<long double>(distance)) <= kNear * distance.scale();
}

}  // namespace

std::string in_words(const Kinks& kinks) {
  std::string text = fmt::format("{} kink{} of abs, min, max, floor and if, {} compared on both sides",
                                 kinks.count, kinks.count == 1 ? "" : "s", kinks.on_both_sides);
  if (std::isfinite(kinks.nearest))
    text += fmt::format(", the nearest {:.0e} of its scale away", kinks.nearest);
  if (kinks.on > 0)
    text += fmt::format("; derivatives were not compared at {} state{} on one", kinks.on,
                        kinks.on == 1 ? "" : "s");
  if (kinks.left_out > 0) text += fmt::format("; {} states too near to one were left out", kinks.left_out);
  return text;
}

KinkSurvey::KinkSurvey(const ir::Module& module)
    : constants_(module.constants), nearest_(std::numeric_limits<double>::infinity()) {
  for (ir::Program program : module.functions) {
    has_derivatives_ = has_derivatives_ || is_derivative(program);
    program.outputs.clear();
    const std::size_t count = program.nodes.size();
    const std::vector<bool> whole = whole_values(program);
    for (std::size_t i = 0; i < count; ++i)
      if (has_kink(program.nodes[i], whole))
        program.outputs.push_back({"distance", -1, -1, distance(program, i)});
    seen_.resize(seen_.size() + program.outputs.size());
    if (!program.outputs.empty()) programs_.push_back(std::move(program));
  }
}

KinkSurvey::Look KinkSurvey::look(ir::LeafValues<ScaledReal> leaves) const {
  Look look;
  if (seen_.empty()) return look;
  leaves[ir::LeafKind::kConstant] = ir::interpret(constants_, leaves);
  for (const ir::Program& program : programs_)
    for (const ScaledReal& value : ir::interpret(program, leaves)) look.distances.push_back(value);
  const ScaledReal zero;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].is_stuck) continue;
    const ScaledReal& d = look.distances[i];
    look.is_near = look.is_near || (d != zero && is_near_zero(d));
    look.is_on = look.is_on || d == zero;
    look.is_new = look.is_new || (d < zero && !seen_[i].below) || (d > zero && !seen_[i].above);
  }
  return look;
}

void KinkSurvey::disregard_stuck(const std::vector<Look>& looks) {
  const ScaledReal zero;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    seen_[i].is_stuck = std::all_of(looks.begin(), looks.end(),
                                    [i](const Look& look) { return is_near_zero(look.distances[i]); });
    seen_[i].is_close = seen_[i].is_stuck && std::any_of(looks.begin(), looks.end(), [&](const Look& look) {
                          return look.distances[i] != zero;
                        });
  }
}

void KinkSurvey::take(const Look& look) {
  if (look.is_near) {
    ++left_out_;
    return;
  }
  if (look.is_on && has_derivatives_) ++on_;
  const ScaledReal zero;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const ScaledReal& d = look.distances[i];
    seen_[i].distances.push_back(static_cast<double>(d));
    seen_[i].below = seen_[i].below || d < zero;
    seen_[i].above = seen_[i].above || d > zero;
    const auto share = static_cast<double>(std::fabs(static_cast<long double>(d)) / d.scale());
    if (share > 0) nearest_ = std::min(nearest_, share);
  }
}

bool KinkSurvey::is_complete() const {
  return std::all_of(seen_.begin(), seen_.end(),
                     [](const Seen& kink) { return kink.is_stuck || (kink.below && kink.above); });
}

/// A kink that several functions have is one: their distances are the same at all states.
Kinks KinkSurvey::kinks() const {
  std::map<std::vector<double>, bool> distinct;
  for (const Seen& kink : seen_) {
    std::vector<double> sizes;
    for (const double d : kink.distances) sizes.push_back(std::fabs(d));
    distinct[sizes] = kink.below && kink.above && !kink.is_stuck;
  }
  const auto stuck =
      std::count_if(seen_.begin(), seen_.end(), [](const Seen& kink) { return kink.is_close; });
  Kinks kinks{distinct.size(), 0, nearest_, left_out_, static_cast<std::size_t>(stuck), on_};
  for (const auto& [sizes, both] : distinct) kinks.on_both_sides += both ? 1 : 0;
  return kinks;
}

}  // namespace jourdain::validate
