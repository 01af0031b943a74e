#include "loops/rows/row_derivatives.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "ir/compose.hpp"
#include "lowering/displacements.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::Builder;
using ir::JacobianEntries;
using ir::LeafKind;
using ir::Program;
using ir::Seed;
using ir::Signed;

namespace {

/// A builder that holds g and differentiates it.
class Differentiation {
 public:
  Differentiation(const model::Tangent& tangent, const RowPrograms& rows,
                  const ir::Surroundings& surroundings)
      : tangent_(tangent), surroundings_(surroundings), rows_(rows), g_(ir::insert(builder_, rows.value)) {
    const std::size_t n = tangent.scalars.size() + 3 * tangent.quaternions.size();
    const std::vector<Signed> rates = ir::insert(builder_, rows.leading);
    for (std::size_t k = 0; k < rates.size(); ++k)
      leading_.push_back(
          {builder_.leaf(LeafKind::kVelocity, support::subscript(rows.leading.outputs[k].row)), 0, rates[k]});
    std::vector<Seed> seeds = lowering::displacement_seeds(builder_, tangent);
    add_time(seeds, n);
    velocities_ = n;
    G_ = ir::differentiate(builder_, g_, seeds, {}, surroundings_);
    add_velocities(rows.velocities);
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
    std::vector<Seed> path = path_seeds();
    const std::vector<Signed> held = held_points();
    for (const auto& [at, move] : changes_of_found(builder_, rows_.searches, held, path, surroundings_))
      path.push_back({held[at.first], at.second, move});
    const JacobianEntries along = ir::differentiate(builder_, rate, path, {}, surroundings_);
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
    const JacobianEntries entries = ir::differentiate(builder_, moving, seeds, {}, surroundings_);
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

  std::vector<Signed> held_points() {
    std::vector<Signed> leaves;
    for (std::size_t k = 0; k < rows_.searches.found.outputs.size(); ++k)
      leaves.push_back(builder_.leaf(LeafKind::kHeld, k));
    return leaves;
  }

  /// With the points found in place of those held.
  Program finish(const char* name) {
    Program program = passes::remove_dead_code(builder_.finish(name));
    if (rows_.searches.is_empty()) return program;
    Builder whole;
    const std::vector<Signed> found = ir::insert(whole, rows_.searches.found);
    const std::vector<Signed> values = ir::insert(whole, program, [&](LeafKind kind, std::size_t k) {
      return kind == LeafKind::kHeld ? std::optional(found[k]) : std::nullopt;
    });
    for (std::size_t k = 0; k < values.size(); ++k) {
      const ir::Output& output = program.outputs[k];
      whole.output(output.name, output.row, output.column, values[k]);
    }
    return passes::remove_dead_code(whole.finish(name));
  }

  const model::Tangent& tangent_;
  const ir::Surroundings& surroundings_;
  const RowPrograms& rows_;
  Builder builder_;
  std::vector<Signed> g_;
  std::vector<Seed> leading_;  ///< states that motions follow, with their rates
  std::size_t velocities_ = 0;
  JacobianEntries G_;
};

}  // namespace

Program differentiated_jacobian(const model::Tangent& tangent, const RowPrograms& rows,
                                const ir::Surroundings& surroundings) {
  return Differentiation(tangent, rows, surroundings).jacobian();
}

Program differentiated_rates(const model::Tangent& tangent, const RowPrograms& rows,
                             const ir::Surroundings& surroundings) {
  return Differentiation(tangent, rows, surroundings).rates();
}

}  // namespace jourdain::loops
