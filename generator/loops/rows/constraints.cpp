#include "loops/rows/constraints.hpp"

#include <algorithm>
#include <optional>

#include "ir/compose.hpp"
#include "lowering/cheapest_elimination.hpp"
#include "lowering/lower.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::Builder;
using ir::EliminationOrder;
using ir::JacobianEntries;
using ir::LeafKind;
using ir::Program;
using ir::Seed;
using ir::Signed;

namespace {

/// Entries of y that are positions of joints inward of the body, with the values that leave its frame where it is.
std::map<std::size_t, double> positions_inward(const model::Mechanism& mechanism,
                                               const model::CoordinateLayout& layout,
                                               std::optional<model::BodyIndex> body) {
  std::map<std::size_t, double> values;
  while (body) {
    std::size_t j = 0;
    while (mechanism.joints[j].child != *body) ++j;
    const model::JointEntries& entries = layout.joints[j];
    for (std::size_t k = 0; k < entries.position_count; ++k) values[entries.first_position + k] = 0;
    for (const std::size_t q : layout.quaternions)
      if (values.count(q)) values[q] = 1;
    body = mechanism.joints[j].parent;
  }
  return values;
}

/// Copies targets of each loop into one program; outputs that are 0 whatever the state are left out where `sparse`.
class LoopLowering {
 public:
  LoopLowering(const model::Mechanism& mechanism, const dynamics::Equations& equations)
      : mechanism_(mechanism), equations_(equations), layout_(model::lay_out_coordinates(mechanism)) {}

  void add(std::size_t loop, const lowering::Target& target, bool sparse = false) {
    const std::map<std::size_t, double> fixed = inward(mechanism_.loops[loop]);
    const Program one = lowering::lower(equations_.statements, {target}, target.name);
    const Signed copy = ir::insert(builder_, one, [&](LeafKind kind, std::size_t i) {
      const auto it = fixed.find(i);
      const bool given = kind == LeafKind::kPosition && it != fixed.end();
      return given ? std::optional(builder_.literal(it->second)) : std::nullopt;
    })[0];
    if (!sparse || !builder_.is_literal(copy, 0))
      builder_.output(target.name, target.row, target.column, copy);
  }

  Program finish(const char* name) { return passes::remove_dead_code(builder_.finish(name)); }

 private:
  /// Coordinates that the loop does not feel.
  std::map<std::size_t, double> inward(const model::Loop& loop) const {
    if (!model::loop_kind(loop).has_ends()) return {};
    return positions_inward(mechanism_, layout_,
                            model::carrier(mechanism_, mechanism_.frames[loop.from.value].body,
                                           mechanism_.frames[loop.to.value].body));
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
  model::CoordinateLayout layout_;
  Builder builder_;
};

/// What is derived for the loops, and who derives it.
class Lowered {
 public:
  Lowered(const model::Mechanism& mechanism, const dynamics::Equations& equations)
      : mechanism_(mechanism), equations_(equations) {}

  Program values() const {
    return by_row("g", [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
      program.add(l, {"g", row, -1, closure.rows[r]});
    });
  }

  Program velocities() const {
    return by_row("velocities",
                  [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
                    if (const auto it = closure.velocities.find(r); it != closure.velocities.end())
                      program.add(l, {"v", row, -1, it->second});
                  });
  }

  /// Rates of the states that motions follow, by their entry.
  Program leading() const {
    std::vector<lowering::Target> targets;
    for (const dynamics::LeadingState& state : equations_.leading)
      targets.push_back({"rate", static_cast<int>(state.entry), -1, state.rate});
    return lowering::lower(equations_.statements, targets, "leading");
  }

  Program senses() const {
    LoopLowering program(mechanism_, equations_);
    for (std::size_t l = 0; l < equations_.closures.size(); ++l)
      for (const dynamics::Ex& sense : equations_.closures[l].senses)
        program.add(l, {"sense", static_cast<int>(l), -1, sense});
    return program.finish("sense");
  }

