#include "loops/closed_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loops/dyad.hpp"
#include "loops/reach.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::LeafKind;
using ir::Program;

namespace {

constexpr std::size_t kSamples = 9;
/// rad or length: the initial state is assembled to rounding, times what the mechanism's condition makes of it.
constexpr double kAssembled = 1e-6;
/// Of the change of g over a unit of the dependents: what a wrong form leaves is of size 1.
constexpr double kResidual = 1e-9;

class Closing {
 public:
  explicit Closing(const ClosedFormRequest& request) : request_(request) {
    roles_.names = request.names;
    for (std::size_t k = roles_.names.size(); k < request.initial_y.size(); ++k)
      roles_.names.push_back(fmt::format("y[{}]", k));
    std::vector<bool> varied(request.initial_y.size(), true);
    for (const PositionBlock& block : request.blocks)
      for (const std::size_t k : block.dependents) {
        dependents_.push_back(k);
        roles_.later.insert(k);
        varied[k] = false;
      }
    samples_ = samples_near(request.initial_y, varied, request.parameters, request.parameter_range, kSamples);
  }

  std::variant<ClosedForm, std::string> run() {
    for (const PositionBlock& block : request_.blocks) {
      JD_CHECK(block.rows.size() == block.dependents.size(), "{} rows for {} unknowns", block.rows.size(),
               block.dependents.size());
      if (block.dependents.size() > 2) return fmt::format("block of {} unknowns", block.dependents.size());
      if (const std::string failure = solve_block(block); !failure.empty()) return failure;
    }
    ClosedForm result{closing_program()};
    if (const std::string failure = check(result.close); !failure.empty()) return failure;
    const auto reached =
        smallest_margin({builder_, conditions_, request_.parameters, request_.angular, request_.range,
                         roles_.names, dependents_, request_.parameter_range, request_.parameter_names});
    if (const auto* failure = std::get_if<std::string>(&reached)) return *failure;
    result.smallest_margin = std::get<Reached>(reached).margin;
    result.box.positions = std::get<Reached>(reached).positions;
    list_parameters(result);
    return result;
  }

 private:
  ir::Program closing_program() const {
    ir::Builder closing = builder_;
    ir::Signed regularity = closing.literal(1), opening = closing.literal(0);
    for (const std::size_t k : dependents_) {
      const ir::Signed found = roles_.known.at(k).value.value;
      closing.output("y", static_cast<int>(k), -1, found);
      const ir::Signed change = closing.subtract(found, closing.leaf(LeafKind::kPosition, k));
      opening = closing.add(opening, closing.multiply(change, change));
    }
    for (const Requirement& condition : conditions_)
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
    for (const ir::Node& node : request_.g.nodes)
      if (node.op == ir::Op::kLeaf && node.leaf == LeafKind::kParameter && node.index < enters.size())
        enters[node.index] = true;
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
    for (const std::size_t k : block.dependents) roles_.later.erase(k);
    roles_.unknowns = block.dependents;
    auto expanded = polynomials_of(builder_, request_.g, block.rows, roles_);
    if (const auto* failure = std::get_if<std::string>(&expanded)) return *failure;
    auto& rows = std::get<std::vector<Polynomial>>(expanded);
    drop_rounding(rows, samples_);
    if (const auto first = row_of_one(rows)) {
      const auto [row, unknown] = *first;
      const std::size_t entry = block.dependents[unknown], other = block.dependents[1 - unknown];
      const std::string failure = solve_rows({substituted(rows[row], 1 - unknown, {})}, {entry});
      if (!failure.empty()) return failure;
      return solve_rows({substituted(rows[1 - row], unknown, roles_.known.at(entry))}, {other});
    }
    return solve_rows(rows, block.dependents);
  }

  std::string solve_rows(const std::vector<Polynomial>& rows, const std::vector<std::size_t>& entries) {
    std::vector<double> initial;
    for (const std::size_t k : entries) initial.push_back(request_.initial_y[k]);
    const auto solved = solve(builder_, rows, initial, samples_);
    if (const auto* failure = std::get_if<std::string>(&solved))
      return fmt::format("{}: {}", names_of(entries), *failure);
    const Solution& solution = std::get<Solution>(solved);
    for (std::size_t k = 0; k < entries.size(); ++k)
      roles_.known[entries[k]] = placed(entries[k], solution.unknowns[k]);
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

  /// Does the result solve the equation near the initial state, and is that a solution itself?
  std::string check(const Program& close) const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      ir::LeafValues<double> leaves = samples_[i];
      const std::vector<double> y = ir::interpret(close, leaves);
      for (std::size_t k = 0; k < dependents_.size(); ++k) {
        const double change = y[k] - request_.initial_y[dependents_[k]];
        if (i == 0 && !(std::fabs(change) <= kAssembled))
          return fmt::format("the initial state does not close the loop: {} is off by {:.2g}",
                             roles_.names[dependents_[k]], change);
        leaves[LeafKind::kPosition][dependents_[k]] = y[k];
      }
      if (const std::string failure = check_residual(leaves); !failure.empty()) return failure;
    }
    return "";
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
  std::vector<std::size_t> dependents_;  ///< in order of solution
  Samples samples_;
  std::vector<Requirement> conditions_;
};

}  // namespace

std::variant<ClosedForm, std::string> closed_form(const ClosedFormRequest& request) {
  return Closing(request).run();
}

}  // namespace jourdain::loops
