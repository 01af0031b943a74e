#include "validate/loops/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "dynamics/outputs.hpp"
#include "ir/function_id.hpp"
#include "programs/scene_facts.hpp"
#include "reference/minimal.hpp"
#include "support/matrix_index.hpp"
#include "support/uniform.hpp"
#include "validate/loops/closing_oracle.hpp"
#include "validate/loops/rays.hpp"

namespace jourdain::validate {

using ir::FunctionId;

using ir::LeafKind;

namespace {

using support::at;

constexpr std::size_t kClosedStates = 8, kLarge = 24;  ///< velocities from which on two states must do
constexpr std::size_t kOpened = 2;                     ///< states beside which open ones are compared

bool closes(const ir::Program& program) {
  const std::optional<FunctionId> function = ir::function_named(program.name);
  return function == FunctionId::kCloseLoops || function == FunctionId::kProject;
}

/// The functions but those that close loops, or these alone.
ir::Module part_of(const ir::Module& module, bool closing) {
  ir::Module part;
  part.constants = module.constants;
  for (const ir::Program& program : module.functions)
    if (closes(program) == closing) part.functions.push_back(program);
  return part;
}

std::vector<ScaledReal> exact(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// Parameters off their default values: within their ranges, or by one hundredth where the treatment does not
/// depend on them.
std::vector<double> varied(const model::Mechanism& mechanism, const loops::LoopPlan& plan,
                           support::Uniform& uniform) {
  constexpr double kShare = 0.01;
  std::vector<double> values = model::default_values(mechanism);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& range = mechanism.parameters[k].range;
    const double off = uniform(-kShare, kShare);
    if (range)
      values[k] = std::clamp(values[k] + off * ((*range)[1] - (*range)[0]), (*range)[0], (*range)[1]);
    else if (plan.treatment != model::LoopTreatment::kExplicit)
      values[k] *= 1 + off;
  }
  return values;
}

Point point_of(const Ray& ray, const std::vector<double>& parameters, const ExactClosure& closure) {
  Point point;
  point.exact[LeafKind::kParameter] = exact(parameters);
  for (const long double entry : ray.configuration.y)
    point.exact[LeafKind::kPosition].push_back(static_cast<double>(entry));
  for (const model::Tangent::Scalar& s : closure.tangent().quaternions) {
    ScaledReal* q = &point.exact[LeafKind::kPosition][s.position];
    const ScaledReal length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; ++k) q[k] /= length;
  }
  point.exact[LeafKind::kVelocity] = exact(ray.z);
  point.exact[LeafKind::kAcceleration] = exact(ray.zdot);
  point.exact[LeafKind::kInput] = exact(ray.u);
  point.exact[LeafKind::kTime] = {static_cast<double>(ray.configuration.t)};
  const double last =
      ray.z.empty() ? 0.0 : std::fabs(ray.z.back());  // of states there are some that count down
  point.exact[LeafKind::kStepLength] = {last * (0.1 + 4 * std::fabs(ray.time))};
  point.direction = {exact(ray.displacement), exact(ray.velocity), exact(ray.input), ray.time};
  point.exact = closure.closed(std::move(point.exact));
  point.rounded = rounded(point.exact);
  return point;
}

/// Positions that closing changes off by about `size` (rad, m), velocities too where it changes them.
Point opened(Point point, const LoopScene& scene, double size) {
  const std::size_t n = scene.closure.velocity_count();
  ExactVector off = ExactVector::Zero(at(n));
  const auto amount = [size](std::size_t k) { return size * std::cos(3.0 * static_cast<double>(k) + 1); };
  if (scene.plan.is_reduced())
    for (const std::size_t k : scene.closure.closed_velocities()) off[at(k)] = amount(k);
  for (std::size_t k = 0; k < n && !scene.plan.is_reduced(); ++k) {
    off[at(k)] = amount(k);
    point.exact[LeafKind::kVelocity][k] += off[at(k)];
  }
  std::vector<ScaledReal>& y = point.exact[LeafKind::kPosition];
  y = scene.closure.displaced(y, off);
  for (ScaledReal& entry : y) entry = entry.forgetting();
  point.rounded = rounded(point.exact);
  return point;
}

class LoopComparison {
 public:
  LoopComparison(const LoopScene& scene, const ir::Module& module, Agreement& agreement, Verdict& verdict)
      : scene_(scene),
        functions_(part_of(module, false)),
        closing_(part_of(module, true)),
        agreement_(agreement),
        verdict_(verdict) {}

