#include "loops/closed_form/position_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loops/closed_form/dyad.hpp"
#include "loops/closed_form/reach.hpp"
#include "loops/closed_form/spatial_rotation.hpp"
#include "loops/rows/dense_solver.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::LeafKind;
using ir::Program;

namespace {

constexpr std::size_t kSamples = 9;
/// Boxes after which the proof of pivots is given up: without it only operations are lost.
constexpr std::size_t kPivotBoxes = 20000;
/// rad or length: the initial state is assembled to rounding, times what the mechanism's condition makes of it.
constexpr double kAssembled = 1e-6;
/// Of the change of g over a unit of the dependents: what a wrong form leaves is of size 1.
constexpr double kResidual = 1e-9;

/// Of a condition's value at the start.
constexpr double kNearlyDead = 1e-4;

class Closing {
 public:
  explicit Closing(const ClosedFormRequest& request) : request_(request) {
    roles_.names = request.names;
    for (std::size_t k = roles_.names.size(); k < request.initial_y.size(); ++k)
      roles_.names.push_back(fmt::format("y[{}]", k));
    std::vector<bool> varied(request.initial_y.size(), true);
    for (const PositionBlock& block : request.blocks)
      for (const std::size_t k : entries_of(block)) {
        dependents_.push_back(k);
        roles_.later.insert(k);
        varied[k] = false;
      }
    samples_ = samples_near(request.initial_y, varied, request.parameters, request.parameter_range, kSamples);
  }

  std::variant<ClosedForm, std::string> run() {
    for (const PositionBlock& block : request_.blocks) {
      const std::size_t count = block.dependents.size() + (block.rotation ? 3 : 0);
      JD_CHECK(block.rows.size() == count, "{} rows for {} unknowns", block.rows.size(), count);
      if (block.dependents.size() > kScalars) return fmt::format("block of {} unknowns", count);
      if (std::string failure = solve_block(block); !failure.empty()) return failure;
    }
    for (const VelocityBlock& block : request_.velocities)
      if (std::string failure = require_regular(block); !failure.empty()) return failure;
    if (std::string failure = check_start(); !failure.empty()) return failure;
    ClosedForm result{closing_program()};
    if (std::string failure = check(result.close); !failure.empty()) return failure;
    const auto reached = proven(conditions_);
    if (const auto* failure = std::get_if<std::string>(&reached)) return *failure;
    result.smallest_margin = std::get<Reached>(reached).margin;
    result.box.positions = std::get<Reached>(reached).positions;
    if (!determinants_.empty()) {
      const auto regular = proven(determinants_, {}, "determinant");
      if (const auto* failure = std::get_if<std::string>(&regular)) return *failure;
      result.least_determinant = std::sqrt(std::get<Reached>(regular).margin);
      add_positions(std::get<Reached>(regular), result.box.positions);
    }
    for (const Elimination& elimination : request_.eliminations)
      result.has_pivots.push_back(has_pivots(elimination, result.box.positions));
    list_parameters(result);
    return result;
  }

 private:
  std::variant<Reached, std::string> proven(const std::vector<Requirement>& requirements, Effort effort = {},
                                            const char* margin = "discriminant") const {
    return smallest_margin(
        {builder_, requirements, request_.parameters, request_.angular, request_.range, roles_.names,
         dependents_, request_.parameter_range, request_.parameter_names, margin},
        effort);
  }

  /// Those entries of G at the dependents found, by row.
  std::variant<std::vector<ir::Column>, std::string> jacobian(const std::vector<std::size_t>& rows,
                                                              const std::vector<std::size_t>& columns) {
    std::vector<ir::ValueId> values;
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (const ir::Output& output : request_.jacobian.outputs) {
      const auto place = [&](const std::vector<std::size_t>& list, int subscript) {
        return static_cast<std::size_t>(
            std::find(list.begin(), list.end(), static_cast<std::size_t>(subscript)) - list.begin());
      };
      if (output.name != "G") continue;
      const std::size_t i = place(rows, output.row), j = place(columns, output.column);
      if (i == rows.size() || j == columns.size()) continue;
      values.push_back(output.value);
      places.emplace_back(i, j);
    }
    Roles roles = roles_;
    roles.unknowns.clear();
    roles.rotation.reset();
    if (rotations_.size() == 1) {  // its matrix has narrower bounds than the quaternion
      roles.rotation = rotations_.begin()->first;
      for (std::size_t k = 0; k < 4; ++k) roles.known.erase(*roles.rotation + k);
    }
    const auto entries = polynomials_of(builder_, request_.jacobian, values, roles);
    if (const auto* failure = std::get_if<std::string>(&entries)) return *failure;
    const std::size_t n = rows.size();
    std::vector<ir::Column> A(n, ir::Column(n, builder_.literal(0)));
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Polynomial& entry = std::get<std::vector<Polynomial>>(entries)[k];
      A[places[k].first][places[k].second] = at_rotation(entry, roles.rotation).value;
    }
    return A;
  }

