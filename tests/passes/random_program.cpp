#include "passes/random_program.hpp"

#include "ir/builder.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

using ir::LeafKind;
using ir::Signed;

namespace {
constexpr std::size_t kLeaves = 3;
}

ir::Program random_program(std::uint64_t seed) {
  Random random(seed);
  ir::Builder builder;
  std::vector<Signed> values;
  for (std::size_t i = 0; i < kLeaves; ++i) {
    values.push_back(builder.leaf(LeafKind::kParameter, i));
    values.push_back(builder.leaf(LeafKind::kPosition, i));
  }
  values.push_back(builder.literal(2.5));
  const auto any = [&] {
    const Signed value = values[random.below(values.size())];
    return random.chance(0.2) ? -value : value;
  };
  for (int i = 0; i < 40; ++i) {
    const Signed a = any(), b = any();
    switch (random.below(7)) {
      case 0:
        values.push_back(builder.unary(ir::Op::kSin, a));
        break;
      case 1:
      case 2:
      case 3:
        values.push_back(builder.multiply(a, b));
        break;
      default:
        values.push_back(builder.add(a, b));
        break;
    }
  }
  for (int i = 0; i < 3; ++i) builder.output("r", i, -1, values[values.size() - 1 - std::size_t(i)]);
  return builder.finish("random");
}

ir::LeafValues<double> random_leaves(std::uint64_t seed) {
  Random random(seed + 1000);
  ir::LeafValues<double> leaves;
  for (std::size_t i = 0; i < kLeaves; ++i) {
    leaves[LeafKind::kParameter].push_back(random.uniform(-1, 1));
    leaves[LeafKind::kPosition].push_back(random.uniform(-1, 1));
  }
  return leaves;
}

}  // namespace jourdain::tests
