#include "programs/loop_outputs.hpp"

#include <algorithm>
#include <map>

namespace jourdain::programs {

using ir::Builder;
using ir::Output;
using ir::Program;
using ir::Signed;

namespace {

/// The members of one Jacobian output, as they come: the matrices first.
class JacobianOutput {
 public:
  JacobianOutput(Builder& builder, const loops::Dependence& dependence)
      : builder_(builder), dependence_(dependence) {}

  void write(const Output& output, Signed value) {
    const std::string member = output.name.substr(output.name.find('.') + 1);
    if (member == "J_t" || member == "J_r") {
      ir::Column& row = rows_[{member, output.row}];
      row.push_back(value);
      if (row.size() == dependence_.z().size()) write_row(output, row);
      return;
    }
    const bool translates = member == "v_bar" || member == "a_bar";
    const bool of_velocity = member == "v_bar" || member == "omega_bar";
    const ir::Column& row = rows_[{translates ? "J_t" : "J_r", output.row}];
    const ir::Column& driven = of_velocity ? dependence_.b() : dependence_.beta();
    for (std::size_t k = 0; k < row.size(); ++k)
      value = builder_.add(value, builder_.multiply(row[k], driven[k]));
    builder_.output(output.name, output.row, -1, value);
  }

 private:
  void write_row(const Output& output, const ir::Column& row) {
    const ir::Column entries = dependence_.projected(row);
    for (std::size_t j = 0; j < entries.size(); ++j)
      builder_.output(output.name, output.row, static_cast<int>(j), entries[j]);
  }

  Builder& builder_;
  const loops::Dependence& dependence_;
  std::map<std::pair<std::string, int>, ir::Column> rows_;  ///< of the tree's matrices
};

}  // namespace

bool takes_multipliers(const Program& tree) {
  return std::any_of(tree.nodes.begin(), tree.nodes.end(), [](const ir::Node& node) {
    return node.op == ir::Op::kLeaf && node.leaf == ir::LeafKind::kMultiplier;
  });
}

void write_outputs(Builder& builder, const loops::LoopSystem& system, const loops::Dependence& dependence,
                   const Program& tree, const ir::Column& values) {
  std::map<std::string, JacobianOutput> jacobians;
  if (system.plan.is_reduced())
    for (const model::Output& output : system.mechanism.outputs)
      if (output.kind == model::OutputKind::kJacobian)
        jacobians.emplace(output.name, JacobianOutput(builder, dependence));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Output& output = tree.outputs[k];
    const auto jacobian = jacobians.find(output.name.substr(0, output.name.find('.')));
    if (jacobian != jacobians.end())
      jacobian->second.write(output, values[k]);
    else
      builder.output(output.name, output.row, output.column, values[k]);
  }
}

void write_samples(Builder& builder, const loops::LoopSystem& system, const loops::Dependence& dependence,
                   const ir::Column& values) {
  const std::vector<model::StateVariable>& states = system.mechanism.states;
  std::size_t next = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].sampled) continue;
    const std::size_t entry = dependence.independent_count() - states.size() + i;
    builder.output("z", static_cast<int>(entry), -1, values[next++]);
  }
}

}  // namespace jourdain::programs