  Program spans() const {
    return by_row("span",
                  [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t, int row) {
                    if (!closure.span) return;
                    for (int k = 0; k < 3; ++k)
                      program.add(l, {"span", row, k, closure.span->difference[static_cast<std::size_t>(k)]});
                    program.add(l, {"length", row, -1, closure.span->length});
                  });
  }

  /// By the motion of points and directions; none where a row is a residual of the description.
  std::optional<Program> jacobian() const {
    if (!has_rates()) return {};
    return by_row("closure_jacobian",
                  [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
                    for (const auto& [velocity, slope] : closure.slopes[r])
                      program.add(l, {"G", row, static_cast<int>(velocity), slope}, true);
                    program.add(l, {"g_t", row, -1, closure.time_slopes[r]}, true);
                  });
  }

  std::optional<Program> rates() const {
    if (!has_rates()) return {};
    return by_row("closure_rates",
                  [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
                    program.add(l, {"rate", row, -1, closure.rates[r]});
                    program.add(l, {"gamma", row, -1, closure.biases[r]});
                  });
  }

 private:
  bool has_rates() const {
    return std::all_of(equations_.closures.begin(), equations_.closures.end(),
                       [](const dynamics::LoopClosure& closure) { return !closure.slopes.empty(); });
  }

  template <class Add>
  Program by_row(const char* name, const Add& add) const {
    LoopLowering program(mechanism_, equations_);
    int row = 0;
    for (std::size_t l = 0; l < equations_.closures.size(); ++l)
      for (std::size_t r = 0; r < equations_.closures[l].rows.size(); ++r)
        add(program, equations_.closures[l], l, r, row++);
    return program.finish(name);
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
};

/// A builder that holds g and differentiates it.
class Differentiation {
 public:
  Differentiation(const model::Tangent& tangent, const Program& value, const Program& velocities,
                  const Program& leading, EliminationOrder order)
      : tangent_(tangent), order_(order), g_(ir::insert(builder_, value)) {
    const std::size_t n = tangent.scalars.size() + 3 * tangent.quaternions.size();
    const std::vector<Signed> rates = ir::insert(builder_, leading);
    for (std::size_t k = 0; k < rates.size(); ++k)
      leading_.push_back(
          {builder_.leaf(LeafKind::kVelocity, support::subscript(leading.outputs[k].row)), 0, rates[k]});
    std::vector<Seed> seeds = lowering::displacement_seeds(builder_, tangent);
    add_time(seeds, n);
    velocities_ = n;
    G_ = ir::differentiate(builder_, g_, seeds, order);
    add_velocities(velocities);
  }

  Program jacobian() {
    for (const auto& [at, value] : G_)
      if (at.second < velocities_)
        builder_.output("G", static_cast<int>(at.first), static_cast<int>(at.second), value);
      else
        builder_.output("g_t", static_cast<int>(at.first), -1, value);
    return finish("closure_jacobian");
  }

  Program rates() {
    std::vector<Signed> rate(g_.size(), builder_.literal(0));
    for (const auto& [at, value] : G_) {
      const bool by_time = at.second == velocities_;
      const Signed term =
          by_time ? value : builder_.multiply(value, builder_.leaf(LeafKind::kVelocity, at.second));
      rate[at.first] = builder_.add(rate[at.first], term);
    }
    const JacobianEntries along = ir::differentiate(builder_, rate, path_seeds(), order_);
    for (std::size_t r = 0; r < rate.size(); ++r) {
      builder_.output("rate", static_cast<int>(r), -1, rate[r]);
      const auto it = along.find({r, 0});
      builder_.output("gamma", static_cast<int>(r), -1, it == along.end() ? builder_.literal(0) : it->second);
    }
    return finish("closure_rates");
  }

 private:
  /// What moves on at z = 0, by the column of time: t, and states that motions follow.
  void add_time(std::vector<Seed>& seeds, std::size_t column) {
    seeds.push_back({builder_.leaf(LeafKind::kTime, 0), column, builder_.literal(1)});
    for (const Seed& state : leading_) seeds.push_back({state.leaf, column, state.partial});
  }

