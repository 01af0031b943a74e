#include "studies/first_kind.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string_view>

#include "studies/scene_forms.hpp"
#include "studies/tangent_space.hpp"
#include "studies/work.hpp"

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;

constexpr double kLost = 1e3;  ///< m; a run that is further off counts as failed

VectorXd to_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// y and z of the tree at a state of the flow, whose velocities may be the independent ones alone: the rates
/// of the positions tell all of them.
class TreeStates {
 public:
  TreeStates(const model::Mechanism& mechanism, const Flow<double>& flow)
      : flow_(flow), layout_(model::lay_out_coordinates(mechanism)), tangent_(layout_.tangent) {}

  VectorXd positions(const Point<double>& point) const {
    return Eigen::Map<const VectorXd>(point.x.data(), Eigen::Index(flow_.position_count()));
  }

  VectorXd velocities(const Point<double>& point) const {
    const std::vector<double> rates = flow_.rates(point.t, point.x);
    VectorXd z(Eigen::Index(layout_.velocity_count()));
    for (const model::Tangent::Scalar& s : tangent_.scalars) z[Eigen::Index(s.velocity)] = rates[s.position];
    for (const model::Tangent::Scalar& s : tangent_.quaternions) {
      const Eigen::Map<const Eigen::Vector4d> q(point.x.data() + s.position), turn(rates.data() + s.position);
      z.segment<3>(Eigen::Index(s.velocity)) = 4 * turning(q).transpose() * turn;
    }
    const auto states = Eigen::Index(layout_.state_count);
    z.tail(states) = to_vector(point.x).tail(states);
    return z;
  }

 private:
  const Flow<double>& flow_;
  model::CoordinateLayout layout_;
  model::Tangent tangent_;
};

void compare(const Bodies& bodies, const Bodies& exact, FormPoint& point) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    point.position_error = std::max(point.position_error, (bodies[b].p_WC - exact[b].p_WC).norm());
    point.angle_error =
        std::max(point.angle_error, bodies[b].orientation.angularDistance(exact[b].orientation));
  }
}

/// Bodies of the reference solution at the sampling times.
std::vector<Bodies> exact_bodies(const Descriptor& absolute, const TreeStates& states,
                                 const ReferenceSolution& reference, double sampling) {
  const auto stride = static_cast<std::size_t>(std::lround(sampling / reference.interval));
  std::vector<Bodies> result;
  for (std::size_t k = 0; k < reference.points.size(); k += stride) {
    const Point<double>& point = reference.points[k];
    result.push_back(absolute.absolute_state(point.t, states.positions(point), states.velocities(point)));
  }
  return result;
}

FormPoint run(SceneForm& form, double h, double sampling, const std::vector<Bodies>& exact) {
  FormPoint point;
  point.h = h;
  const long block = std::lround(sampling / h);
  double time = 0;
  for (std::size_t k = 1; k < exact.size() && point.finite; ++k) {
    const double t = sampling * static_cast<double>(k - 1);
    const auto begin = Clock::now();
    form.steps(t, h, block);
    time += std::chrono::duration<double>(Clock::now() - begin).count();
    point.step_time = time / static_cast<double>(static_cast<long>(k) * block);
    point.finite = form.finite();
    if (!point.finite) break;
    compare(form.bodies(t + sampling), exact[k], point);
    point.finite = point.position_error < kLost;
    const auto [g, g_rate] = form.drift(t + sampling);
    point.drift = std::max(point.drift, g);
    point.rate_drift = std::max(point.rate_drift, g_rate);
  }
  return point;
}

/// Nominal time of one step with four evaluations: each body and joint, and a dense factorisation of the unknowns.
double form_step_time(const FormCurve& curve, int bodies) {
  constexpr double kOfBody = 2e-6, kOfEntry = 3e-10;  // s
  return 4 * (kOfBody * bodies + kOfEntry * std::pow(curve.unknowns, 3));
}

/// A curve to be filled, and how its runs begin.
struct Candidate {
  FormCurve curve;
  double step_time = 0;  ///< s, nominal
  std::function<std::unique_ptr<SceneForm>()> make;
};

/// The table's classical Runge-Kutta method.
std::optional<std::size_t> runge_kutta(const jourdain_model_table& table) {
  for (int m = 0; m < table.method_count; ++m)
    if (std::string_view(table.methods[m].name) == "rk4") return static_cast<std::size_t>(m);
  return {};
}

/// The scene's references at its start, and the forms that begin there.
class Scene {
 public:
  Scene(const model::Mechanism& mechanism, const std::vector<double>& parameters, const Flow<double>& flow,
        const ReferenceSolution& reference)
      : flow_(flow),
        parameters_(parameters),
        minimal_(mechanism, std::span<const double>(parameters)),
        absolute_(mechanism, std::span<const double>(parameters)),
        states_(mechanism, flow),
        start_(reference.points.front()),
        absolute_start_(absolute_.absolute(start_.t, states_.positions(start_), states_.velocities(start_))),
        bodies_(static_cast<int>(mechanism.bodies.size())) {}

