#include "studies/scene_forms.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

using Eigen::VectorXd;

VectorXd to_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// One classical Runge-Kutta step of x' = f(t, x).
template <class Rates>
VectorXd rk4(double t, const VectorXd& x, double h, Rates&& f) {
  const VectorXd k1 = f(t, x), k2 = f(t + h / 2, x + h / 2 * k1), k3 = f(t + h / 2, x + h / 2 * k2),
                 k4 = f(t + h, x + h * k3);
  return x + h / 6 * (k1 + 2 * (k2 + k3) + k4);
}

/// By a plain numeric reference.
class NumericForm : public SceneForm {
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
  /// Body by body: centre of mass, quaternion w x y z, v, ω; then states beside the mechanism.
  static constexpr Eigen::Index kEntries = 13;

  static VectorXd packed(const reference::AbsoluteState<double>& state) {
    VectorXd x(kEntries * Eigen::Index(state.bodies.size()) + state.states.size());
    x.tail(state.states.size()) = state.states;
    Eigen::Index first = 0;
    for (const auto& body : state.bodies) {
      const Eigen::Quaterniond& q = body.orientation;
      x.segment<kEntries>(first) << body.p_WC, q.w(), q.x(), q.y(), q.z(), body.v_C, body.omega;
      first += kEntries;
    }
    return x;
  }

  reference::AbsoluteState<double> unpacked(double t, const VectorXd& x) const {
    const Eigen::Index others = state_.states.size();
    reference::AbsoluteState<double> state{t, {}, state_.near, x.tail(others)};
    for (Eigen::Index first = 0; first < x.size() - others; first += kEntries) {
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
    f.tail(rates.states.size()) = rates.states;
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

/// By emitted code; the bodies are where the reference of its tree says.
class EmittedForm : public SceneForm {
 public:
  EmittedForm(const Flow<double>& flow, std::size_t method, const Descriptor& absolute)
      : flow_(flow),
        method_(flow.table().methods[method]),
        absolute_(absolute),
        point_(flow.start()),
        memory_(flow.fresh_memory(method_)) {}

  void steps(double t, double h, long count) override {
    point_.t = t;
    flow_.step(method_, point_, h, count, memory_);
  }
  Bodies bodies(double) const override {
    const VectorXd x = to_vector(point_.x);
    const auto positions = static_cast<Eigen::Index>(flow_.position_count());
    return absolute_.absolute_state(point_.t, x.head(positions), x.tail(x.size() - positions));
  }
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
  const Descriptor& absolute_;
  Point<double> point_;
  Memory memory_;
};

}  // namespace

std::unique_ptr<SceneForm> minimal_form(const reference::Reference<double>& model, const Descriptor& absolute,
                                        const Inputs& inputs, const Point<double>& start) {
  return std::make_unique<MinimalForm>(model, absolute, inputs, start);
}

std::unique_ptr<SceneForm> descriptor_form(const Descriptor& model, const Inputs& inputs,
                                           reference::AbsoluteState<double> start, bool projecting) {
  return std::make_unique<DescriptorForm>(model, inputs, std::move(start), projecting);
}

std::unique_ptr<SceneForm> emitted_form(const Flow<double>& flow, std::size_t method,
                                        const Descriptor& absolute) {
  return std::make_unique<EmittedForm>(flow, method, absolute);
}

}  // namespace jourdain::studies
