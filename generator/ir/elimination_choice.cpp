#include "ir/elimination_choice.hpp"

#include <algorithm>
#include <numeric>

#include "ir/elimination_search.hpp"
#include "ir/scramble.hpp"

namespace jourdain::ir {

namespace {

/// Of all values; where some have none, each stands for itself.
std::vector<Residue> residues(const Program& program, const LeafFingerprint& leaf) {
  std::vector<Residue> result;
  if (const auto prints = fingerprints(program, leaf)) {
    for (const Fingerprint& print : *prints) result.push_back(print.at[0]);
    return result;
  }
  for (std::size_t i = 0; i < program.nodes.size(); ++i) result.emplace_back(scrambled(1, i));
  return result;
}

/// The residues of what is taken and of what that is computed from.
std::vector<Residue> computed(const Program& program, const std::vector<Residue>& values,
                              std::vector<bool> is_taken) {
  std::vector<Residue> result;
  for (std::size_t i = values.size(); i-- > 0;) {
    const Node& node = program.nodes[i];
    const int count = operand_count(node.op);
    if (!is_taken[i] && count > 0) continue;
    result.push_back(values[i]);
    if (count >= 1) is_taken[node.a.value] = true;
    if (count == 2) is_taken[node.b.value] = true;
  }
  return result;
}

/// All vertices: a prefix operands first, the others results first.
std::vector<std::uint32_t> prefix_first(std::size_t inner, std::size_t prefix) {
  std::vector<std::uint32_t> order(inner);
  std::iota(order.begin(), order.end(), 0);
  std::reverse(order.begin() + static_cast<std::ptrdiff_t>(prefix), order.end());
  return order;
}

constexpr std::size_t kLarge = 5000;  // values from which on few orders are tried

/// An order and what it takes.
struct Tried {
  EliminationTrials::Order order;
  std::size_t operations = 0;
};

bool takes_less(const Tried& a, const Tried& b) { return a.operations < b.operations; }

/// Of all orders those that take least are improved by moving vertices about, and of these again those that take least.
EliminationTrials::Order best_of(EliminationTrials& trials, std::vector<Tried> tried, bool is_thorough) {
  struct Round {
    std::size_t orders;
    EliminationTrials::Effort each;
  };
  const std::vector<Round> brief = {{1, {4'000'000, 24}}},
                           thorough = {{8, {1'000'000, 4}}, {3, {4'000'000, 6}}, {1, {32'000'000, 24}}};
  const auto sort = [&tried] { std::stable_sort(tried.begin(), tried.end(), takes_less); };
  sort();
  for (const Round& round : is_thorough ? thorough : brief) {
    tried.resize(std::min(tried.size(), round.orders));
    for (Tried& t : tried) {
      t.order = trials.improved(std::move(t.order), round.each);
      t.operations = trials.operations(t.order);
    }
    sort();
  }
  return std::move(tried.front().order);
}

}  // namespace

bool takes_by_signs(const Program& program) {
  return std::any_of(program.nodes.begin(), program.nodes.end(), [](const Node& node) {
    return node.op == Op::kWhereNegative || node.op == Op::kWhereNotNegative;
  });
}

Surroundings within(const Program& program, const LeafValue& leaf) {
  Surroundings result;
  const auto values = fingerprints(program);
  if (!values) return result;
  result.values = *values;
  result.leaf = [leaf, values = *values](LeafKind kind, std::size_t i) -> std::optional<Fingerprint> {
    const std::optional<Signed> given = leaf(kind, i);
    if (!given) return std::nullopt;
    const Fingerprint& found = values[given->value.value];
    return given->negative ? -found : found;
  };
  result.is_fixed = [leaf, fixed = fixed_values(program)](LeafKind kind, std::size_t i) {
    const std::optional<Signed> given = leaf(kind, i);
    return given ? fixed[given->value.value] : is_made_with_the_model(kind, i);
  };
  return result;
}

/// Which parts of the program leave operands first is one of several choices; from there vertices are moved about.
std::vector<std::uint32_t> elimination_order(const Program& program, std::size_t inner,
                                             const std::vector<Partials>& operands,
                                             const Surroundings& surroundings) {
  const auto share = [inner](double of) { return static_cast<std::size_t>(of * static_cast<double>(inner)); };
  if (surroundings.forward) return prefix_first(inner, share(*surroundings.forward));
  const std::vector<Residue> values = residues(program, surroundings.leaf);
  std::vector<std::vector<EliminationTrials::Edge>> edges(operands.size());
  const std::vector<bool> fixed = fixed_values(program, surroundings.is_fixed);
  std::vector<bool> is_taken(values.size(), false);
  for (std::size_t v = 0; v < edges.size(); ++v)
    for (const auto& [operand, partial] : operands[v]) {
      const Residue value = values[partial.value.value];
      edges[v].push_back({partial.negative ? -value : value, static_cast<std::uint32_t>(operand),
                          fixed[partial.value.value]});
      is_taken[partial.value.value] = true;
    }
  std::vector<Residue> known = computed(program, values, std::move(is_taken));
  for (const Fingerprint& value : surroundings.values) known.push_back(value.at[0]);
  EliminationTrials trials(std::move(edges), inner, known);
  const bool is_simple = takes_by_signs(program), is_large = inner > kLarge;
  using Shares = std::vector<double>;
  std::vector<Tried> tried;
  for (const double late : is_simple || is_large ? Shares{1} : Shares{1, 0.9, 0.85, 0.8})
    for (const double forward :
         is_large ? Shares{0, 0.15, 0.5, 1} : Shares{0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1}) {
      EliminationTrials::Order order =
          is_simple ? prefix_first(inner, share(forward)) : trials.order(share(forward), share(late));
      const auto is_it = [&order](const Tried& t) { return t.order == order; };
      if (std::none_of(tried.begin(), tried.end(), is_it)) tried.push_back({order, trials.operations(order)});
    }
  if (is_simple) return std::min_element(tried.begin(), tried.end(), takes_less)->order;
  return best_of(trials, std::move(tried), surroundings.is_thorough && !is_large);
}

}  // namespace jourdain::ir
