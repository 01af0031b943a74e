#include "studies/first_kind.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string_view>

#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"
#include "studies/tangent_space.hpp"
#include "studies/work.hpp"

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;
using Bodies = std::vector<reference::AbsoluteBody<double>>;
using Descriptor = reference::DescriptorReference<double>;

constexpr double kLost = 1e3;  ///< m; a run that is further off counts as failed

VectorXd to_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// y and z of the tree at a state of the flow, whose velocities may be the independent ones alone: the rates of the positions tell
/// all of them.
class TreeStates {
 public:
  TreeStates(const model::Mechanism& mechanism, const Flow<double>& flow)
      : flow_(flow),
        layout_(model::lay_out_coordinates(mechanism)),
        tangent_(model::tangent_of(mechanism, layout_)) {}

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
    return z;
  }

 private:
  const Flow<double>& flow_;
  model::CoordinateLayout layout_;
  model::Tangent tangent_;
};

/// One classical Runge-Kutta step of x' = f(t, x).
template <class Rates>
VectorXd rk4(double t, const VectorXd& x, double h, Rates&& f) {
  const VectorXd k1 = f(t, x), k2 = f(t + h / 2, x + h / 2 * k1), k3 = f(t + h / 2, x + h / 2 * k2),
                 k4 = f(t + h, x + h * k3);
  return x + h / 6 * (k1 + 2 * (k2 + k3) + k4);
}

/// The scene in one form: its state as a vector, steps, and where the bodies are.
class Form {
 public:
  virtual ~Form() = default;
  virtual void steps(double t, double h, long count) = 0;
  virtual Bodies bodies(double t) const = 0;
  /// |g| and |G x + g_t| now.
  virtual std::pair<double, double> drift(double) const { return {0, 0}; }
  virtual bool finite() const = 0;
};

/// By a plain numeric reference.
class NumericForm : public Form {
 public:
  void steps(double t, double h, long count) override {
    for (long i = 0; i < count; ++i) step(t + static_cast<double>(i) * h, h);
  }

 private:
  virtual void step(double t, double h) = 0;
};

class MinimalForm : public NumericForm {
 public:
  MinimalForm(const reference::Reference<double>& model, const Descriptor& absolute, const Inputs& inputs,
              const Point<double>& start)
      : model_(model), absolute_(absolute), inputs_(inputs), x_(to_vector(start.x)) {}

  void step(double t, double h) override {
    x_ = rk4(t, x_, h, [this](double time, const VectorXd& x) { return rates(time, x); });
    for (const std::size_t first : absolute_.layout().quaternions)
      x_.segment<4>(Eigen::Index(first)).normalize();
  }
  Bodies bodies(double t) const override {
    return absolute_.absolute_state(t, x_.head(positions()), x_.tail(x_.size() - positions()));
  }
  bool finite() const override { return x_.allFinite(); }

 private:
  Eigen::Index positions() const { return static_cast<Eigen::Index>(model_.position_count()); }

  VectorXd rates(double t, const VectorXd& x) const {
    const reference::State<double> state{t, x.head(positions()), x.tail(x.size() - positions())};
    const reference::Terms<double> terms = model_.evaluate(state, to_vector(inputs_.at(t)));
    VectorXd f(x.size());
    f << model_.position_rate(state), reference::forward_dynamics(terms);
    return f;
  }

  const reference::Reference<double>& model_;
  const Descriptor& absolute_;
  const Inputs& inputs_;
  VectorXd x_;
};

class DescriptorForm : public NumericForm {
 public:
  DescriptorForm(const Descriptor& model, const Inputs& inputs, reference::AbsoluteState<double> start,
                 bool projecting)
      : model_(model), inputs_(inputs), projecting_(projecting), state_(std::move(start)) {}

