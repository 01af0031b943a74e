#include "lowering/displacements.hpp"

namespace jourdain::lowering {

using ir::Builder;
using ir::LeafKind;
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

}  // namespace jourdain::lowering
