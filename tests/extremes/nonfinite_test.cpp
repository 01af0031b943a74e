// What is not a number stays one: NaN and infinity in state or input reach exactly the results that depend on them, and
// every call returns. A controller can then see that something is wrong; a value that looks right would hide it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <type_traits>

#include "embed/emitted_models.hpp"
#include "extremes/extreme_sweep.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Which outputs of a program depend on entry `index` of a leaf.
std::vector<bool> dependent_outputs(const ir::Program& program, LeafKind kind, std::size_t index) {
  std::vector<bool> depends;
  for (const ir::Node& node : program.nodes) {
    bool any = node.op == ir::Op::kLeaf && node.leaf == kind && node.index == index;
    if (ir::operand_count(node.op) >= 1) any = any || depends[node.a.value];
    if (ir::operand_count(node.op) == 2) any = any || depends[node.b.value];
    depends.push_back(any);
  }
  std::vector<bool> outputs;
  for (const ir::Output& output : program.outputs) outputs.push_back(depends[output.value.value]);
  return outputs;
}

const ir::Program& forward_dynamics_of(const Derived& derived) {
  for (const ir::Program& program : derived.module.functions)
    if (program.name == "forward_dynamics") return program;
  throw std::runtime_error("no forward_dynamics");
}

/// Puts `value` into one entry and checks which accelerations feel it.
template <class Real>
void poison(const Derived& derived, const Sample& sample, LeafKind kind, std::size_t index, double value) {
  Sample poisoned = sample;
  (kind == LeafKind::kPosition   ? poisoned.y
   : kind == LeafKind::kVelocity ? poisoned.z
                                 : poisoned.u)[index] = value;
  const auto before = interpreted<Real>(derived.module, "forward_dynamics", sample);
  const auto after = interpreted<Real>(derived.module, "forward_dynamics", poisoned);
  const auto depends = dependent_outputs(forward_dynamics_of(derived), kind, index);
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!depends[i]) {
      EXPECT_EQ(after[i], before[i]) << ir::leaf_name(kind) << index;
    } else if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(after[i])) << ir::leaf_name(kind) << index;
    }
  }
}

void poison_everything(const Derived& derived, const Sample& sample) {
  const auto each = [&](LeafKind kind, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      for (const double value : {kNan, kInfinity, -kInfinity}) {
        poison<double>(derived, sample, kind, i, value);
        poison<float>(derived, sample, kind, i, value);
      }
  };
  each(LeafKind::kPosition, sample.y.size());
  each(LeafKind::kVelocity, sample.z.size());
  each(LeafKind::kInput, sample.u.size());
}

TEST(NonFinite, EntriesReachExactlyTheAccelerationsThatDependOnThem) {
  std::set<std::string> seen;
  for (const Family& family : extreme_families()) {
    if (!seen.insert(family.name).second) continue;
    SCOPED_TRACE(family.name);
    const Derived derived = derive_extreme(read_scene(family.description(std::exp2(family.first))));
    poison_everything(derived, random_sample(derived.mechanism, 0, true));
  }
}

template <class Model>
concept HasInputs = requires(typename Model::Input input) {
  input.u;
};

template <class Model>
concept HasSamples = requires(const Model model, typename Model::State state, typename Model::Input input,
                              typename Model::Scalar h) {
  sample(model, state, input, h);
};

/// A step from a state with one rate that is not finite ends, and does not hide it. Where a sample begins the step,
/// what it replaces is gone: memories are looked at in the second step, which has none.
template <class Model>
void step_from_non_finite_rates(const char* name) {
  using Real = typename Model::Scalar;
  const Model model;
  for (const double value : {kNan, kInfinity})
    for (int i = 0; i < Model::velocity_count; ++i) {
      auto state = initial_state(model);
      if constexpr (HasSamples<Model>) rk4_step(model, state, typename Model::Input{}, Real(1e-3));
      state.z[i] = Real(value);
      rk4_step(model, state, typename Model::Input{}, Real(1e-3));
      EXPECT_FALSE(std::isfinite(state.z[i])) << name << " z" << i;
    }
  if constexpr (HasInputs<Model>) {
    typename Model::Input input{};
    input.u[0] = Real(kNan);
    auto state = initial_state(model);
    rk4_step(model, state, input, Real(1e-3));
    bool shown = false;
    for (const Real z : state.z) shown = shown || std::isnan(z);
    EXPECT_TRUE(shown) << name << " u0";
  }
}

TEST(NonFinite, RatesAndInputsStayNonFiniteThroughAStepOfTheEmittedCode) {
#define JOURDAIN_STEP(name)                                 \
  step_from_non_finite_rates<::name::Model<double>>(#name); \
  step_from_non_finite_rates<::name::Model<float>>(#name);
  JOURDAIN_EMITTED_MODELS(JOURDAIN_STEP)
}

/// Angles that are denormal, rates that are: the motion is that of rest.
TEST(NonFinite, DenormalRatesGiveTheAccelerationsOfRest) {
  const Derived derived = derive_extreme(read_scene(extreme_families().back().description(1)));
  Sample rest = random_sample(derived.mechanism, 0, true), slow = rest;
  for (std::size_t i = 0; i < rest.z.size(); ++i) {
    rest.z[i] = 0;
    slow.z[i] = std::numeric_limits<double>::denorm_min() * double(i + 1);
  }
  EXPECT_EQ(interpreted<double>(derived.module, "forward_dynamics", slow),
            interpreted<double>(derived.module, "forward_dynamics", rest));
}

}  // namespace
}  // namespace jourdain::tests