  void step(double t, double h) override {
    const auto rates = [this](double time, const VectorXd& x) { return derivative(time, x); };
    state_ = unpacked(t + h, rk4(t, packed(state_), h, rates));
    for (auto& body : state_.bodies) body.orientation.normalize();
    if (projecting_) state_ = model_.projected(std::move(state_));
  }
  Bodies bodies(double) const override { return state_.bodies; }
  std::pair<double, double> drift(double t) const override {
    const auto rates = model_.rates(state_, to_vector(inputs_.at(t)));
    const auto largest = [](const VectorXd& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0.0; };
    return {largest(rates.g), largest(rates.g_rate)};
  }
  bool finite() const override { return packed(state_).allFinite(); }

 private:
  /// Body by body: centre of mass, quaternion w x y z, v, ω.
  static constexpr Eigen::Index kEntries = 13;

  static VectorXd packed(const reference::AbsoluteState<double>& state) {
    VectorXd x(kEntries * Eigen::Index(state.bodies.size()));
    Eigen::Index first = 0;
    for (const auto& body : state.bodies) {
      const Eigen::Quaterniond& q = body.orientation;
      x.segment<kEntries>(first) << body.p_WC, q.w(), q.x(), q.y(), q.z(), body.v_C, body.omega;
      first += kEntries;
    }
    return x;
  }

  reference::AbsoluteState<double> unpacked(double t, const VectorXd& x) const {
    reference::AbsoluteState<double> state{t, {}, state_.near};
    for (Eigen::Index first = 0; first < x.size(); first += kEntries) {
      const auto entry = x.segment<kEntries>(first);
      state.bodies.push_back({entry.head<3>(), Eigen::Quaterniond(entry[3], entry[4], entry[5], entry[6]),
                              entry.segment<3>(7), entry.tail<3>()});
    }
    return state;
  }

  VectorXd derivative(double t, const VectorXd& x) {
    reference::AbsoluteState<double> state = unpacked(t, x);
    for (auto& body : state.bodies) body.orientation.normalize();
    const auto rates = model_.rates(state, to_vector(inputs_.at(t)));
    state_.near = rates.near;
    VectorXd f(x.size());
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      const Eigen::Index first = kEntries * Eigen::Index(b);
      const Eigen::Vector3d& omega = state.bodies[b].omega;
      const Eigen::Quaterniond spin(0, omega.x() / 2, omega.y() / 2, omega.z() / 2);
      const Eigen::Quaterniond turn = state.bodies[b].orientation * spin;
      f.segment<kEntries>(first) << state.bodies[b].v_C, turn.w(), turn.x(), turn.y(), turn.z(),
          rates.xdot.segment<6>(6 * Eigen::Index(b));
    }
    return f;
  }

  const Descriptor& model_;
  const Inputs& inputs_;
  bool projecting_;
  reference::AbsoluteState<double> state_;
};

/// By emitted code; `place` says where the bodies are at a point of its flow.
class EmittedForm : public Form {
 public:
  using Place = std::function<Bodies(const Point<double>&)>;

  EmittedForm(const Flow<double>& flow, std::size_t method, Place place)
      : flow_(flow),
        method_(flow.table().methods[method]),
        place_(std::move(place)),
        point_(flow.start()),
        memory_(flow.fresh_memory(method_)) {}

  void steps(double t, double h, long count) override {
    point_.t = t;
    flow_.step(method_, point_, h, count, memory_);
  }
  Bodies bodies(double) const override { return place_(point_); }
  std::pair<double, double> drift(double) const override {
    const Residuals open = flow_.residuals(point_);
    return {open.position, open.velocity};
  }
  bool finite() const override {
    return std::all_of(point_.x.begin(), point_.x.end(), [](double entry) { return std::isfinite(entry); });
  }

