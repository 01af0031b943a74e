#include "validate/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/check.hpp"

namespace jourdain::validate {

namespace {

/// Of the largest scale among numbers that are computed together: numbers that symbolic algebra left as
/// rounding of zero have no scale of their own.
constexpr long double kNothing = 1e-30L;

/// Numbers at a state that are all smaller than this share of those at other states are zero, but for
/// constants that cancel in 63 digits.
constexpr long double kResidue = 1e-60L;

/// How much more than the largest scale of the oracle's numbers rounding may count by where the program's own
/// way to one is less stable than the oracle's: multipliers of rows that are all but redundant.
constexpr long double kLessStable = 1e4L;

/// Less than what doubles have all their digits for: constants of that size are rounded to few.
bool is_below_doubles(const ScaledReal& number) {
  return static_cast<long double>(abs(number)) < std::numeric_limits<double>::min();
}

/// |a − b| over the larger scale; 0 where both are no numbers or below doubles, infinite where one is none. Over the
/// larger number, which is less, where these leave the range of double or nothing bounds the rounding: a root of zero.
double apart(const ScaledReal& a, const ScaledReal& b, long double floor) {
  if (a.is_number() != b.is_number()) return INFINITY;
  if (!a.is_number() || a == b || (is_below_doubles(a) && is_below_doubles(b))) return 0;
  const long double scale = std::max({a.scale(), b.scale(), floor});
  const auto difference = static_cast<long double>(abs(a - b));
  if (std::isinf(difference) || std::isinf(scale))
    return static_cast<double>(abs(a - b) / (abs(a) > abs(b) ? abs(a) : abs(b)));
  return scale > 0 ? static_cast<double>(difference / scale) : INFINITY;
}

/// Of numbers that are computed together.
long double largest_scale(const std::vector<ScaledReal>& numbers) {
  long double largest = 0;
  for (const ScaledReal& number : numbers)
    if (isfinite(number)) largest = std::max(largest, number.scale());
  return largest;
}

}  // namespace

Compared& Agreement::record(const std::string& function, const std::string& oracle) {
  const auto known = std::find_if(compared_.begin(), compared_.end(), [&](const Compared& c) {
    return c.function == function && c.oracle == oracle;
  });
  if (known != compared_.end()) return *known;
  compared_.push_back({function, oracle});
  return compared_.back();
}

void Agreement::fail(const std::string& sentence) {
  if (std::find(failures_.begin(), failures_.end(), sentence) == failures_.end())
    failures_.push_back(sentence);
}

bool Agreement::agree(const std::vector<ScaledReal>& values, const std::vector<ScaledReal>& expected) {
  const long double floor = kNothing * std::max(largest_scale(values), largest_scale(expected));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(apart(values[i], expected[i], floor) <= static_cast<double>(kAlgebra))) return false;
  return true;
}

void Agreement::same(const std::string& function, const std::string& oracle,
                     const std::vector<ScaledReal>& values, const std::vector<ScaledReal>& expected,
                     long double allowed) {
  JD_CHECK(values.size() == expected.size(), "{}: {} numbers for {}", function, values.size(),
           expected.size());
  Compared& c = record(function, oracle);
  ++c.states;
  c.numbers += values.size();
  std::size_t worst = 0;
  double most = 0;
  const long double scales[] = {largest_scale(values), largest_scale(expected)};
  const long double larger = std::max(scales[0], scales[1]);
  c.scale = std::max(c.scale, larger);
  const long double floor =
      kNothing * (std::min(scales[0], scales[1]) > kResidue * c.scale ? larger : c.scale);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const double d = apart(values[i], expected[i], floor); d > most) {
      most = d;
      worst = i;
    }
  c.algebra = std::max(c.algebra, most);
  if (most <= static_cast<double>(allowed)) return;
  fail(fmt::format("{} is not {}: number {} is {:.6g} instead of {:.6g}, off by {:.1g} of its scale",
                   function, oracle, worst + 1, static_cast<double>(values[worst]),
                   static_cast<double>(expected[worst]), most));
}

void Agreement::overflow(const std::string& sentence) {
  const std::size_t before = failures_.size();
  fail(sentence);
  overflows_ += failures_.size() - before;
}

void Agreement::rounded(const std::string& function, const std::string& oracle,
                        const std::vector<ScaledReal>& values, const std::vector<ScaledReal>& exact,
                        const std::vector<ScaledReal>& expected, std::size_t depth) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;
  const double limit = kRoundingSlack * static_cast<double>(1 + depth) * kUnit;
  Compared& c = record(function, oracle);
  const long double here = largest_scale(expected);
  const long double largest = here > kResidue * c.scale ? here : c.scale;
  // What rounding does to second order where it does nothing to first: a product of two zeros.
  const long double floor = std::max<long double>(kUnit * largest, std::numeric_limits<double>::min());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!exact[i].is_number() && !values[i].is_number()) continue;
    const bool overflows = !std::isfinite(static_cast<double>(exact[i]));
    if (overflows && !std::isfinite(static_cast<double>(values[i]))) continue;
    const long double own = std::min(exact[i].scale(), kLessStable * largest);
    const long double scale = std::max({expected[i].scale(), own, floor});
    const auto difference = static_cast<long double>(abs(values[i] - exact[i]));
    const double error =
        values[i].is_number() == exact[i].is_number() ? static_cast<double>(difference / scale) : INFINITY;
    c.rounding = std::max(c.rounding, error);
    if (!(error <= limit) && exact[i].is_number() && !std::isfinite(static_cast<double>(values[i])))
      overflow(fmt::format("{} leaves the range of double on the way to number {}, which is {:.6g}", function,
                           i + 1, static_cast<double>(exact[i])));
    else if (!(error <= limit))
      fail(fmt::format("{} loses its digits in double: number {} is {:.6g} instead of {:.6g}", function,
                       i + 1, static_cast<double>(values[i]), static_cast<double>(exact[i])));
  }
}

std::size_t depth(const ir::Program& program) {
  std::vector<std::size_t> depths(program.nodes.size(), 0);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const ir::Node& node = program.nodes[i];
    const int operands = ir::operand_count(node.op);
    if (operands >= 1) depths[i] = 1 + depths[node.a.value];
    if (operands == 2) depths[i] = std::max(depths[i], 1 + depths[node.b.value]);
  }
  std::size_t deepest = 0;
  for (const ir::Output& output : program.outputs) deepest = std::max(deepest, depths[output.value.value]);
  return deepest;
}

}  // namespace jourdain::validate