  /// Puts the determinants of what velocities are solved for among the requirements. Otherwise why they are none.
  std::string require_regular(const VelocityBlock& block) {
    const auto A = jacobian(block.rows, block.dependents);
    if (const auto* failure = std::get_if<std::string>(&A))
      return fmt::format("velocities of {}: {}", block.names, *failure);
    const DenseSolver solver(builder_, std::get<std::vector<ir::Column>>(A));
    const bool is_square = block.rows.size() > DenseSolver::kLargestByCofactors;
    const double start = initial({&builder_, solver.determinant()}, samples_);
    if (!(std::fabs(start) > 0))
      return fmt::format("velocities of {} do not follow at the start", block.names);
    const ir::Signed share = builder_.multiply(builder_.literal(1 / start), solver.determinant());
    determinants_.push_back(
        {is_square ? share : builder_.multiply(share, share), true, "the velocities of " + block.names});
    return "";
  }

  /// Adds to the positions for which that is so.
  bool has_pivots(const Elimination& elimination, std::vector<ProvenRange>& positions) {
    const auto A = jacobian(elimination.rows, elimination.columns);
    if (std::holds_alternative<std::string>(A)) return false;
    const DenseSolver solver(builder_, std::get<std::vector<ir::Column>>(A), true);
    std::vector<Requirement> requirements;
    for (const ir::Signed& pivot : solver.pivots()) {
      const bool is_positive = initial({&builder_, pivot}, samples_) > 0;
      requirements.push_back({is_positive ? pivot : -pivot, false, "a pivot"});
    }
    const auto reached = proven(requirements, {.boxes = kPivotBoxes, .is_sharp = false});
    if (std::holds_alternative<std::string>(reached)) return false;
    add_positions(std::get<Reached>(reached), positions);
    return true;
  }

  static void add_positions(const Reached& reached, std::vector<ProvenRange>& positions) {
    for (const ProvenRange& range : reached.positions)
      if (std::none_of(positions.begin(), positions.end(),
                       [&](const ProvenRange& known) { return known.index == range.index; }))
        positions.push_back(range);
  }