  /// Open states are looked at beside some of the closed ones: each takes as long.
  void compare(const Point& point, bool is_opened, bool is_on_kink) {
    const LoopOracle oracle(scene_, point);
    compare_programs(is_on_kink ? without_derivatives(functions_) : functions_, point, std::cref(oracle),
                     agreement_);
    measure(point, oracle);
    const std::vector<double> sizes = is_opened ? std::vector{0.0, 1e-6, 1e-3} : std::vector{1e-3};
    for (const double size : sizes) {
      const Point open = opened(point, scene_, size);
      compare_programs(
          closing_, open,
          [&](const ir::Program& program) { return closing_expected(scene_, open.exact, program); },
          agreement_);
      if (is_opened && size > 0) compare_open(open);
    }
  }

 private:
  /// Everything but closing holds where loops are open, too; derivatives of reduced equations are those along
  /// closed states.
  void compare_open(const Point& open) {
    const ir::Module there = scene_.plan.is_reduced() ? without_derivatives(functions_) : functions_;
    const LoopOracle oracle(scene_, open);
    compare_programs(there, open, std::cref(oracle), agreement_);
  }

  /// Condition of M, and the backward error of the motion in double.
  void measure(const Point& point, const LoopOracle& oracle) {
    const ExactMotion& e = oracle.motion();
    const ExactMatrix M = e.B.transpose() * e.M * e.B;
    verdict_.condition = std::max(
        verdict_.condition, static_cast<double>(reference::condition<long double>(M.cast<long double>())));
    if (const ir::Program* forward = ir::find_program(functions_, FunctionId::kForwardDynamics))
      measure_backward_error(*forward, point, M, oracle.accelerations());
  }

  /// What is missing in M ż = k̄ − q̄, or in that with the constraints' forces, over the sum of absolute terms.
  void measure_backward_error(const ir::Program& forward, const Point& point, const ExactMatrix& M,
                              const ExactVector& right) {
    ir::LeafValues<double> leaves = point.rounded;
    leaves[LeafKind::kConstant] = ir::interpret(functions_.constants, leaves);
    const ExactVector zdot = to_exact(exact(ir::interpret(forward, leaves))), load = M * right,
                      missing = M * (zdot - right);
    for (Eigen::Index i = 0; i < missing.size(); ++i) {
      long double scale = load[i].scale();
      for (Eigen::Index j = 0; j < zdot.size(); ++j)
        scale = std::max(scale, std::fabs(static_cast<long double>(M(i, j) * zdot[j])));
      if (scale > 0)
        verdict_.backward_error =
            std::max(verdict_.backward_error,
                     static_cast<double>(std::fabs(static_cast<long double>(missing[i])) / scale));
    }
  }

  const LoopScene& scene_;
  ir::Module functions_, closing_;
  Agreement& agreement_;
  Verdict& verdict_;
};

}  // namespace

Verdict validate_closed(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                        const ir::Module& module, const loops::LoopPlan& plan) {
  const std::size_t states = plan.z.size() >= kLarge ? 2 : kClosedStates;
  Verdict verdict = validate_translation(mechanism, equations, {}, states);
  verdict.condition = 0;  // that of the tree off the loops is nobody's
  dynamics::DerivationOptions options;
  options.closures_only = true;
  const dynamics::Equations closures = dynamics::derive_equations(mechanism, options);
  const loops::ConstraintPrograms programs = loops::constraint_programs(mechanism, closures).front();
  const std::vector<double> parameters = model::default_values(mechanism);
  loops::NumericClosure numeric(mechanism, programs, parameters);
  numeric.disregard(plan.disagreeing, plan.tolerated_disagreement());
  const ExactClosure closure(mechanism, closures, plan);
  const LoopScene scene{mechanism, equations, plan, closure};
  Agreement agreement;
  KinkSurvey survey(module);
  LoopComparison comparison(scene, module, agreement, verdict);
  const std::size_t output_numbers = programs::scene_facts(mechanism, &plan).output_numbers();
  const std::vector<Ray> rays = draw_rays(numeric, plan, mechanism, states);
  support::Uniform uniform(23);
  std::vector<Point> points;
  for (const Ray& ray : rays) {
    Point point = point_of(ray, &ray == &rays[0] ? parameters : varied(mechanism, plan, uniform), closure);
    if (plan.is_reduced() && !(opening(scene, point.exact) < ScaledReal(1e-50)))
      point = point_of(ray, parameters, closure);  // out of reach
    point.output_numbers = output_numbers;
    point.states = mechanism.states.size();
    points.push_back(std::move(point));
  }
  std::vector<KinkSurvey::Look> looks;
  for (const Point& point : points) looks.push_back(survey.look(point.exact));
  survey.disregard_stuck(looks);
  for (const Point& point : points) {
    const KinkSurvey::Look look = survey.look(point.exact);
    survey.take(look);
    if (!look.is_near) comparison.compare(point, std::size_t(&point - points.data()) < kOpened, look.is_on);
  }
  verdict.kinks = survey.kinks();
  verdict.states = rays.size() - verdict.kinks.left_out;
  judge_kinks(verdict);
  conclude(agreement, verdict);
  return verdict;
}

}  // namespace jourdain::validate
