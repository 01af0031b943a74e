#include "passes/equal_values.hpp"

#include <algorithm>
#include <cmath>

#include "support/binary_digits.hpp"

namespace jourdain::passes {

using ir::Signed;
using ir::ValueId;
using support::ScaledReal;

namespace {

/// What is near a value: its operands, theirs and so on to this depth, and values that read one of them.
constexpr int kDepth = 3;
/// Of the values that read one, so many just before the value in question.
constexpr std::ptrdiff_t kMostUsers = 32;
/// Lines of a value that are tried; copies of others are apart.
constexpr std::size_t kMostLines = 8;

/// Binary digits of a number, beyond which it is rounded: literals hold no more.
constexpr int kDigits = 212;
/// What cancels may take so much of the 77 digits away.
constexpr long double kMostLost = 1e10L;
constexpr long double kAgreement = 1e-60L;

std::vector<Residue> first_residues(const std::vector<Fingerprint>& fingerprints) {
  std::vector<Residue> keys;
  for (const Fingerprint& value : fingerprints) keys.push_back(value.at[0]);
  return keys;
}

/// The same for values of which each is another one times and plus numbers; 0 for numbers.
std::vector<Residue> line_keys(const std::vector<Fingerprint>& fingerprints) {
  std::vector<Residue> keys, differences;
  for (const Fingerprint& value : fingerprints) differences.push_back(value.at[0] - value.at[2]);
  const std::vector<Residue> quotients = inverses(std::move(differences));
  for (std::size_t i = 0; i < fingerprints.size(); ++i)
    keys.push_back((fingerprints[i].at[0] - fingerprints[i].at[1]) * quotients[i]);
  return keys;
}

bool is_number(const Fingerprint& value) {
  return std::all_of(value.at.begin(), value.at.end(), [&](Residue r) { return r == value.at[0]; });
}

std::vector<std::vector<std::size_t>> users(const ir::Program& program) {
  std::vector<std::vector<std::size_t>> list(program.nodes.size());
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const ir::Node& node = program.nodes[i];
    if (ir::operand_count(node.op) >= 1) list[node.a.value].push_back(i);
    if (ir::operand_count(node.op) == 2 && node.a != node.b) list[node.b.value].push_back(i);
  }
  return list;
}

/// A number from its 77 digits; none where too many of them are lost.
std::optional<cln::cl_R> number(const ScaledReal& value) {
  if (!isfinite(value)) return {};
  const long double size = std::fabs(static_cast<long double>(value));
  const bool is_known = value.scale() <= kMostLost * size && size > 1e-100L && size < 1e100L;
  if (value != ScaledReal(0) && !is_known) return {};
  return support::with_binary_digits(value.value(), kDigits);
}

}  // namespace