  /// G and g_t of rows that are linear in z and have no g.
  void add_velocities(const Program& velocities) {
    const std::vector<Signed> moving = ir::insert(builder_, velocities);
    const std::vector<Signed> resting =
        ir::insert(builder_, velocities, [this](LeafKind kind, std::size_t k) {
          const bool moves = kind == LeafKind::kVelocity && k < velocities_;  // states stay
          return moves ? std::optional(builder_.literal(0)) : std::nullopt;
        });
    std::vector<Seed> seeds;
    for (std::size_t k = 0; k < velocities_; ++k)
      seeds.push_back({builder_.leaf(LeafKind::kVelocity, k), k, builder_.literal(1)});
    const JacobianEntries entries = ir::differentiate(builder_, moving, seeds, order_);
    const auto row = [&](std::size_t k) { return support::subscript(velocities.outputs[k].row); };
    for (const auto& [at, value] : entries) G_[{row(at.first), at.second}] = value;
    for (std::size_t k = 0; k < resting.size(); ++k)
      if (!builder_.is_literal(resting[k], 0)) G_[{row(k), velocities_}] = resting[k];
  }

  /// y and t moving along with the state, velocities held: the one column is time.
  std::vector<Seed> path_seeds() {
    std::vector<Seed> seeds;
    for (const Seed& seed : lowering::displacement_seeds(builder_, tangent_)) {
      const Signed rate = builder_.multiply(seed.partial, builder_.leaf(LeafKind::kVelocity, seed.column));
      const auto same = std::find_if(seeds.begin(), seeds.end(),
                                     [&](const Seed& s) { return s.leaf.value == seed.leaf.value; });
      if (same == seeds.end())
        seeds.push_back({seed.leaf, 0, rate});
      else
        same->partial = builder_.add(same->partial, rate);
    }
    add_time(seeds, 0);
    return seeds;
  }

  Program finish(const char* name) { return passes::remove_dead_code(builder_.finish(name)); }

  const model::Tangent& tangent_;
  EliminationOrder order_;
  Builder builder_;
  std::vector<Signed> g_;
  std::vector<Seed> leading_;  ///< states that motions follow, with their rates
  std::size_t velocities_ = 0;
  JacobianEntries G_;
};

/// One program in two ways, the cheaper one first; the other only where there is one.
std::vector<Program> in_order(Program one, std::optional<Program> other) {
  std::vector<Program> list = {std::move(one)};
  if (!other) return list;
  const bool is_cheaper = lowering::remaining_operations(*other) < lowering::remaining_operations(list[0]);
  list.insert(is_cheaper ? list.begin() : list.end(), std::move(*other));
  return list;
}

}  // namespace

std::vector<ConstraintPrograms> constraint_programs(const model::Mechanism& mechanism,
                                                    const dynamics::Equations& equations) {
  const model::Tangent tangent = model::lay_out_coordinates(mechanism).tangent;
  const Lowered lowered(mechanism, equations);
  ConstraintPrograms programs;
  programs.value = lowered.values();
  programs.velocities = lowered.velocities();
  programs.senses = lowered.senses();
  programs.spans = lowered.spans();
  const Program leading = lowered.leading();
  const auto differentiation = [&](EliminationOrder o) {
    return Differentiation(tangent, programs.value, programs.velocities, leading, o);
  };
  const std::vector<Program> jacobians =
      in_order(lowering::cheapest([&](EliminationOrder o) { return differentiation(o).jacobian(); }),
               lowered.jacobian());
  const std::vector<Program> rates = in_order(
      lowering::cheapest([&](EliminationOrder o) { return differentiation(o).rates(); }), lowered.rates());
  std::vector<ConstraintPrograms> list;
  for (const Program& jacobian : jacobians)
    for (const Program& rate : rates) {
      programs.jacobian = jacobian;
      programs.rates = rate;
      list.push_back(programs);
    }
  return list;
}

ConstraintPrograms closure_programs(const model::Mechanism& mechanism) {
  dynamics::DerivationOptions options;
  options.closures_only = options.for_derivatives = true;
  return constraint_programs(mechanism, dynamics::derive_equations(mechanism, options)).front();
}

}  // namespace jourdain::loops