  std::vector<Bodies> exact(const ReferenceSolution& reference, double sampling) const {
    return exact_bodies(absolute_, states_, reference, sampling);
  }

  /// With loops there is no form in plain minimal coordinates.
  std::vector<Candidate> numeric() const {
    std::vector<Candidate> list;
    if (!flow_.has_loops())
      list.push_back(numeric({"minimal coordinates", size(), freedom(), {}},
                             [this] { return minimal_form(minimal_, absolute_, flow_.inputs(), start_); }));
    const VectorXd u = to_vector(flow_.inputs().at(start_.t));
    const auto unknowns = static_cast<int>(absolute_.rates(absolute_start_, u).unknowns);
    for (const bool projecting : {false, true})
      list.push_back(
          numeric({projecting ? "descriptor form, projected" : "descriptor form", 13 * bodies_, unknowns, {}},
                  [this, projecting] {
                    return descriptor_form(absolute_, flow_.inputs(), absolute_start_, projecting);
                  }));
    return list;
  }

  /// Where both have the method. Goes with `free`, whose flow then starts where this does.
  std::vector<Candidate> emitted(const EmittedFreeBodies& free) {
    free_absolute_.emplace(free.mechanism, std::span<const double>(parameters_));
    free_flow_.emplace(free.flow);
    free_flow_->set_start(free_state(free.mechanism, parameters_, absolute_start_.bodies));
    if (!runge_kutta(flow_.table()) || !runge_kutta(free_flow_->table())) return {};
    const auto free_size = static_cast<int>(free_flow_->size());
    return {emitted({"emitted: minimal coordinates", size(), freedom(), {}}, flow_, absolute_),
            emitted({"emitted: free bodies", free_size, free_flow_->table().constraint_count, {}},
                    *free_flow_, *free_absolute_)};
  }

 private:
  int size() const { return static_cast<int>(start_.x.size()); }
  int freedom() const { return static_cast<int>(minimal_.coordinate_count()); }

  Candidate numeric(FormCurve curve, std::function<std::unique_ptr<SceneForm>()> make) const {
    const double time = form_step_time(curve, bodies_);
    return {std::move(curve), time, std::move(make)};
  }

  static Candidate emitted(FormCurve curve, const Flow<double>& flow, const Descriptor& absolute) {
    const std::size_t method = *runge_kutta(flow.table());
    return {std::move(curve), step_time(flow.table().methods[method]),
            [&flow, &absolute, method] { return emitted_form(flow, method, absolute); }};
  }

  const Flow<double>& flow_;
  const std::vector<double>& parameters_;
  reference::Reference<double> minimal_;
  Descriptor absolute_;
  TreeStates states_;
  const Point<double>& start_;
  reference::AbsoluteState<double> absolute_start_;
  int bodies_;
  std::optional<Descriptor> free_absolute_;
  std::optional<Flow<double>> free_flow_;
};

/// Fills a curve as far as `seconds` of work allow; `shown` tells how much of them are spent.
void fill(Candidate& candidate, const std::vector<double>& steps, double sampling,
          const std::vector<Bodies>& exact, double seconds, const std::function<void(double)>& shown) {
  std::vector<FormPoint>& points = candidate.curve.points;
  double spent = 0;
  for (const double h : steps) {
    if (h > 1.001 * sampling) continue;
    const double expected = candidate.step_time * sampling / h * static_cast<double>(exact.size() - 1);
    const bool any =
        std::any_of(points.begin(), points.end(), [](const FormPoint& point) { return point.finite; });
    if (spent + expected > (any ? seconds : 4 * seconds)) break;
    shown(std::min(1.0, spent / seconds));
    points.push_back(run(*candidate.make(), h, sampling, exact));
    spent += expected;
  }
}

}  // namespace

std::vector<FormCurve> study_forms(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                   const Flow<double>& flow, const EmittedFreeBodies* free,
                                   const std::vector<double>& steps, double sampling,
                                   const ReferenceSolution& reference, double seconds,
                                   const Progress& progress) {
  Scene scene(mechanism, parameters, flow, reference);
  std::vector<Candidate> candidates = scene.numeric();
  if (free)
    for (Candidate& candidate : scene.emitted(*free)) candidates.push_back(std::move(candidate));
  const std::vector<Bodies> exact = scene.exact(reference, sampling);
  std::vector<FormCurve> curves;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    fill(candidates[c], steps, sampling, exact, seconds, [&](double done) {
      progress("equations of the first kind", (double(c) + done) / double(candidates.size()));
    });
    curves.push_back(std::move(candidates[c].curve));
  }
  return curves;
}

}  // namespace jourdain::studies
