#include "validate/translation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "dynamics/outputs.hpp"
#include "model/coordinates.hpp"
#include "reference/minimal.hpp"
#include "validate/reference_check.hpp"
#include "validate/samples.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

using ir::LeafKind;
using support::ScaledReal;

namespace {

using Vector = reference::VectorX<long double>;

/// The comparison at one sample.
class TreeComparison {
 public:
  TreeComparison(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                 const dynamics::Equations* load, const ir::Module& module, const Sample& sample,
                 Verdict& verdict, Agreement& agreement)
      : mechanism_(mechanism),
        equations_(equations),
        load_(load),
        module_(module),
        sample_(sample),
        verdict_(verdict),
        agreement_(agreement),
        point_(point_at(mechanism, sample)),
        parameters_(sample.parameters.begin(), sample.parameters.end()),
        terms_(reference::Reference<long double>(mechanism, parameters_).evaluate(state(), inputs())) {
    point_.output_numbers = dynamics::output_entries(equations).size();
  }

  void run(const KinkSurvey& survey) {
    const TreeOracle oracle(mechanism_, equations_, load_, point_);
    compare_with_reference(mechanism_, equations_, point_.exact, oracle, agreement_);
    const bool is_on_kink = survey.has_kinks() && survey.look(point_.exact).is_on;
    compare_programs(is_on_kink ? without_derivatives(module_) : module_, point_, std::cref(oracle),
                     agreement_);
    verdict_.condition =
        std::max(verdict_.condition, static_cast<double>(reference::condition<long double>(terms_.M)));
    if (const ir::Program* forward = ir::find_program(module_, ir::FunctionId::kForwardDynamics))
      measure_backward_error(*forward, oracle);
  }

 private:
  reference::State<long double> state() const {
    return {sample_.t, to_vector(sample_.y), to_vector(sample_.z)};
  }
  Vector inputs() const { return to_vector(sample_.u); }

  /// Of M ż = k̄ − q̄ with the program's accelerations in double, row by row.
  void measure_backward_error(const ir::Program& program, const TreeOracle& oracle) {
    if ((terms_.k_scale + terms_.q_scale).isZero(0))
      return;  // ż is zero, and so is all that it might be compared with
    ir::LeafValues<double> leaves = point_.rounded;
    leaves[LeafKind::kConstant] = ir::interpret(module_.constants, leaves);
    const std::vector<double> zdot = ir::interpret(program, leaves);
    const Vector scale = terms_.M_scale * to_vector(zdot).cwiseAbs() + terms_.k_scale + terms_.q_scale;
    const ExactVector a = to_exact(std::vector<ScaledReal>(zdot.begin(), zdot.end()));
    const ExactVector residual = oracle.M() * a - oracle.k_bar() + oracle.q_bar();
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      const auto size = std::fabs(static_cast<long double>(residual[i]));
      if (size > 0 && scale[i] > 0)
        verdict_.backward_error = std::max(verdict_.backward_error, static_cast<double>(size / scale[i]));
    }
  }

  const model::Mechanism& mechanism_;
  const dynamics::Equations& equations_;
  const dynamics::Equations* load_;
  const ir::Module& module_;
  const Sample& sample_;
  Verdict& verdict_;
  Agreement& agreement_;
  Point point_;
  std::vector<long double> parameters_;
  reference::Terms<long double> terms_;
};

/// Operations of the reference in 77 digits that one compilation may take.
constexpr double kAffordable = 3e7;

std::size_t affordable_states(const model::Mechanism& mechanism, std::size_t wanted) {
  const auto n = static_cast<double>(model::lay_out_coordinates(mechanism).velocity_count());
  const double each = 12 * n * n * static_cast<double>(mechanism.bodies.size());
  return std::clamp<std::size_t>(static_cast<std::size_t>(kAffordable / std::max(each, 1.0)), 1, wanted);
}

/// Without those too near to a kink, and with more that show sides of kinks that were not seen yet.
std::vector<Sample> on_both_sides(const model::Mechanism& mechanism, std::vector<Sample> samples,
                                  KinkSurvey& survey) {
  constexpr std::size_t kFarDraws = 200;
  if (!survey.has_kinks()) return samples;
  const auto look_at = [&](const Sample& sample) { return survey.look(point_at(mechanism, sample).exact); };
  std::vector<KinkSurvey::Look> looks;
  for (const Sample& sample : samples) looks.push_back(look_at(sample));
  survey.disregard_stuck(looks);
  const auto is_left_out = [&](const Sample& sample) {
    const KinkSurvey::Look look = look_at(sample);
    survey.take(look);
    return look.is_near;
  };
  std::erase_if(samples, is_left_out);
  FarSamples far(mechanism);
  for (std::size_t i = 0; i < kFarDraws && !survey.is_complete(); ++i) {
    const std::optional<Sample> sample = far.draw();
    if (!sample) continue;
    const KinkSurvey::Look look = look_at(*sample);
    if (!look.is_new || look.is_near) continue;
    survey.take(look);
    samples.push_back(*sample);
  }
  return samples;
}

}  // namespace

std::string algebra_text(const Verdict& verdict) {
  double worst = 0;
  for (const Compared& c : verdict.compared) worst = std::max(worst, c.algebra);
  const std::string text = fmt::format("{:g}", static_cast<double>(kAlgebra));
  return worst <= static_cast<double>(kAlgebra)
             ? text
             : fmt::format("{} (closing in closed form to {:.2g})", text, worst);
}

std::string condition_text(const Verdict& verdict) {
  return std::isfinite(verdict.condition) ? fmt::format("{:.1e}", verdict.condition)
                                          : "more than can be told";
}

void judge_kinks(Verdict& verdict) {
  if (verdict.states == 0)
    verdict.failures.emplace_back(kAllNearKinks);
  else if (verdict.kinks.on == verdict.states)
    verdict.failures.emplace_back(kAllOnKinks);
}

void conclude(const Agreement& agreement, Verdict& verdict) {
  verdict.compared.insert(verdict.compared.end(), agreement.compared().begin(), agreement.compared().end());
  verdict.failures.insert(verdict.failures.end(), agreement.failures().begin(), agreement.failures().end());
  verdict.overflows += agreement.overflows();
  for (const Compared& c : agreement.compared())
    verdict.entry_error = std::max(verdict.entry_error, c.rounding);
}

Verdict validate_translation(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                             const ir::Module& module, std::size_t states, const dynamics::Equations* load) {
  Verdict verdict;
  Agreement agreement;
  verdict.states = affordable_states(mechanism, states);
  KinkSurvey survey(module);
  const std::vector<Sample> samples =
      on_both_sides(mechanism, draw_samples(mechanism, verdict.states), survey);
  verdict.states = samples.size();
  for (std::size_t i = samples.size(); i-- > 0;)  // the initial state last, see Agreement::same
    TreeComparison(mechanism, equations, load, module, samples[i], verdict, agreement).run(survey);
  verdict.kinks = survey.kinks();
  judge_kinks(verdict);
  conclude(agreement, verdict);
  return verdict;
}

}  // namespace jourdain::validate
