#include "loops/rows/loop_system.hpp"

#include "ir/compose.hpp"
#include "lowering/displacements.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::Builder;
using ir::LeafKind;
using ir::Signed;

namespace {

using support::subscript;

ir::LeafValue with(LeafKind kind, const Column& values) {
  return [kind, &values](LeafKind leaf, std::size_t i) {
    return leaf == kind && !values.empty() ? std::optional(values[i]) : std::nullopt;
  };
}

}  // namespace

ConstraintValues::ConstraintValues(Builder& builder, const LoopSystem& system, const Column& y) {
  const std::size_t rows = system.constraints.value.outputs.size();
  g_ = ir::insert(builder, system.constraints.value, with(LeafKind::kPosition, y));
  g_t_.assign(rows, builder.literal(0));
  G_.assign(rows, Column(system.layout.velocity_count(), builder.literal(0)));
  const ir::Program& jacobian = system.constraints.jacobian;
  const Column values = ir::insert(builder, jacobian, with(LeafKind::kPosition, y));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = jacobian.outputs[k];
    (output.name == "g_t" ? g_t_[subscript(output.row)]
                          : G_[subscript(output.row)][subscript(output.column)]) = values[k];
  }
}

ConstraintRates constraint_rates(Builder& builder, const LoopSystem& system, const Column& z) {
  const ir::Program& program = system.constraints.rates;
  const Column values = ir::insert(builder, program, with(LeafKind::kVelocity, z));
  ConstraintRates rates;
  for (std::size_t k = 0; k < values.size(); ++k)
    (program.outputs[k].name == "rate" ? rates.rate : rates.gamma).push_back(values[k]);
  return rates;
}

std::vector<Column> tree_mass_matrix(Builder& builder, const LoopSystem& system) {
  const std::size_t n = system.layout.velocity_count();
  std::vector<Column> M(n, Column(n, builder.literal(0)));
  const ir::Program tree = system.tree(ir::FunctionId::kMassMatrix);
  const Column values = ir::insert(builder, tree);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t i = subscript(tree.outputs[k].row), j = subscript(tree.outputs[k].column);
    M[i][j] = M[j][i] = values[k];
  }
  return M;
}

Column position_leaves(Builder& builder, const LoopSystem& system) {
  Column y;
  for (std::size_t i = 0; i < system.layout.position_count(); ++i)
    y.push_back(builder.leaf(LeafKind::kPosition, i));
  return y;
}

Column position_rates(Builder& builder, const LoopSystem& system, const Column& z) {
  Column ydot(system.layout.position_count(), builder.literal(0));
  for (const ir::Seed& seed : lowering::displacement_seeds(builder, system.layout.tangent)) {
    const std::size_t i = builder.program()[seed.leaf.value].index;
    ydot[i] = builder.add(ydot[i], builder.multiply(seed.partial, z[seed.column]));
  }
  return ydot;
}

Column displaced(Builder& builder, const model::Tangent& tangent, const Column& y, const Column& d) {
  Column moved = y;
  for (const model::Tangent::Scalar& s : tangent.scalars)
    moved[s.position] = builder.add(y[s.position], d[s.velocity]);
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    bool rests = true;
    for (std::size_t k = 0; k < 3; ++k) rests = rests && builder.is_literal(d[s.velocity + k], 0);
    if (rests) continue;
    Signed q[4], half[3], p[4];
    for (std::size_t k = 0; k < 4; ++k) q[k] = y[s.position + k];
    for (std::size_t k = 0; k < 3; ++k) half[k] = builder.multiply(builder.literal(0.5), d[s.velocity + k]);
    p[0] = q[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      p[0] = builder.subtract(p[0], builder.multiply(q[1 + k], half[k]));
      p[1 + k] = builder.add(q[1 + k], builder.multiply(q[0], half[k]));
      p[1 + k] = builder.add(p[1 + k], builder.multiply(q[1 + l], half[m]));
      p[1 + k] = builder.subtract(p[1 + k], builder.multiply(q[1 + m], half[l]));
    }
    Signed square = builder.literal(0);
    for (const Signed& entry : p) square = builder.add(square, builder.multiply(entry, entry));
    const Signed length = builder.unary(ir::Op::kSqrt, square),
                 factor = builder.divide(builder.literal(1), length);
    for (std::size_t k = 0; k < 4; ++k) moved[s.position + k] = builder.multiply(factor, p[k]);
  }
  return moved;
}

}  // namespace jourdain::loops
