// Small scenes of textbooks: operations against those of a good derivation by hand, one call of a function.
//
// By hand, for two links with the moments of inertia a, c and the coupling b between their rates: s = sin y2,
// k = cos y2, w = z1 + z2, everything divided by c. M of links' rates is [a, b k; b k, 1] and the forces are
// (b s w² − g1 sin y1, −b s z1² − g2 sin(y1 + y2)).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "compile/link_by_link.hpp"
#include "extremes/extreme_scenes.hpp"
#include "passes/pipeline.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain::tests {
namespace {

using ir::FunctionId;

constexpr const char* kWeightless = "[0, 0, 0]";
constexpr const char* kDown = "[0, -9.81, 0]";

std::string scene(const char* gravity) {
  return fmt::format("[model]\nname = \"scene\"\ngravity = {}\n", gravity);
}

/// A bar along −y that turns about z; its parent's bar is `at` long.
std::string bar(const char* name, const char* parent, double at, double inertia) {
  return fmt::format(
      "[[body]]\nname = \"{0}\"\nmass = 1.1\ncenter_of_mass = [0, -0.3, 0]\ninertia = [{3}, 0.02, {3}]\n"
      "[[joint]]\nname = \"at_{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"{0}\"\naxis = [0, 0, "
      "1]\n"
      "position = [0, {2}, 0]\n",
      name, parent, -at, inertia);
}

std::string arm(int links, const char* gravity) {
  std::string text = scene(gravity) + bar("b0", "world", 0, 0.1);
  for (int i = 1; i < links; ++i)
    text +=
        bar(fmt::format("b{}", i).c_str(), fmt::format("b{}", i - 1).c_str(), 0.7 + 0.1 * i, 0.1 + 0.01 * i);
  return text;
}

std::string slide(const char* name, const char* parent, const char* axis) {
  return fmt::format(
      "[[body]]\nname = \"{0}\"\nmass = 0.7\ninertia = [0.01, 0.01, 0.01]\n[[joint]]\nname = \"at_{0}\"\n"
      "type = \"prismatic\"\nparent = \"{1}\"\nchild = \"{0}\"\naxis = {2}\n",
      name, parent, axis);
}

std::string cart(int links) {
  std::string text = scene(kDown) + slide("b0", "world", "[1, 0, 0]");
  for (int i = 1; i <= links; ++i)
    text += bar(fmt::format("b{}", i).c_str(), fmt::format("b{}", i - 1).c_str(), i == 1 ? 0 : 0.8, 0.1);
  return text + "[[actuator]]\njoint = \"at_b0\"\n";
}

/// What one call takes as it is emitted.
class Emitted {
 public:
  explicit Emitted(const model::Mechanism& mechanism) {
    dynamics::DerivationOptions options;
    choose_articulation(mechanism, options).set(options);
    choose_recursions(mechanism, options);
    equations_ = dynamics::derive_equations(mechanism, options);
  }

  ir::Operations count(FunctionId function) const {
    ir::Module module{{}, {programs::lower_function(equations_, function)}};
    return ir::count_operations(passes::optimise(std::move(module)).module.functions[0]);
  }