  /// A polynomial of nothing but the entries of one known rotation.
  Scalar at_rotation(const Polynomial& polynomial, const std::optional<std::size_t>& rotation) {
    Scalar sum = {&builder_, builder_.literal(0)};
    for (const auto& [powers, coefficient] : polynomial) {
      Scalar term = coefficient;
      for (std::size_t i = 0; rotation && i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          for (int n = rotation_power(powers, i, j); n > 0; --n)
            term = term * rotations_.at(*rotation).columns[j][i];
      sum = sum + term;
    }
    return sum;
  }

  std::vector<ir::ValueId> values_of(const std::vector<std::size_t>& rows) const {
    std::vector<ir::ValueId> values;
    for (const std::size_t row : rows)
      for (const ir::Output& output : request_.g.outputs)
        if (output.row == static_cast<int>(row)) values.push_back(output.value);
    return values;
  }

  /// Of y.
  static std::vector<std::size_t> entries_of(const PositionBlock& block) {
    std::vector<std::size_t> entries = block.dependents;
    for (std::size_t k = 0; block.rotation && k < 4; ++k) entries.push_back(*block.rotation + k);
    return entries;
  }

  std::vector<Requirement> all_conditions() const {
    std::vector<Requirement> all = conditions_;
    all.insert(all.end(), determinants_.begin(), determinants_.end());
    return all;
  }

  ir::Program closing_program() const {
    ir::Builder closing = builder_;
    ir::Signed regularity = closing.literal(1), opening = closing.literal(0);
    for (const std::size_t k : dependents_) {
      const ir::Signed found = roles_.known.at(k).value.value;
      closing.output("y", static_cast<int>(k), -1, found);
      const ir::Signed change = closing.subtract(found, closing.leaf(LeafKind::kPosition, k));
      opening = closing.add(opening, closing.multiply(change, change));
    }
    for (const Requirement& condition : all_conditions())
      if (condition.is_margin) regularity = closing.multiply(regularity, condition.value);
    closing.output("regularity", -1, -1, regularity);
    closing.output("opening", -1, -1, opening);
    return passes::remove_dead_code(closing.finish("close_loops"));
  }

  std::string names_of(const std::vector<std::size_t>& entries) const {
    std::string text;
    for (const std::size_t k : entries)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", roles_.names[k]);
    return text;
  }

  /// Those that the constraints depend on.
  void list_parameters(ClosedForm& result) const {
    std::vector<bool> enters(request_.parameter_names.size(), false);
    const auto look = [&enters](const Program& rows) {
      for (const ir::Node& node : rows.nodes)
        if (node.op == ir::Op::kLeaf && node.leaf == LeafKind::kParameter && node.index < enters.size())
          enters[node.index] = true;
    };
    look(request_.g);
    if (!request_.velocities.empty()) look(request_.jacobian);
    for (std::size_t k = 0; k < enters.size(); ++k) {
      if (!enters[k]) continue;
      const auto& range = request_.parameter_range[k];
      const double value = request_.parameters[k];
      result.box.parameters.push_back({k, range ? (*range)[0] : value, range ? (*range)[1] : value});
      if (!range) result.at_defaults.push_back(request_.parameter_names[k]);
    }
  }

  /// Puts the block's dependents among the known coordinates. Otherwise why not.
  std::string solve_block(const PositionBlock& block) {
    for (const std::size_t k : entries_of(block)) roles_.later.erase(k);
    roles_.unknowns = block.dependents;
    roles_.rotation = block.rotation;
    auto expanded = polynomials_of(builder_, request_.g, values_of(block.rows), roles_);
    if (const auto* failure = std::get_if<std::string>(&expanded)) return *failure;
    auto& rows = std::get<std::vector<Polynomial>>(expanded);
    drop_nothing(rows, samples_, request_.nothing);
    if (block.rotation) return take(entries_of(block), solved_rotation(block, rows));
    if (const auto first = row_of_one(rows)) {
      const auto [row, unknown] = *first;
      const std::size_t entry = block.dependents[unknown], other = block.dependents[1 - unknown];
      std::string failure = solve_rows({substituted(rows[row], 1 - unknown, {})}, {entry});
      if (!failure.empty()) return failure;
      return solve_rows({substituted(rows[1 - row], unknown, roles_.known.at(entry))}, {other});
    }
    return solve_rows(rows, block.dependents);
  }

  std::string solve_rows(const std::vector<Polynomial>& rows, const std::vector<std::size_t>& entries) {
    std::vector<double> initial;
    for (const std::size_t k : entries) initial.push_back(request_.initial_y[k]);
    return take(entries, solve(builder_, rows, initial, samples_));
  }

  std::variant<Solution, std::string> solved_rotation(const PositionBlock& block,
                                                      const std::vector<Polynomial>& rows) {
    if (block.dependents.size() > 1) return "more than one coordinate beside a rotation in space";
    const std::vector<double>& y = request_.initial_y;
    const auto first = y.begin() + static_cast<std::ptrdiff_t>(*block.rotation);
    std::array<double, 4> quaternion;
    std::copy(first, first + 4, quaternion.begin());
    const auto scalar = block.dependents.empty() ? std::nullopt : std::optional(y[block.dependents[0]]);
    std::vector<RotationRow> list;
    for (std::size_t r = 0; r < rows.size(); ++r) list.push_back({rows[r], rod_of(block.rows[r])});
    return solve_rotation(builder_, list, scalar, quaternion, samples_);
  }

  std::optional<RodRow> rod_of(std::size_t row) {
    std::vector<ir::ValueId> values;
    for (const ir::Output& output : request_.spans.outputs)
      if (output.row == static_cast<int>(row)) values.push_back(output.value);
    if (values.empty()) return std::nullopt;
    const auto found = polynomials_of(builder_, request_.spans, values, roles_);
    if (std::holds_alternative<std::string>(found)) return std::nullopt;
    const auto& entries = std::get<std::vector<Polynomial>>(found);
    const auto length = entries[3].find(kConstant);
    if (length == entries[3].end()) return std::nullopt;
    return RodRow{{entries[0], entries[1], entries[2]}, length->second};
  }

  /// Puts what is solved among the known coordinates. Otherwise why there is nothing.
  std::string take(const std::vector<std::size_t>& entries,
                   const std::variant<Solution, std::string>& solved) {
    if (const auto* failure = std::get_if<std::string>(&solved))
      return fmt::format("{}: {}", names_of(entries), *failure);
    const auto& solution = std::get<Solution>(solved);
    for (std::size_t k = 0; k < entries.size(); ++k)
      roles_.known[entries[k]] = placed(entries[k], solution.unknowns[k]);
    if (solution.rotation) rotations_[entries[entries.size() - 4]] = *solution.rotation;
    for (const Condition& condition : solution.conditions)
      conditions_.push_back({condition.value.value, condition.is_margin, names_of(entries)});
    return "";
  }

  /// A row of two that has one unknown only, and which: the other row then has the other.
  static std::optional<std::pair<std::size_t, std::size_t>> row_of_one(const std::vector<Polynomial>& rows) {
    if (rows.size() != 2) return std::nullopt;
    for (const std::size_t row : {std::size_t{0}, std::size_t{1}})
      for (const std::size_t unknown : {std::size_t{0}, std::size_t{1}})
        if (depends_on(rows[row], unknown) && !depends_on(rows[row], 1 - unknown) &&
            depends_on(rows[1 - row], 1 - unknown))
          return std::pair{row, unknown};
    return std::nullopt;
  }

  /// An angle from its direction: the given one, turned by less than half a turn.
  Known placed(std::size_t entry, Known found) {
    if (!found.direction) return found;
    const Scalar given = {&builder_, builder_.leaf(LeafKind::kPosition, entry)};
    const Vector2 turn = times_conjugate(*found.direction, {cosine(given), sine(given)});
    found.value = given + angle_of(turn.x, turn.y);
    return found;
  }

  /// The branch of the initial state is that over the ranges only where it begins within them.
  std::string check_start() const {
    for (std::size_t k = 0; k < request_.range.size(); ++k) {
      const auto& range = request_.range[k];
      const double value = request_.initial_y[k];
      const bool is_free = std::find(dependents_.begin(), dependents_.end(), k) == dependents_.end();
      if (range && is_free && !(value >= (*range)[0] - kAssembled && value <= (*range)[1] + kAssembled))
        return fmt::format("{} starts at {:.6g}, outside its range", roles_.names[k], value);
    }
    return "";
  }

  /// Does the result solve the equation near the initial state, and is that a solution itself?
  std::string check(const Program& close) const {
    const std::vector<bool> dead = nearly_dead();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (dead[i]) continue;
      ir::LeafValues<double> leaves = samples_[i];
      const std::vector<double> y = ir::interpret(close, leaves);
      for (std::size_t k = 0; k < dependents_.size(); ++k) {
        const double change = y[k] - request_.initial_y[dependents_[k]];
        if (i == 0 && !(std::fabs(change) <= kAssembled))
          return fmt::format("the initial state does not close the loop: {} is off by {:.2g}",
                             roles_.names[dependents_[k]], change);
        leaves[LeafKind::kPosition][dependents_[k]] = y[k];
      }
      if (std::string failure = check_residual(leaves); !failure.empty()) return failure;
    }
    return "";
  }