 private:
  const Flow<double>& flow_;
  const jourdain_method& method_;
  Place place_;
  Point<double> point_;
  Memory memory_;
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

FormPoint run(Form& form, double h, double sampling, const std::vector<Bodies>& exact) {
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
  std::function<std::unique_ptr<Form>()> make;
};

/// The table's classical Runge-Kutta method.
std::optional<std::size_t> runge_kutta(const jourdain_model_table& table) {
  for (int m = 0; m < table.method_count; ++m)
    if (std::string_view(table.methods[m].name) == "rk4") return static_cast<std::size_t>(m);
  return {};
}

VectorXd part(const Point<double>& point, std::size_t first, std::size_t last) {
  return Eigen::Map<const VectorXd>(point.x.data() + first, Eigen::Index(last - first));
}

std::optional<Candidate> emitted_candidate(const std::string& name, const Flow<double>& flow,
                                           const Descriptor& absolute, int unknowns) {
  const std::optional<std::size_t> method = runge_kutta(flow.table());
  if (!method) return {};
  const auto place = [&flow, &absolute](const Point<double>& point) {
    return absolute.absolute_state(point.t, part(point, 0, flow.position_count()),
                                   part(point, flow.position_count(), flow.size()));
  };
  return Candidate{{name, static_cast<int>(flow.size()), unknowns, {}},
                   step_time(flow.table().methods[*method]),
                   [&flow, method, place] { return std::make_unique<EmittedForm>(flow, *method, place); }};
}

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

/// The scene as free bodies, from where and as they move at the start.
struct FreeScene {
  Descriptor absolute;
  Flow<double> flow;

  FreeScene(const EmittedFreeBodies& free, const std::vector<double>& parameters, const Bodies& start)
      : absolute(free.mechanism, std::span<const double>(parameters)), flow(free.flow) {
    flow.set_start(free_state(free.mechanism, parameters, start));
  }
};

}  // namespace

std::vector<FormCurve> study_forms(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                   const Flow<double>& flow, const EmittedFreeBodies* free,
                                   const std::vector<double>& steps, double sampling,
                                   const ReferenceSolution& reference, double seconds,
                                   const Progress& progress) {
  const reference::Reference<double> minimal(mechanism, std::span<const double>(parameters));
  const Descriptor absolute(mechanism, std::span<const double>(parameters));
  const Inputs& inputs = flow.inputs();
  const TreeStates states(mechanism, flow);
  const Point<double>& start = reference.points.front();
  const auto absolute_start = absolute.absolute(start.t, states.positions(start), states.velocities(start));
  const std::vector<Bodies> exact = exact_bodies(absolute, states, reference, sampling);
  const auto unknowns =
      static_cast<int>(absolute.rates(absolute_start, to_vector(inputs.at(start.t))).unknowns);
  const auto nb = static_cast<int>(mechanism.bodies.size()),
             nz = static_cast<int>(minimal.coordinate_count());
  std::vector<Candidate> candidates;
  const auto add_numeric = [&](const std::string& name, int size, int system,
                               std::function<std::unique_ptr<Form>()> make) {
    FormCurve curve{name, size, system, {}};
    const double time = form_step_time(curve, nb);
    candidates.push_back({std::move(curve), time, std::move(make)});
  };
  if (!flow.has_loops())
    add_numeric("minimal coordinates", static_cast<int>(start.x.size()), nz,
                [&] { return std::make_unique<MinimalForm>(minimal, absolute, inputs, start); });
  for (const bool projecting : {false, true})
    add_numeric(projecting ? "descriptor form, projected" : "descriptor form", 13 * nb, unknowns,
                [&, projecting] {
                  return std::make_unique<DescriptorForm>(absolute, inputs, absolute_start, projecting);
                });
  std::optional<FreeScene> free_scene;
  if (free) {
    free_scene.emplace(*free, parameters, absolute_start.bodies);
    if (auto candidate = emitted_candidate("emitted: minimal coordinates", flow, absolute, nz))
      candidates.push_back(std::move(*candidate));
    if (auto candidate = emitted_candidate("emitted: free bodies", free_scene->flow, free_scene->absolute,
                                           free->flow.table().constraint_count))
      candidates.push_back(std::move(*candidate));
  }
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
