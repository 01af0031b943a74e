#include "compile/program_cost.hpp"

#include <set>
#include <utility>

#include "passes/pipeline.hpp"

namespace jourdain {

namespace {

/// Programs with more nodes are not taken through all passes.
constexpr std::size_t kLarge = 3000;

}  // namespace

ProgramCost cost_of(const ir::Program& program) {
  std::set<std::size_t> angles;
  for (const ir::Node& node : program.nodes)
    if (node.op == ir::Op::kSin || node.op == ir::Op::kCos) angles.insert(node.a.value);
  return {ir::count_operations(program).arithmetic(), angles.size()};
}

ProgramCost cost_behind_passes(ir::Program program) {
  const bool large = program.nodes.size() > kLarge;
  ir::Module module{{}, {std::move(program)}};
  module = large ? passes::optimise_once(std::move(module))
                 : passes::optimise(std::move(module), passes::uncompared_pass_names()).module;
  return cost_of(module.functions[0]);
}

}  // namespace jourdain