 private:
  dynamics::Equations equations_;
};

struct Bound {
  FunctionId function;
  std::size_t by_hand;  ///< arithmetic
  std::size_t sines;    ///< and cosines
  std::size_t taken;    ///< arithmetic
};

void expect_counts(const model::Mechanism& mechanism, const std::vector<Bound>& bounds) {
  const Emitted emitted(mechanism);
  for (const Bound& bound : bounds) {
    const ir::Operations count = emitted.count(bound.function);
    EXPECT_LE(count.arithmetic(), bound.by_hand) << ir::name_of(bound.function);
    EXPECT_EQ(count.arithmetic(), bound.taken) << ir::name_of(bound.function);
    EXPECT_EQ(count.sin + count.cos, bound.sines) << ir::name_of(bound.function);
  }
}

// ż: sin(y1 + y2) 3, w and squares 3, b s, b k 2, forces 3 + 3; D = a − (b k)² 2, x1 = (f1 − b k f2)/D 3,
// x2 = (a f2 − b k f1)/D 4, x2 − x1 1: 24. M: a + 2 b k, 1 + b k: 4. k̄ (undivided): b s, (2 z1 + z2) z2, z1²: 7.
// q̄: 6. τ: M ż 6 + M 4, k̄ 7, q̄ 6, sums 4: 27. T: w 1, a z1² 2, w² 2 with
// its factor, b k z1 w 3, sums 2: 10.
const std::vector<Bound> kTwoLinks = {{FunctionId::kForwardDynamics, 24, 4, 22},
                                      {FunctionId::kMassMatrix, 4, 1, 4},
                                      {FunctionId::kKBar, 7, 1, 7},
                                      {FunctionId::kQBar, 6, 4, 6},
                                      {FunctionId::kInverseDynamics, 27, 4, 24},
                                      {FunctionId::kKineticEnergy, 10, 1, 9}};

TEST(TextbookScenes, ADoublePendulumOfPointMassesTakesNoMoreThanByHand) {
  expect_counts(read_model(model_path("double_pendulum.toml")), kTwoLinks);
}

TEST(TextbookScenes, ACompoundDoublePendulumTakesNoMoreThanByHand) {
  expect_counts(read_scene(arm(2, kDown)), kTwoLinks);
}

// The first coordinate is ignorable: 24 − 3 − 2 − 2 for ż, 27 − 6 − 2 for τ; sin y2 and cos y2 alone.
TEST(TextbookScenes, WithoutGravityTheFirstAngleOfAnArmComesInNowhere) {
  expect_counts(read_scene(arm(2, kWeightless)), {{FunctionId::kForwardDynamics, 17, 2, 15},
                                                  {FunctionId::kMassMatrix, 4, 1, 4},
                                                  {FunctionId::kKBar, 7, 1, 7},
                                                  {FunctionId::kQBar, 0, 0, 0},
                                                  {FunctionId::kInverseDynamics, 19, 2, 17}});
}

// M: products with three cosines, one of a sum, 6; upward along the diagonal 2 + 2, beside it 1 + 1 + 1, couplings
// summed 1: 14. q̄: both of y1 + y2 6, sine of all three 3, products 3, sums 2: 14. ż: sines and cosines 12, rates
// and squares 5, couplings 6, forces 15, elimination 10 + 6, back 10: 64; without gravity 64 − 6 − 6.
// k̄: sine of y2 + y3 3, slopes 3, rates and squares 5, products 6, sums 5: 22. τ: sines and cosines 12, rates and
// squares 5, couplings 6, products 9 + 6 + 3, sums 15, of accelerations 2, outward 2: 60.
TEST(TextbookScenes, ThreeLinksInAPlaneTakeNoMoreThanByHand) {
  expect_counts(read_scene(arm(3, kDown)), {{FunctionId::kForwardDynamics, 64, 6, 64},
                                            {FunctionId::kMassMatrix, 14, 4, 14},
                                            {FunctionId::kKBar, 22, 4, 22},
                                            {FunctionId::kQBar, 14, 6, 14},
                                            {FunctionId::kInverseDynamics, 60, 6, 60}});
  expect_counts(read_scene(arm(3, kWeightless)),
                {{FunctionId::kForwardDynamics, 52, 4, 52}, {FunctionId::kMassMatrix, 14, 4, 14}});
}

// ẍ and ÿ of Barto, Sutton and Anderson (1983), without friction: (F + m l z² sin y)/m_t 5, denominator 3, numerator
// 3, quotient 1, ẍ from it 3: 15. τ: M ż 6 + M 1, k̄ 3, q̄ 1, sums 2: 13.
TEST(TextbookScenes, ACartPoleTakesNoMoreThanByHand) {
  expect_counts(read_scene(cart(1)), {{FunctionId::kForwardDynamics, 15, 2, 14},
                                      {FunctionId::kMassMatrix, 1, 1, 1},
                                      {FunctionId::kKBar, 3, 1, 3},
                                      {FunctionId::kQBar, 1, 1, 1},
                                      {FunctionId::kInverseDynamics, 13, 2, 13}});
}

// ż: sine and cosine of y1 + y2 6, rate and squares 3, couplings 6, weights 2, forces 4 + 2 + 2, input 1,
// elimination 10 + 6, back 9: 51. M: cos(y1 + y2) 3, products 3, sums 4: 10.
// k̄: sine of y1 + y2 3, rate and squares 3, slopes 3, products 4, sums 2: 15. q̄: 6. τ: 6, 3, couplings 6, products
// 9 + 4 + 2, sums 12, of accelerations 1, outward 1: 44.
TEST(TextbookScenes, ACartWithADoublePendulumTakesNoMoreThanByHand) {
  expect_counts(read_scene(cart(2)), {{FunctionId::kForwardDynamics, 51, 4, 51},
                                      {FunctionId::kMassMatrix, 10, 4, 10},
                                      {FunctionId::kKBar, 15, 4, 15},
                                      {FunctionId::kQBar, 6, 4, 6},
                                      {FunctionId::kInverseDynamics, 44, 4, 44}});
}

// Not by hand: what was reached.
TEST(TextbookScenes, AChainOfFourTakesAsManyOperationsAsItDid) {
  expect_counts(read_model(model_path("chain4.toml")), {{FunctionId::kForwardDynamics, 129, 8, 129},
                                                        {FunctionId::kMassMatrix, 33, 6, 32},
                                                        {FunctionId::kKBar, 48, 6, 48},
                                                        {FunctionId::kQBar, 22, 8, 22},
                                                        {FunctionId::kInverseDynamics, 112, 8, 112}});
}

// ÿ = −(m g l/J) sin y; a crank without weight turns by itself.
TEST(TextbookScenes, APendulumTakesOneProductAndACrankNothing) {
  expect_counts(read_scene(arm(1, kDown)), {{FunctionId::kForwardDynamics, 1, 1, 1},
                                            {FunctionId::kMassMatrix, 0, 0, 0},
                                            {FunctionId::kKBar, 0, 0, 0},
                                            {FunctionId::kQBar, 1, 1, 1}});
  expect_counts(read_scene(arm(1, kWeightless)), {{FunctionId::kForwardDynamics, 0, 0, 0}});
}

// M: J + m r² 3. r̈ = r w² − g sin y 4, ẅ = −((m r + h) g cos y + 2 m r w v)/(J + m r²): 2 + 2 + 3 + 1 + 2 + 1.
TEST(TextbookScenes, ASlideOnATurningBarTakesNoMoreThanByHand) {
  expect_counts(read_scene(scene(kDown) + bar("bar", "world", 0, 0.1) + slide("bead", "bar", "[0, -1, 0]")),
                {{FunctionId::kForwardDynamics, 15, 2, 14}, {FunctionId::kMassMatrix, 3, 0, 3}});
}

}  // namespace
}  // namespace jourdain::tests
