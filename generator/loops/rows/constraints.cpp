#include "loops/rows/constraints.hpp"

#include <algorithm>
#include <optional>

#include "ir/compose.hpp"
#include "loops/rows/row_derivatives.hpp"
#include "lowering/lower.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"
#include "passes/cheapest_elimination.hpp"
#include "passes/pipeline.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::Builder;
using ir::LeafKind;
using ir::Program;
using ir::Signed;
using lowering::Held;

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
  LoopLowering(const model::Mechanism& mechanism, const dynamics::Equations& equations, Held held)
      : mechanism_(mechanism),
        equations_(equations),
        layout_(model::lay_out_coordinates(mechanism)),
        held_(held) {}

  void add(std::size_t loop, const lowering::Target& target, bool sparse = false) {
    const std::map<std::size_t, double> fixed = inward(mechanism_.loops[loop]);
    const Program one = lowering::lower(equations_.statements, {target}, target.name, held_);
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
  Held held_;
  Builder builder_;
};

/// What is derived for the loops, and who derives it.
class Lowered {
 public:
  Lowered(const model::Mechanism& mechanism, const dynamics::Equations& equations)
      : mechanism_(mechanism), equations_(equations) {}

  Program values(Held held = Held::kValues) const {
    const auto add = [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
      program.add(l, {"g", row, -1, closure.rows[r]});
    };
    return by_row("g", add, held);
  }

  Program velocities(Held held = Held::kValues) const {
    const auto add = [](LoopLowering& program, const auto& closure, std::size_t l, std::size_t r, int row) {
      if (const auto it = closure.velocities.find(r); it != closure.velocities.end())
        program.add(l, {"v", row, -1, it->second});
    };
    return by_row("velocities", add, held);
  }

  /// Rates of the states that motions follow, by their entry.
  Program leading() const {
    std::vector<lowering::Target> targets;
    for (const dynamics::LeadingState& state : equations_.leading)
      targets.push_back({"rate", static_cast<int>(state.entry), -1, state.rate});
    return lowering::lower(equations_.statements, targets, "leading");
  }

  Program senses() const {
    LoopLowering program(mechanism_, equations_, Held::kValues);
    for (std::size_t l = 0; l < equations_.closures.size(); ++l)
      for (const dynamics::Ex& sense : equations_.closures[l].senses)
        program.add(l, {"sense", static_cast<int>(l), -1, sense});
    return program.finish("sense");
  }

  Program misses() const {
    return by_search("misses", Held::kValues,
                     [](LoopLowering& program, const auto& search, std::size_t l, int k) {
                       const auto loop = static_cast<int>(l);
                       program.add(l, {"miss", loop, k, search.missed});
                       program.add(l, {"determinant", loop, k, search.determinant});
                       program.add(l, {"trace", loop, k, search.trace});
                     });
  }

  /// ("found", k), two by two, in the order of their leaves.
  Program found() const {
    return by_search("found", Held::kValues,
                     [](LoopLowering& program, const auto& search, std::size_t l, int k) {
                       for (int i = 0; i < 2; ++i)
                         program.add(l, {"found", 2 * k + i, -1, search.found[static_cast<std::size_t>(i)]});
                     });
  }

  /// ("misfit", k) and ("inverse", k, 0 or 1), in the same order.
  Program misfits() const {
    return by_search(
        "misfits", Held::kLeaves, [](LoopLowering& program, const auto& search, std::size_t l, int k) {
          for (int i = 0; i < 2; ++i) {
            const auto row = static_cast<std::size_t>(i);
            program.add(l, {"misfit", 2 * k + i, -1, search.misfit[row]});
            for (int j = 0; j < 2; ++j)
              program.add(l, {"inverse", 2 * k + i, j, search.inverse[row][static_cast<std::size_t>(j)]});
          }
        });
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
  Program by_row(const char* name, const Add& add, Held held = Held::kValues) const {
    LoopLowering program(mechanism_, equations_, held);
    int row = 0;
    for (std::size_t l = 0; l < equations_.closures.size(); ++l)
      for (std::size_t r = 0; r < equations_.closures[l].rows.size(); ++r)
        add(program, equations_.closures[l], l, r, row++);
    return program.finish(name);
  }

  /// Searches are numbered as what they hold.
  template <class Add>
  Program by_search(const char* name, Held held, const Add& add) const {
    LoopLowering program(mechanism_, equations_, held);
    int number = 0;
    for (std::size_t l = 0; l < equations_.closures.size(); ++l)
      for (const dynamics::Search& search : equations_.closures[l].searches)
        add(program, search, l, number++);
    return program.finish(name);
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
};

/// One program in two ways, the cheaper one first; the other only where there is one.
std::vector<Program> in_order(Program one, std::optional<Program> other) {
  std::vector<Program> list = {std::move(one)};
  if (!other) return list;
  const bool is_cheaper = passes::remaining_operations(*other) < passes::remaining_operations(list[0]);
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
  programs.misses = lowered.misses();
  programs.searches = {lowered.found(), lowered.misfits()};
  const RowPrograms rows = {lowered.values(Held::kLeaves), lowered.velocities(Held::kLeaves),
                            lowered.leading(), programs.searches};
  const std::vector<Program> jacobians = in_order(passes::cheapest([&](const ir::Surroundings& by) {
                                                    return differentiated_jacobian(tangent, rows, by);
                                                  }),
                                                  lowered.jacobian());
  const std::vector<Program> rates = in_order(
      passes::cheapest([&](const ir::Surroundings& by) { return differentiated_rates(tangent, rows, by); }),
      lowered.rates());
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
