#include "loops/regularity/regularity_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ir/compose.hpp"
#include "loops/rows/timeless.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::LeafKind;
using ir::Program;

namespace {

using support::at;

class Layout {
 public:
  explicit Layout(const RegularityRequest& request) : request_(request) {}

  std::variant<RegularityLayout, std::string> run() {
    if (std::string failure = lay_out(); !failure.empty()) return failure;
    return std::move(result_);
  }

 private:
  std::string lay_out() {
    ir::Builder builder;
    const Program rows = used_rows();
    const Timeless timeless = without_clock(builder, rows, request_.initial_y.size());
    if (timeless.drives_with_positions)
      return "an angle depends on time and on coordinates, but not by a sum";
    for (std::size_t i = 0; i < timeless.values.size(); ++i)
      builder.output("g", static_cast<int>(i), -1, timeless.values[i]);
    result_.g = passes::remove_dead_code(builder.finish("g"));
    result_.problem.tangent = request_.tangent;
    result_.problem.positions = request_.initial_y.size();
    result_.problem.iterations = request_.iterations;
    list_unknowns();
    for (const ir::ValueId angle : timeless.driven) driven_.push_back(value_at_start(rows, angle));
    if (std::string failure = list_free(); !failure.empty()) return failure;
    ir::LeafValues<double> fixed;
    fixed[LeafKind::kParameter] = request_.parameters;
    fixed[LeafKind::kPosition] = request_.initial_y;
    fixed[LeafKind::kPosition].insert(fixed[LeafKind::kPosition].end(), driven_.begin(), driven_.end());
    fixed[LeafKind::kTime] = {0};
    std::vector<Variable> unknowns, free;
    for (const std::size_t k : result_.unknowns) unknowns.push_back({LeafKind::kPosition, k});
    for (const FreeVariable& f : result_.free) free.push_back(f.leaf);
    result_.equations.emplace(with_unit_lengths(result_.g), unknowns, free, fixed, request_.evaluate);
    result_.start = Eigen::VectorXd(at(result_.unknowns.size()));
    for (std::size_t i = 0; i < result_.unknowns.size(); ++i)
      result_.start[at(i)] = request_.initial_y[result_.unknowns[i]];
    return "";
  }

  /// Rows of the blocks, in their order; `result_.problem.blocks` counts them anew.
  Program used_rows() {
    Program rows = request_.g;
    rows.outputs.clear();
    for (const Block& block : request_.blocks) {
      result_.problem.blocks.push_back({{}, block.dependents});
      for (const std::size_t r : block.rows) {
        const auto output = std::find_if(request_.g.outputs.begin(), request_.g.outputs.end(),
                                         [&](const auto& o) { return o.row == static_cast<int>(r); });
        JD_CHECK(output != request_.g.outputs.end(), "no row {}", r);
        result_.problem.blocks.back().rows.push_back(rows.outputs.size());
        rows.outputs.push_back(*output);
      }
    }
    return passes::remove_dead_code(rows);
  }

  void list_unknowns() {
    std::set<std::size_t> velocities;
    for (const Block& block : result_.problem.blocks)
      velocities.insert(block.dependents.begin(), block.dependents.end());
    for (const model::Tangent::Scalar& s : request_.tangent.scalars) {
      result_.problem.velocities = std::max(result_.problem.velocities, s.velocity + 1);
      result_.problem.slides.resize(std::max(result_.problem.slides.size(), result_.problem.velocities),
                                    false);
      result_.problem.slides[s.velocity] = !request_.angular[s.position];
      if (velocities.count(s.velocity) == 0) continue;
      result_.unknowns.push_back(s.position);
      result_.problem.slide_unknowns.push_back(!request_.angular[s.position]);
    }
    for (const model::Tangent::Scalar& s : request_.tangent.quaternions) {
      result_.problem.velocities = std::max(result_.problem.velocities, s.velocity + 3);
      if (velocities.count(s.velocity) == 0) continue;
      result_.quaternions.push_back(s.position);
      for (std::size_t k = 0; k < 4; ++k) result_.unknowns.push_back(s.position + k);
      result_.problem.slide_unknowns.resize(result_.unknowns.size(), false);
    }
    result_.problem.slides.resize(result_.problem.velocities, false);
  }

