// Interpreter, both numeric references and 60-digit arithmetic agree on hundreds of seeded random scenes that mix all
// joints, prescribed motion, forces and outputs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "agreement/compiled_batch.hpp"
#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "compile/compile.hpp"
#include "emit/body.hpp"
#include "properties/effort.hpp"
#include "properties/random_laws.hpp"
#include "properties/random_mixture.hpp"
#include "properties/random_scene.hpp"
#include "properties/to_toml.hpp"
#include "reference/descriptor.hpp"
#include "validate/kinks.hpp"

namespace jourdain::tests {
namespace {

using Vector = reference::VectorX<long double>;

const std::uint64_t kScenes = draws_all_cases() ? 520 : cases(260), kScenesWithLaws = cases(500),
                    kScenesWithCalls = cases(120), kMixtures = cases(120);
// As for random trees: backward error in double, forward error over cond(M), entries of their term sum.
constexpr double kBackward = 1e-13, kForward = 1e-14, kEntries = 1e-12;
// Laws have a condition of their own: what rounds their arguments moves a force by its slope.
constexpr double kForwardWithLaws = 1e-13;
// The descriptor form solves a larger system in long double, with joint forces as constraint forces; over cond(M).
constexpr double kDescriptor = 1e-13;

Vector to_vector(const std::vector<double>& values) {
  Vector v(Eigen::Index(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[Eigen::Index(i)] = values[i];
  return v;
}

/// Everything that is compared at one state of a scene.
class Comparison {
 public:
  Comparison(const Derived& derived, const Sample& sample)
      : derived_(derived),
        sample_(sample),
        judge_(derived, sample),
        parameters_(sample.parameters.begin(), sample.parameters.end()),
        state_{.t = sample.t, .y = to_vector(sample.y), .z = to_vector(sample.z)},
        zdot_(reference::forward_dynamics(judge_.terms())) {}

  double condition() const { return judge_.condition(); }

  /// Of accelerations computed in double from any derivation of the same scene.
  double backward(const ir::Module& module) const {
    return judge_.backward_error(interpreted<double>(module, "forward_dynamics", sample_));
  }

  double forward(const ir::Module& module) const {
    return judge_.forward_error(interpreted<double>(module, "forward_dynamics", sample_)) / condition();
  }

  double entries(const ir::Module& module) const {
    const auto values = [&](const char* name) { return interpreted<double>(module, name, sample_); };
    double worst = judge_.mass_matrix_error(values("mass_matrix"));
    worst = larger_error(worst, judge_.k_bar_error(values("k_bar")));
    worst = larger_error(worst, judge_.q_bar_error(values("q_bar")));
    return larger_error(worst, judge_.torque_error(values("inverse_dynamics")));
  }

  double reference() const {
    const std::vector<double> zdot(zdot_.begin(), zdot_.end());
    return zdot.empty() ? 0 : judge_.forward_error(zdot) / condition();
  }

  /// Every requested output of the program against the numeric reference, of its term sum.
  double outputs(const ir::Module& module) const {
    if (derived_.mechanism.outputs.empty()) return 0;
    const reference::Reference<long double> reference(derived_.mechanism, parameters_);
    const auto& terms = judge_.terms();
    const Vector load = terms.M_scale * zdot_.cwiseAbs() + terms.k_scale + terms.q_scale;
    const Vector scale = zdot_.cwiseAbs() + terms.M.inverse().cwiseAbs() * load;
    const std::vector<double> values = interpreted<double>(module, "outputs", sample_);
    std::size_t k = 0;
    double worst = 0;
    for (const auto& output : reference.outputs(state_, to_vector(sample_.u), zdot_, scale))
      for (std::size_t i = 0; i < output.values.size(); ++i) {
        const double difference = std::fabs(values.at(k++) - double(output.values[i]));
        if (difference > 0) worst = larger_error(worst, double(difference / output.scales[i]));
      }
    return worst;
  }

  /// What memories are sampled to: of the program, and of the descriptor form, against the reference.
  double samples(const ir::Module& module) const {
    if (!has_samples(derived_.mechanism)) return 0;
    const Vector u = to_vector(sample_.u);
    const auto expected = reference::Reference<long double>(derived_.mechanism, parameters_)
                              .sampled_states(state_, u, sample_.h);
    const auto by_form = reference::DescriptorReference<long double>(derived_.mechanism, parameters_)
                             .sampled_states(state_.t, state_.y, state_.z, u, sample_.h);
    const std::vector<double> values = interpreted<double>(module, "sample", sample_);
    EXPECT_EQ(values.size(), std::size_t(expected.size()));
    double worst = 0;
    for (Eigen::Index i = 0; i < expected.size(); ++i)
      for (const long double value : {static_cast<long double>(values.at(std::size_t(i))), by_form[i]})
        worst = larger_error(worst, double(std::fabs(value - expected[i]) / (1 + std::fabs(expected[i]))));
    return worst;
  }

  /// Accelerations, reactions and drives of the descriptor form against the reference in minimal coordinates.
  double descriptor() const {
    const reference::DescriptorReference<long double> form(derived_.mechanism, parameters_);
    const auto solution = form.solve(state_.t, state_.y, state_.z, to_vector(sample_.u));
    EXPECT_LE(double(solution.g.size() == 0 ? 0 : solution.g.template lpNorm<Eigen::Infinity>()), 1e-13);
    double worst = 0;
    const long double size = zdot_.norm() + 1;
    if (zdot_.size() > 0) worst = double((solution.zdot - zdot_).norm() / size) / condition();
    const reference::Reference<long double> reference(derived_.mechanism, parameters_);
    const auto values = reference.outputs(state_, to_vector(sample_.u), zdot_, zdot_.cwiseAbs());
    for (std::size_t k = 0; k < values.size(); ++k) {
      const model::Output& output = derived_.mechanism.outputs[k];
      const std::size_t j = output.joint.value;
      std::vector<long double> expected;
      if (output.kind == model::OutputKind::kReaction) {
        const auto& own = solution.reactions[j];
        const auto& rotor = solution.rotor_wrenches[j];
        for (int i = 0; i < 3; ++i) expected.push_back(own.force[i] + rotor.force[i]);
        for (int i = 0; i < 3; ++i) expected.push_back(own.moment[i] + rotor.moment[i]);
      }
      if (output.kind == model::OutputKind::kDrive) expected = {*solution.drives[j][output.coordinate]};
      long double scale = 1;
      for (const long double s : values[k].scales) scale = std::max(scale, s);
      for (std::size_t i = 0; i < expected.size(); ++i)
        worst =
            larger_error(worst, double(std::fabs(values[k].values[i] - expected[i]) / scale) / condition());
    }
    return worst;
  }

 private:
  const Derived& derived_;
  const Sample& sample_;
  Judge judge_;
  std::vector<long double> parameters_;
  reference::State<long double> state_;
  Vector zdot_;
};

struct Worst {
  int scenes = 0, sampled = 0;
  double backward = 0, forward = 0, entries = 0, outputs = 0, samples = 0, reference = 0, descriptor = 0,
         condition = 0;
};

const char* group(const model::Mechanism& mechanism) {
  const bool moved = has_motion(mechanism), free = has_free_joint(mechanism);
  return moved && free ? "free, motion" : moved ? "motion" : free ? "free" : "others";
}

/// Where rounding chooses the side, forces may jump.
bool is_on_a_kink(const Derived& derived, const Sample& sample) {
  ir::LeafValues<support::ScaledReal> leaves;
  const auto take = [&](ir::LeafKind kind, const std::vector<double>& values) {
    leaves[kind].assign(values.begin(), values.end());
  };
  take(ir::LeafKind::kParameter, sample.parameters);
  take(ir::LeafKind::kPosition, sample.y);
  take(ir::LeafKind::kVelocity, sample.z);
  take(ir::LeafKind::kAcceleration, sample.zdot);
  take(ir::LeafKind::kInput, sample.u);
  take(ir::LeafKind::kTime, {sample.t});
  take(ir::LeafKind::kStepLength, {sample.h});
  const validate::KinkSurvey survey(derived.module);
  return survey.look(leaves).is_near;
}

using Draw = model::Mechanism (*)(std::uint64_t seed);

/// How many of the scenes have memories.
int expect_agreement(Draw draw, std::uint64_t scenes, double forward) {
  std::map<std::string, Worst> worst;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    const Derived derived = derive(draw(seed));
    const Sample sample = random_sample(derived.mechanism, seed);
    if (is_on_a_kink(derived, sample)) continue;
    const Comparison compare(derived, sample);
    Worst& w = worst[group(derived.mechanism)];
    ++w.scenes;
    const auto check = [&](double& largest, double error, double limit, const char* what) {
      EXPECT_LE(error, limit) << what << ", seed " << seed << "\n"
                              << (error <= limit ? "" : to_toml(derived.mechanism));
      largest = larger_error(largest, error);
    };
    if (!derived.equations.zdot.empty()) {
      check(w.backward, compare.backward(derived.module), kBackward, "backward");
      check(w.forward, compare.forward(derived.module), forward, "forward");
      check(w.entries, compare.entries(derived.module), kEntries, "entries");
      check(w.reference, compare.reference(), kForward, "reference");
    }
    check(w.outputs, compare.outputs(derived.module), kEntries, "outputs");
    check(w.samples, compare.samples(derived.module), kEntries, "samples");
    w.sampled += has_samples(derived.mechanism);
    check(w.descriptor, compare.descriptor(), kDescriptor, "descriptor");
    w.condition = std::max(w.condition, compare.condition());
    if (testing::Test::HasFailure()) return 0;
  }
  int compared = 0, sampled = 0;
  for (const auto& [name, w] : worst) {
    compared += w.scenes;
    sampled += w.sampled;
  }
  EXPECT_GE(compared, 0.95 * double(scenes));
  fmt::print("{:<13} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>10} {:>9}\n", "scenes", "", "backward",
             "fwd/cond", "entries", "outputs", "samples", "reference", "descriptor", "cond(M)");
  for (const auto& [name, w] : worst)
    fmt::print("{:<13} {:>6} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e} {:>10.1e} {:>9.1e}\n",
               name, w.scenes, w.backward, w.forward, w.entries, w.outputs, w.samples, w.reference,
               w.descriptor, w.condition);
  return sampled;
}

TEST(RandomScenes, AgreeInInterpreterReferencesAndSixtyDigits) {
  expect_agreement(random_scene, kScenes, kForward);
}

TEST(RandomScenes, WithLawsOfAllFunctionsAgree) {
  EXPECT_GE(expect_agreement(random_scene_with_laws, kScenesWithLaws, kForwardWithLaws), kScenesWithLaws / 8);
}

TEST(RandomScenes, WithCallsOfTheUserAgree) {
  expect_agreement(random_scene_with_calls, kScenesWithCalls, kForwardWithLaws);
}

/// Of random_mixture those without loops.
model::Mechanism random_tree_mixture(std::uint64_t seed) { return random_mixture(3 * seed); }

TEST(RandomScenes, WithElementsAndLawsAtOnceAgree) {
  expect_agreement(random_tree_mixture, kMixtures, kForwardWithLaws);
}

TEST(RandomScenes, GiveTheSameOutputsWithEverySimplificationOff) {
  for (std::uint64_t seed = 0; seed < cases(80); ++seed) {
    const model::Mechanism mechanism = random_scene(seed);
    const Derived with = derive(mechanism);
    const Sample sample = random_sample(mechanism, seed);
    const Comparison compare(with, sample);
    for (int off = 0; off < 3; ++off) {
      dynamics::DerivationOptions options;
      options.link_tree.regroup = off != 0;
      options.link_tree.share_parallel = off != 1;
      choose_articulation(mechanism, {}).set(options);
      if (off == 2) options.articulated.assign(options.articulated.size(), true);
      const Derived without = derive(mechanism, options);
      EXPECT_LE(compare.outputs(without.module), kEntries) << seed << " " << off;
      if (without.equations.zdot.empty()) continue;
      EXPECT_LE(compare.backward(without.module), kBackward) << seed << " " << off;
      EXPECT_LE(compare.entries(without.module), kEntries) << seed << " " << off;
    }
  }
}

TEST(RandomScenes, AreAcceptedByTheCompiler) {
  for (std::uint64_t seed = 0; seed < cases(40); ++seed) {
    for (const Draw draw : {random_scene, random_scene_with_laws, random_scene_with_calls, random_mixture}) {
      const CompiledModel compiled = compile(draw(seed), {});
      EXPECT_TRUE(compiled.verdict.accepted()) << seed << ": " << compiled.verdict.failures.front();
    }
  }
}

/// Bit by bit; where angles follow from time, which the interpreter rounds, to a share of the largest.
void expect_same(const std::vector<double>& found, const std::vector<double>& wanted, bool turns,
                 const std::string& name) {
  if (!turns) {
    EXPECT_EQ(found, wanted) << name;
    return;
  }
  constexpr double kRoundedAngles = 1e-12;
  double largest = 0;
  for (const double value : wanted) largest = std::max(largest, std::fabs(value));
  ASSERT_EQ(found.size(), wanted.size()) << name;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], kRoundedAngles * largest) << name;
}

void expect_same_bits(Draw draw) {
  for (const std::string compiler : {"g++", "clang++"}) {
    ASSERT_TRUE(have_compiler(compiler)) << "no " << compiler;
    std::vector<Derived> derived;
    std::vector<EmittedModel> models;
    for (std::uint64_t seed = compiler == "g++" ? 0 : 100; models.size() < cases(12); ++seed) {
      derived.push_back(derive(draw(seed)));
      models.push_back(emit_model(derived.back(), fmt::format("scene{}", seed)));
    }
    const CompiledBatch batch(models, compiler, "double", kAsInterpreted);
    for (std::size_t k = 0; k < models.size(); ++k) {
      const Derived& d = derived[k];
      const Sample sample = random_sample(d.mechanism, k);
      const Evaluation e = batch.evaluate(k, sample);
      const auto values = [&](const char* name) { return interpreted<double>(d.module, name, sample); };
      const auto expect = [&](const std::vector<double>& found, const char* function) {
        const bool turns = emit::turns_with_time(*ir::find_program(d.module, function));
        expect_same(found, values(function), turns, models[k].name + " " + function);
      };
      if (!d.equations.zdot.empty()) {
        expect(e.M, "mass_matrix");
        expect(e.k, "k_bar");
        expect(e.q, "q_bar");
        expect(e.zdot, "forward_dynamics");
        expect(e.tau, "inverse_dynamics");
      }
      if (!d.equations.ydot.empty()) expect(e.ydot, "position_rate");
      if (models[k].outputs > 0) expect(e.outputs, "outputs");
      expect({e.kinetic}, "kinetic_energy");
      expect({e.potential}, "potential_energy");
    }
  }
}

TEST(RandomScenes, CompiledCodeAgreesBitByBitWithTheInterpreter) { expect_same_bits(random_scene); }

TEST(RandomScenes, CompiledLawsAgreeBitByBitWithTheInterpreter) { expect_same_bits(random_scene_with_laws); }

}  // namespace
}  // namespace jourdain::tests
