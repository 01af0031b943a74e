#include "mutants/equation_mutants.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "kinematics/numbers.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

using dynamics::Equations;
using kinematics::Ex;
using kinematics::Statement;
using kinematics::Statements;

namespace {

std::string text_of(const Ex& e) {
  std::ostringstream text;
  text << e;
  return text.str();
}

/// Operands in the order of their texts.
std::vector<Ex> operands(const Ex& e) {
  std::vector<Ex> list(e.begin(), e.end());
  std::sort(list.begin(), list.end(), [](const Ex& a, const Ex& b) { return text_of(a) < text_of(b); });
  return list;
}

Ex without(const Ex& e, Random& random) {
  std::vector<Ex> list = operands(e);
  list.erase(list.begin() + static_cast<long>(random.below(list.size())));
  Ex rest = GiNaC::is_a<GiNaC::add>(e) ? 0 : 1;
  for (const Ex& operand : list) rest = GiNaC::is_a<GiNaC::add>(e) ? rest + operand : rest * operand;
  return rest;
}

/// Symbols in it, by name.
std::map<std::string, Ex> symbols(const Ex& e) {
  std::map<std::string, Ex> found;
  for (auto it = e.preorder_begin(); it != e.preorder_end(); ++it)
    if (GiNaC::is_a<GiNaC::symbol>(*it)) found.emplace(text_of(*it), *it);
  return found;
}

/// A factor other than ±1 in one of the terms, times 1 + 1e-9.
std::optional<Ex> with_other_number(const Ex& e) {
  const Ex more = 1 + kinematics::exact(1e-9);
  if (GiNaC::is_a<GiNaC::numeric>(e))
    return e.is_zero() || kinematics::is_trivial(e) ? std::optional<Ex>() : Ex(e * more);
  if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return {};
  const std::vector<Ex> list = operands(e);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::optional<Ex> changed = with_other_number(list[i]);
    if (!changed) continue;
    Ex result = *changed;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (k != i) result = GiNaC::is_a<GiNaC::add>(e) ? Ex(result + list[k]) : Ex(result * list[k]);
    return result;
  }
  return {};
}

/// `value` with the fault; `earlier` are symbols that may stand in it.
std::optional<Ex> changed(const Ex& value, StatementFault fault, const std::vector<Ex>& earlier,
                          Random& random) {
  switch (fault) {
    case StatementFault::kSign:
      return -value;
    case StatementFault::kScale:
      return value * (1 + kinematics::exact(1e-9));
    case StatementFault::kDropTerm:
      return GiNaC::is_a<GiNaC::add>(value) ? std::optional(without(value, random)) : std::nullopt;
    case StatementFault::kDropFactor:
      return GiNaC::is_a<GiNaC::mul>(value) ? std::optional(without(value, random)) : std::nullopt;
    case StatementFault::kOtherSymbol: {
      const auto found = symbols(value);
      if (found.empty() || earlier.size() < 2) return {};
      const Ex from = std::next(found.begin(), static_cast<long>(random.below(found.size())))->second;
      const Ex to = earlier[random.below(earlier.size())];
      return from.is_equal(to) ? std::nullopt : std::optional<Ex>(value.subs(from == to));
    }
    case StatementFault::kNumber:
      return with_other_number(value);
  }
  return {};
}

/// Rebuilds the equations on new symbols, one statement changed.
class Rebuilding {
 public:
  Rebuilding(const Equations& original, std::size_t at) : original_(original), at_(at) {}

  std::optional<Equations> run(StatementFault fault, Random& random) {
    Equations copy = original_;
    copy.statements = Statements();
    for (const kinematics::Leaf& leaf : original_.statements.leaves())
      remember(leaf.symbol, copy.statements.leaf(leaf.kind, leaf.index, leaf.symbol.get_name()));
    const std::vector<Statement>& all = original_.statements.all();
    for (std::size_t i = 0; i < all.size(); ++i) {
      Ex value = renewed(all[i].value);
      if (i == at_) {
        const std::optional<Ex> mutant = changed(value, fault, earlier_, random);
        if (!mutant) return {};
        value = *mutant;
      }
      remember(all[i].name, copy.statements.bind(all[i].name.get_name(), value));
    }
    renew(copy);
    return copy;
  }

 private:
  void remember(const GiNaC::symbol& name, const Ex& replacement) {
    replacements_[name] = replacement;
    earlier_.push_back(replacement);
  }
  Ex renewed(const Ex& value) const { return value.subs(replacements_, GiNaC::subs_options::no_pattern); }
  void renew(std::vector<Ex>& list) const {
    for (Ex& value : list) value = renewed(value);
  }
  void renew(Equations& e) const {
    for (std::vector<Ex>& row : e.M) renew(row);
    for (auto* list : {&e.ydot, &e.k_bar, &e.q_bar, &e.zdot, &e.tau, &e.residual, &e.load,
                       &e.initial_position, &e.initial_velocity})
      renew(*list);
    e.kinetic_energy = renewed(e.kinetic_energy);
    e.potential_energy = renewed(e.potential_energy);
    for (auto& output : e.outputs)
      for (dynamics::OutputValues& member : output) renew(member.values);
  }

  const Equations& original_;
  std::size_t at_;
  GiNaC::exmap replacements_;
  std::vector<Ex> earlier_;
};

}  // namespace

const char* name_of(StatementFault fault) {
  constexpr const char* kNames[kStatementFaults] = {"sign of a statement", "statement by 1e-9",
                                                    "term dropped",        "factor dropped",
                                                    "another symbol",      "number by 1e-9"};
  return kNames[static_cast<std::size_t>(fault)];
}

std::vector<std::vector<Ex>> asked_for(const Equations& e) {
  std::vector<std::vector<Ex>> list = {e.ydot,
                                       e.k_bar,
                                       e.q_bar,
                                       e.zdot,
                                       e.tau,
                                       e.initial_position,
                                       e.initial_velocity,
                                       {e.kinetic_energy},
                                       {e.potential_energy}};
  for (const std::vector<Ex>& row : e.M) list.push_back(row);
  for (const auto& output : e.outputs)
    for (const dynamics::OutputValues& member : output) list.push_back(member.values);
  return list;
}

std::vector<std::size_t> live_statements(const Equations& equations) {
  std::set<std::string> needed;  // names are not unique: what shares one with a live statement counts as live
  const auto need = [&](const Ex& value) {
    for (const auto& [name, symbol] : symbols(value)) needed.insert(name);
  };
  for (const std::vector<Ex>& list : asked_for(equations))
    for (const Ex& value : list) need(value);
  const std::vector<Statement>& all = equations.statements.all();
  std::vector<std::size_t> live;
  for (std::size_t i = all.size(); i-- > 0;) {
    if (!needed.count(all[i].name.get_name())) continue;
    need(all[i].value);
    live.push_back(i);
  }
  return live;
}

std::optional<Equations> planted(const Equations& equations, StatementFault fault, std::size_t at,
                                 std::uint64_t seed) {
  Random random(seed);
  return Rebuilding(equations, at).run(fault, random);
}

}  // namespace jourdain::tests