  double value_at_start(Program program, ir::ValueId value) const {
    program.outputs = {{"angle", -1, -1, value}};
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kParameter] = request_.parameters;
    leaves[LeafKind::kPosition] = request_.initial_y;
    leaves[LeafKind::kTime] = {0};
    return ir::interpret(program, leaves)[0];
  }

  /// (|quaternion|² − 1)/2 = 0 after the rows.
  Program with_unit_lengths(const Program& g) const {
    ir::Builder builder;
    std::vector<ir::Signed> values = ir::insert(builder, g);
    for (const std::size_t w : result_.quaternions) {
      ir::Signed sum = builder.literal(-0.5);
      for (std::size_t k = 0; k < 4; ++k) {
        const ir::Signed entry = builder.leaf(LeafKind::kPosition, w + k);
        const ir::Signed square = builder.multiply(entry, entry);
        sum = builder.add(sum, builder.multiply(builder.literal(0.5), square));
      }
      values.push_back(sum);
    }
    for (std::size_t i = 0; i < values.size(); ++i) builder.output("g", static_cast<int>(i), -1, values[i]);
    return builder.finish("g");
  }

  /// The leaves that the rows depend on beside the unknowns.
  std::string list_free() {
    std::set<std::size_t> positions, parameters;
    for (const ir::Node& node : result_.g.nodes) {
      if (node.op != ir::Op::kLeaf) continue;
      if (node.leaf == LeafKind::kTime) return "a constraint depends on time other than by an angle's sine";
      (node.leaf == LeafKind::kPosition ? positions : parameters).insert(node.index);
    }
    for (const std::size_t k : result_.unknowns) positions.erase(k);
    for (const std::size_t k : positions) {
      const std::size_t ny = request_.initial_y.size();
      FreeVariable free;
      free.leaf = {LeafKind::kPosition, k};
      free.name = k < ny ? request_.names[k] : "driven angle";
      free.start = k < ny ? request_.initial_y[k] : driven_[k - ny];
      const Range range = k < ny ? request_.range[k] : std::nullopt;
      free.is_circle = !range;
      if (range) free.side = {(*range)[0], (*range)[1]};
      if (!range && !((k >= ny || request_.angular[k]) && is_periodic(result_.g, k)))
        return fmt::format("the constraints depend on {}, which has no range", free.name);
      if (range && !free.side.contains(free.start))
        return fmt::format("{} starts at {:.6g}, outside its range", free.name, free.start);
      result_.free.push_back(free);
    }
    list_ranges();
    for (const std::size_t k : parameters) {
      if (!request_.parameter_range[k]) {
        result_.at_defaults.push_back(request_.parameter_names[k]);
        result_.box.parameters.push_back({k, request_.parameters[k], request_.parameters[k]});
        continue;
      }
      const auto [low, high] = *request_.parameter_range[k];
      result_.box.parameters.push_back({k, low, high});
      result_.free.push_back({{LeafKind::kParameter, k},
                              request_.parameter_names[k],
                              request_.parameters[k],
                              {low, high},
                              false,
                              true});
    }
    return "";
  }

  /// Of the positions that the rows depend on.
  void list_ranges() {
    std::set<std::size_t> entries(result_.unknowns.begin(), result_.unknowns.end());
    for (const FreeVariable& free : result_.free) entries.insert(free.leaf.index);
    for (const std::size_t k : entries)
      if (k < request_.range.size() && request_.range[k])
        result_.box.positions.push_back({k, (*request_.range[k])[0], (*request_.range[k])[1]});
  }

  const RegularityRequest& request_;
  RegularityLayout result_;
  std::vector<double> driven_;  ///< angles at t = 0
};

}  // namespace

std::variant<RegularityLayout, std::string> lay_out(const RegularityRequest& request) {
  return Layout(request).run();
}

}  // namespace jourdain::loops
