#include "loops/constraints.hpp"

#include <set>

#include "elimination.hpp"
#include "ir/compose.hpp"
#include "ir/lower.hpp"
#include "model/coordinates.hpp"
#include "passes/rewrite.hpp"

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

/// One output per value of every loop, in order.
Program lowered(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                std::vector<dynamics::Ex> dynamics::LoopClosure::*values, const char* name) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  Builder builder;
  std::size_t row = 0;
  for (std::size_t l = 0; l < mechanism.loops.size(); ++l) {
    const model::Loop& loop = mechanism.loops[l];
    std::map<std::size_t, double> fixed;
    if (loop.type != model::LoopType::kResidual)
      fixed = positions_inward(mechanism, layout,
                               model::carrier(mechanism, mechanism.frames[loop.from.value].body,
                                              mechanism.frames[loop.to.value].body));
    for (const dynamics::Ex& value : equations.closures[l].*values) {
      const Program one = ir::lower(equations.statements, {{name, -1, -1, value}}, name);
      const Signed copy = ir::insert(builder, one, [&](LeafKind kind, std::size_t i) {
        const auto it = fixed.find(i);
        const bool given = kind == LeafKind::kPosition && it != fixed.end();
        return given ? std::optional(builder.literal(it->second)) : std::nullopt;
      })[0];
      const bool is_row = values == &dynamics::LoopClosure::rows;
      builder.output(name, static_cast<int>(is_row ? row++ : l), -1, copy);
    }
  }
  return passes::remove_dead_code(builder.finish(name));
}

/// A builder that holds g and differentiates it.
class Differentiation {
 public:
  Differentiation(const model::Tangent& tangent, const Program& value, EliminationOrder order)
      : tangent_(tangent), order_(order), g_(ir::insert(builder_, value)) {
    const std::size_t n = tangent.scalars.size() + 3 * tangent.quaternions.size();
    std::vector<Seed> seeds = displacement_seeds(builder_, tangent);
    seeds.push_back({builder_.leaf(LeafKind::kTime, 0), n, builder_.literal(1)});
    velocities_ = n;
    G_ = ir::differentiate(builder_, g_, seeds, order);
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
  /// y and t moving along with the state, velocities held: the one column is time.
  std::vector<Seed> path_seeds() {
    std::vector<Seed> seeds;
    for (const Seed& seed : displacement_seeds(builder_, tangent_)) {
      const Signed rate = builder_.multiply(seed.partial, builder_.leaf(LeafKind::kVelocity, seed.column));
      const auto same = std::find_if(seeds.begin(), seeds.end(),
                                     [&](const Seed& s) { return s.leaf.value == seed.leaf.value; });
      if (same == seeds.end())
        seeds.push_back({seed.leaf, 0, rate});
      else
        same->partial = builder_.add(same->partial, rate);
    }
    seeds.push_back({builder_.leaf(LeafKind::kTime, 0), 0, builder_.literal(1)});
    return seeds;
  }

  Program finish(const char* name) { return passes::remove_dead_code(builder_.finish(name)); }

  const model::Tangent& tangent_;
  EliminationOrder order_;
  Builder builder_;
  std::vector<Signed> g_;
  std::size_t velocities_ = 0;
  JacobianEntries G_;
};

}  // namespace

ConstraintPrograms constraint_programs(const model::Mechanism& mechanism,
                                       const dynamics::Equations& equations) {
  const model::Tangent tangent = model::tangent_of(mechanism, model::lay_out_coordinates(mechanism));
  ConstraintPrograms programs;
  programs.value = lowered(mechanism, equations, &dynamics::LoopClosure::rows, "g");
  programs.senses = lowered(mechanism, equations, &dynamics::LoopClosure::senses, "sense");
  programs.jacobian =
      cheapest([&](EliminationOrder o) { return Differentiation(tangent, programs.value, o).jacobian(); });
  programs.rates =
      cheapest([&](EliminationOrder o) { return Differentiation(tangent, programs.value, o).rates(); });
  return programs;
}

}  // namespace jourdain::loops