  /// By state: is a condition nearly lost there? Roots and quotients magnify rounding.
  std::vector<bool> nearly_dead() const {
    std::vector<Scalar> values;
    ir::Builder copy = builder_;
    for (const Requirement& condition : all_conditions()) values.push_back({&copy, condition.value});
    const std::vector<std::vector<double>> found = evaluated(values, samples_);
    std::vector<bool> dead;
    for (const std::vector<double>& at : found) {
      bool is_dead = false;
      for (std::size_t k = 0; k < at.size(); ++k)
        is_dead = is_dead || !(at[k] > kNearlyDead * found.front()[k]);
      dead.push_back(is_dead);
    }
    return dead;
  }

  std::string check_residual(ir::LeafValues<double> leaves) const {
    const std::vector<double> g = ir::interpret(request_.g, leaves);
    for (const std::size_t k : dependents_) leaves[LeafKind::kPosition][k] += 1;
    const std::vector<double> away = ir::interpret(request_.g, leaves);
    double scale = 0;
    for (std::size_t r = 0; r < g.size(); ++r) scale = std::max(scale, std::fabs(away[r] - g[r]));
    for (const double row : g)
      if (std::fabs(row) > kResidual * scale)
        return "its constraint is none of those that are solved in closed form";
    return "";
  }

  const ClosedFormRequest& request_;
  ir::Builder builder_;
  Roles roles_;
  std::map<std::size_t, Matrix3> rotations_;  ///< found, by the entry of y of the quaternion's w
  std::vector<std::size_t> dependents_;       ///< in order of solution
  Samples samples_;
  std::vector<Requirement> conditions_;
  std::vector<Requirement> determinants_;  ///< of what velocities are solved for
};

}  // namespace

std::variant<ClosedForm, std::string> closed_form(const ClosedFormRequest& request) {
  return Closing(request).run();
}

}  // namespace jourdain::loops
