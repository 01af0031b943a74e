#include "lowering/cheapest_elimination.hpp"

#include "passes/pipeline.hpp"

namespace jourdain::lowering {

using ir::Builder;
using ir::EliminationOrder;
using ir::LeafKind;
using ir::Program;
using ir::Seed;
using ir::Signed;

namespace {

/// ½ quat ⊗ (0, e_k)
void add_quaternion(Builder& builder, const model::Tangent::Scalar& at, std::vector<Seed>& list) {
  Signed q[4], half[4];
  for (std::size_t k = 0; k < 4; ++k) {
    q[k] = builder.leaf(LeafKind::kPosition, at.position + k);
    half[k] = builder.multiply(builder.literal(0.5), q[k]);
  }
  const Signed by[4][3] = {{-half[1], -half[2], -half[3]},
                           {half[0], -half[3], half[2]},
                           {half[3], half[0], -half[1]},
                           {-half[2], half[1], half[0]}};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) list.push_back({q[k], at.velocity + c, by[k][c]});
}

}  // namespace

std::vector<Seed> displacement_seeds(Builder& builder, const model::Tangent& tangent) {
  std::vector<Seed> list;
  for (const model::Tangent::Scalar& s : tangent.scalars)
    list.push_back({builder.leaf(LeafKind::kPosition, s.position), s.velocity, builder.literal(1)});
  for (const model::Tangent::Scalar& s : tangent.quaternions) add_quaternion(builder, s, list);
  return list;
}

std::size_t remaining_operations(const Program& program) {
  ir::Module module;
  module.functions = {program};
  return ir::count_operations(passes::optimise_once(std::move(module)).functions[0]).arithmetic();
}

std::size_t emitted_operations(const Program& program) {
  ir::Module module;
  module.functions = {program};
  return ir::count_operations(passes::optimise(std::move(module)).module.functions[0]).arithmetic();
}

/// On the robot arms the first quarter of the program goes forward: rotations and velocities.
Program cheapest(const std::function<Program(EliminationOrder)>& build) {
  constexpr std::size_t kLarge = 10000;  // operations beyond which few orders are tried
  Program best = build(EliminationOrder{0});
  std::size_t fewest = remaining_operations(best);
  const auto compare = [&](double forward) {
    Program other = build(EliminationOrder{forward});
    const std::size_t operations = remaining_operations(other);
    if (operations >= fewest) return;
    fewest = operations;
    best = std::move(other);
  };
  const std::vector<double> few = {0.15, 0.5, 1}, many = {0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1};
  for (const double forward : fewest > kLarge ? few : many) compare(forward);
  return best;
}

}  // namespace jourdain::lowering