ResidueIndex::ResidueIndex(const std::vector<Residue>& keys) {
  constexpr std::size_t kBitsEach = 64;
  std::size_t bits = kBitsEach;
  while (bits < kBitsEach * keys.size()) bits *= 2;
  present_.resize(bits / 64);
  mask_ = bits - 1;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    sorted_.push_back({size_of(keys[i]), i});
    const std::uint64_t bit = size_of(keys[i]) & mask_;
    present_[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  std::sort(sorted_.begin(), sorted_.end());
}

std::span<const ResidueIndex::Entry> ResidueIndex::values_of(Residue key) const {
  const auto begin = std::lower_bound(sorted_.begin(), sorted_.end(), Entry{size_of(key), 0});
  auto end = begin;
  while (end != sorted_.end() && end->key == size_of(key)) ++end;
  return {begin, end};
}

EqualValues::EqualValues(const ir::Program& program, std::vector<Fingerprint> fingerprints)
    : program_(program),
      fingerprints_(std::move(fingerprints)),
      first_(first_residues(fingerprints_)),
      inverses_(inverses(first_)),
      line_keys_(line_keys(fingerprints_)),
      by_value_(first_),
      by_line_(line_keys_),
      exact_{ExactValues(program, 0), ExactValues(program, 1), ExactValues(program, 2)},
      users_(users(program)),
      visited_(program.nodes.size()) {}

std::vector<Definition> EqualValues::lines(ValueId id) const {
  const Fingerprint& value = fingerprints_[id.value];
  if (is_number(value)) return {{.kind = Definition::Kind::kNumber}};
  std::vector<Definition> list;
  std::size_t tried = 0;
  for (const auto& [key, x] : by_line_.values_of(line_keys_[id.value])) {
    if (x >= id.value) break;
    if (fingerprints_[x] == value || -fingerprints_[x] == value)
      list.push_back({.kind = Definition::Kind::kLine, .x = {ValueId(x), fingerprints_[x] != value}});
    else if (tried++ < kMostLines)
      if (const std::optional<Definition> found = line(id.value, x)) list.push_back(*found);
  }
  return list;
}

/// v = factor x + offset with as few numbers as it takes.
std::optional<Definition> EqualValues::line(std::size_t v, std::size_t x) const {
  const auto &V = fingerprints_[v].at, &X = fingerprints_[x].at;
  const auto everywhere = [&](auto holds) { return holds(1) && holds(2) && holds(3); };
  const auto proportional = [&](Residue v0, Residue x0) {
    return everywhere([&](int k) { return (V[k] - v0) * (X[0] - x0) == (V[0] - v0) * (X[k] - x0); });
  };
  Definition line{.kind = Definition::Kind::kLine, .x = {ValueId(x)}};
  line.is_scaled = line.is_shifted = true;
  if (proportional({}, {}))
    line.is_shifted = false;
  else if (everywhere([&](int k) { return V[k] - X[k] == V[0] - X[0]; }))
    line.is_scaled = false;
  else if (everywhere([&](int k) { return V[k] + X[k] == V[0] + X[0]; }))
    line.is_scaled = false, line.x.negative = true;
  else if (!everywhere([&](int k) { return (V[k] - V[0]) * (X[1] - X[0]) == (V[1] - V[0]) * (X[k] - X[0]); }))
    return {};
  return line;
}

std::optional<Definition> EqualValues::with_numbers(ValueId id, Definition definition) {
  const bool is_constant = definition.kind == Definition::Kind::kNumber;
  if (!is_constant && !definition.is_scaled && !definition.is_shifted) return definition;
  const auto v = [&](int sample) { return exact_[sample].of(id); };
  const auto x = [&](int sample) { return exact_[sample].of(is_constant ? id : definition.x.value); };
  std::optional<cln::cl_R> factor = is_constant ? 0 : cln::cl_R(1), offset = cln::cl_R(0);
  if (definition.is_scaled)
    factor = number(definition.is_shifted ? (v(1) - v(0)) / (x(1) - x(0)) : v(0) / x(0));
  if (!factor) return {};
  const auto rest = [&](int sample) {
    return v(sample) - ScaledReal(*factor) * (definition.x.negative ? -x(sample) : x(sample));
  };
  if (is_constant && fingerprints_[id.value].is_zero())
    offset = cln::cl_R(0);
  else if (is_constant || definition.is_shifted)
    offset = number(rest(0));
  if (!offset) return {};
  const ScaledReal difference = rest(2) - ScaledReal(*offset);
  if (!isfinite(difference) ||
      std::fabs(static_cast<long double>(difference)) > kAgreement * difference.scale())
    return {};
  definition.factor = *factor;
  definition.offset = *offset;
  return definition;
}

std::vector<std::size_t> EqualValues::near(std::size_t v) {
  ++visit_;
  std::vector<std::size_t> list;
  const auto add = [&](std::size_t i) {
    if (visited_[i] != visit_) list.push_back(i);
    visited_[i] = visit_;
  };
  const auto add_operands = [&](const ir::Node& node) {
    if (ir::operand_count(node.op) >= 1) add(node.a.value);
    if (ir::operand_count(node.op) == 2) add(node.b.value);
  };
  add_operands(program_.nodes[v]);
  std::size_t done = 0;
  for (int depth = 1; depth < kDepth; ++depth)
    for (const std::size_t end = list.size(); done < end; ++done) add_operands(program_.nodes[list[done]]);
  const std::size_t operands = list.size();
  for (std::size_t k = 0; k < operands; ++k) {
    const std::vector<std::size_t>& all = users_[list[k]];
    const auto end = std::lower_bound(all.begin(), all.end(), v);
    std::for_each(end - std::min(end - all.begin(), kMostUsers), end, add);
  }
  return list;
}

std::vector<Definition> EqualValues::pairs(ValueId id) {
  std::vector<Definition> list;
  if (is_number(fingerprints_[id.value])) return list;
  const Residue value = first_[id.value];
  for (const std::size_t x : near(id.value)) {
    if (by_value_.may_have(value - first_[x])) add_sums(id.value, {ValueId(x), false}, list);
    if (by_value_.may_have(value + first_[x])) add_sums(id.value, {ValueId(x), true}, list);
    if (by_value_.may_have(value * inverses_[x])) add_products(id.value, x, list);
  }
  return list;
}

/// v = x + y, neither of them 0.
void EqualValues::add_sums(std::size_t v, Signed x, std::vector<Definition>& list) const {
  const Fingerprint &value = fingerprints_[v], &at_x = fingerprints_[x.value.value],
                    rest = x.negative ? value + at_x : value - at_x;
  if (at_x.is_zero() || rest.is_zero()) return;
  for (const auto& [key, y] : by_value_.values_of(rest.at[0])) {
    if (y >= v) break;
    if (fingerprints_[y] == rest || -fingerprints_[y] == rest)
      list.push_back({.kind = Definition::Kind::kSum, .x = x, .y = {ValueId(y), fingerprints_[y] != rest}});
  }
}

/// v = x y.
void EqualValues::add_products(std::size_t v, std::size_t x, std::vector<Definition>& list) const {
  const Fingerprint& value = fingerprints_[v];
  for (const auto& [key, y] : by_value_.values_of(value.at[0] * inverses_[x])) {
    if (y >= v) break;
    const Fingerprint product = fingerprints_[x] * fingerprints_[y];
    if (product == value || -product == value)
      list.push_back(
          {.kind = Definition::Kind::kProduct, .x = {ValueId(x), product != value}, .y = {ValueId(y)}});
  }
}

}  // namespace jourdain::passes
