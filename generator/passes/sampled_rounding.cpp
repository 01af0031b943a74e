#include "passes/sampled_rounding.hpp"

#include <algorithm>
#include <cmath>

#include "ir/fixed_values.hpp"
#include "ir/scramble.hpp"
#include "support/function_derivatives.hpp"

namespace jourdain::passes {

using ir::LeafKind;
using ir::Node;
using ir::Op;

namespace {

/// Samples before it are of ordinary sizes (the first three of special states), others of all sizes.
constexpr std::size_t kAllSizes = 14;
constexpr double kNearHome = 1e-4;  // of positions, in the second

/// So much further may a value be moved. Sums in another order are, seldom more.
constexpr double kMostLost = 2;
/// Between two ways to round the same.
constexpr double kSlack = 1e-6;
/// Apart from rounding two ways to the same value differ by nothing; in units of what a relative error of 1 moves.
constexpr double kSameValue = 1e-6;

bool is_float(double value) { return static_cast<double>(static_cast<float>(value)) == value; }

/// 10^x by multiplications: the same on every machine.
double power_of_ten(int exponent) {
  double result = 1;
  for (; exponent > 0; --exponent) result *= 10;
  for (; exponent < 0; ++exponent) result /= 10;
  return result;
}

}  // namespace

double SampledRounding::sampled(const Node& leaf, std::size_t sample) {
  const std::uint64_t bits = ir::scrambled(ir::seed_of_leaf(leaf), sample), more = ir::scrambled(bits, 1);
  const double sign = more % 2 == 0 ? 1 : -1, size = 0.5 + ir::unit_of(bits), unit = ir::unit_of(more);
  const bool is_position = leaf.leaf == LeafKind::kPosition;
  if (ir::is_made_with_the_model(leaf.leaf)) {
    if (sample == 2) return unit < 0.3 ? 0 : size;
    return sample < kAllSizes ? size : size * power_of_ten(static_cast<int>(more / 2 % 13) - 6);
  }
  if (sample == 0) return 0;
  if (sample == 1 && is_position) return sign * size * kNearHome;
  if (sample < kAllSizes) return sign * size * (is_position ? 2 : 1);
  return sign * size * power_of_ten(static_cast<int>(more / 2 % 7) - 3);
}

SampledRounding::Estimate SampledRounding::number(double value, bool is_rounded) {
  return {value, is_rounded || !is_float(value) ? std::fabs(value) : 0};
}

/// An operation with these partial derivatives.
SampledRounding::Estimate SampledRounding::result(double value, Estimate a, double by_a, Estimate b,
                                                  double by_b) {
  const double from_a = a.moved == 0 ? 0 : a.moved * std::fabs(by_a),
               from_b = b.moved == 0 ? 0 : b.moved * std::fabs(by_b);
  const double all = from_a + from_b + value;  // no number, or infinite, where one of them is
  return {value, std::isfinite(all) ? std::max({std::fabs(value), from_a, from_b}) : NAN};
}

SampledRounding::Estimate SampledRounding::sum(Estimate a, Estimate b) {
  return result(a.value + b.value, a, 1, b, 1);
}

SampledRounding::Estimate SampledRounding::product(Estimate a, Estimate b) {
  return result(a.value * b.value, a, b.value, b, a.value);
}

SampledRounding::Estimate SampledRounding::evaluated(const Node& node, Estimate a, Estimate b,
                                                     std::size_t sample) {
  switch (node.op) {
    case Op::kLiteral:
      return number(node.literal, node.tail[0] != 0);
    case Op::kLeaf: {
      const double value = sampled(node, sample);
      return {value, node.leaf == LeafKind::kConstant ? std::fabs(value) : 0};
    }
    case Op::kNegate:
      return {-a.value, a.moved};
    case Op::kAdd:
      return sum(a, b);
    case Op::kSubtract:
      return result(a.value - b.value, a, 1, b, 1);
    case Op::kMultiply:
      return product(a, b);
    case Op::kDivide:
      return result(a.value / b.value, a, 1 / b.value, b, a.value / b.value / b.value);
    case Op::kSqrt: {  // of the size: what is equal stays so, and few samples are lost
      const double root = std::sqrt(std::fabs(a.value));
      return result(root, a, 0.5 / root, {}, 0);
    }
    case Op::kSin:
      return result(std::sin(a.value), a, std::cos(a.value), {}, 0);
    case Op::kCos:
      return result(std::cos(a.value), a, std::sin(a.value), {}, 0);
    default:
      return of_function(ir::function_of(node.op), a, b);
  }
}

SampledRounding::Estimate SampledRounding::of_function(support::Function function, Estimate a, Estimate b) {
  using support::Function;
  // Of the size, as roots: then few samples are lost.
  const bool is_of_size = function == Function::kLog || function == Function::kPower;
  const double x = is_of_size ? std::fabs(a.value) : a.value, value = support::value_of(function, x, b.value);
  const support::FunctionFacts& facts = support::facts_of(function);
  if (facts.has_kinks) return result(value, a, 1, b, 1);
  if (facts.operands == 1) return result(value, a, support::curve_of(function, x, 1.0).slope, {}, 0);
  const auto surface = support::surface_of(function, x, b.value, 1.0);
  return result(value, a, surface.by_a, b, surface.by_b);
}

SampledRounding::SampledRounding(const ir::Program& program) : program_(program) {
  for (const Node& node : program.nodes)
    for (std::size_t k = 0; k < kSamples; ++k) {
      const Estimate& estimate = estimates_.emplace_back(own(node, k));
      limits_.push_back(kMostLost * estimate.moved);
    }
}

SampledRounding::Estimate SampledRounding::own(const Node& node, std::size_t sample) const {
  const int operands = ir::operand_count(node.op);
  return evaluated(node, operands >= 1 ? at(node.a, sample) : Estimate(),
                   operands == 2 ? at(node.b, sample) : Estimate(), sample);
}

SampledRounding::Estimate SampledRounding::defined(const Node& node, const Definition& definition,
                                                   std::size_t sample) const {
  const auto operand = [&](ir::Signed value) { return at(value, sample); };
  const auto constant = [](const cln::cl_R& value) {
    const double nearest = support::nearest_double(value);
    return number(nearest, support::to_exact(nearest) != value);
  };
  switch (definition.kind) {
    case Definition::Kind::kSum:
      return sum(operand(definition.x), operand(definition.y));
    case Definition::Kind::kProduct:
      return product(operand(definition.x), operand(definition.y));
    case Definition::Kind::kLine: {
      Estimate line = operand(definition.x);
      if (definition.is_scaled) line = product(constant(definition.factor), line);
      return definition.is_shifted ? sum(line, constant(definition.offset)) : line;
    }
    case Definition::Kind::kNumber:
      return constant(definition.offset);
    case Definition::Kind::kOwn:
      break;
  }
  return own(node, sample);
}

SampledRounding::Estimate SampledRounding::defined(Op op, const Association& association,
                                                   std::size_t sample) const {
  std::vector<Estimate> places;
  for (const ir::Signed& term : association.terms) places.push_back(at(term, sample));
  for (const auto& [a, b] : association.steps)
    places.push_back(op == Op::kAdd ? sum(places[a], places[b]) : product(places[a], places[b]));
  return places.back();
}

template <class Defined>
bool SampledRounding::admits_values(ir::ValueId id, const Defined& defined) const {
  std::size_t compared = 0;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const double limit = limits_[id.value * kSamples + k];
    if (!std::isfinite(limit)) continue;
    ++compared;
    const Estimate other = defined(k);
    if (!(other.moved <= limit * (1 + kSlack))) return false;
    if (!(std::fabs(other.value - at(id, k).value) <= kSameValue * limit)) return false;
  }
  return compared >= kSamples / 2;
}

bool SampledRounding::admits(ir::ValueId id, const Definition& definition) const {
  return admits_values(id, [&](std::size_t k) { return defined(program_[id], definition, k); });
}

bool SampledRounding::admits(ir::ValueId id, Op op, const Association& association) const {
  return admits_values(id, [&](std::size_t k) { return defined(op, association, k); });
}

void SampledRounding::follow(ir::ValueId id, const Definition& definition) {
  for (std::size_t k = 0; k < kSamples; ++k)
    estimates_[id.value * kSamples + k] = defined(program_[id], definition, k);
}

void SampledRounding::follow(ir::ValueId id, Op op, const Association& association) {
  for (std::size_t k = 0; k < kSamples; ++k)
    estimates_[id.value * kSamples + k] = defined(op, association, k);
}

}  // namespace jourdain::passes
