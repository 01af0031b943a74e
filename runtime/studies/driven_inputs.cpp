#include "studies/driven_inputs.hpp"

#include <algorithm>

#include "model/coordinates.hpp"
#include "model/taylor.hpp"
#include "studies/flow.hpp"
#include "support/check.hpp"

namespace jourdain::studies {

namespace {

using model::Taylor;

/// Value and derivatives in t.
template <class Real>
Taylor<Real> value_at(const model::Expression& expression, const Real& t,
                      const std::vector<double>& parameters) {
  const auto constant = [](double value) { return Taylor<Real>{Real(value), Real(0.0), Real(0.0)}; };
  std::vector<Taylor<Real>> values;
  for (const double parameter : parameters) values.push_back(constant(parameter));
  return expression.evaluate<Taylor<Real>>(values, constant, [&t](const model::Variable&) {
    return Taylor<Real>{t, Real(1.0), Real(0.0)};
  });
}

template <class Real>
std::vector<Real> values_at(const std::vector<model::Expression>& expressions, const Real& t,
                            const std::vector<double>& parameters) {
  std::vector<Real> values;
  for (const model::Expression& expression : expressions)
    values.push_back(value_at<Real>(expression, t, parameters).value);
  return values;
}

bool any_has_kinks(const std::vector<model::Expression>& expressions) {
  return std::ranges::any_of(expressions, [](const model::Expression& e) { return e.has_kinks(); });
}

}  // namespace

std::vector<double> ExpressionInputs::at(double t) const {
  return values_at<double>(inputs_, t, parameters_);
}

std::vector<LongReal> ExpressionInputs::at(const LongReal& t) const {
  return values_at<LongReal>(inputs_, t, parameters_);
}

bool ExpressionInputs::has_kinks() const { return any_has_kinks(inputs_); }

FollowingInputs::FollowingInputs(const model::Mechanism& mechanism, std::vector<model::Expression> motion,
                                 std::vector<double> parameters, const jourdain_model_table& table,
                                 const jourdain_model_table* long_table)
    : motion_(std::move(motion)),
      parameters_(std::move(parameters)),
      input_count_(static_cast<std::size_t>(table.input_count)),
      table_(table),
      long_table_(long_table) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  JD_CHECK(motion_.size() == layout.velocity_count(), "{} motions", motion_.size());
  for (std::size_t entry = 0; entry < motion_.size(); ++entry)
    for (std::size_t a = mechanism.actuators.size(); a-- > 0;) {
      const model::Actuator& actuator = mechanism.actuators[a];
      if (layout.joints[actuator.joint.value].velocity[actuator.coordinate] != entry) continue;
      drives_.resize(entry + 1);
      drives_[entry] = {a, actuator.gear_ratio.evaluate(std::span<const double>(parameters_))};
    }
  JD_CHECK(drives_.size() == motion_.size(), "{} drives for {} motions", drives_.size(), motion_.size());
}

template <class Real>
std::vector<Real> FollowingInputs::inputs_at(const Real& t, const jourdain_model_table& table) const {
  std::vector<Real> y, z, zdot;
  for (const model::Expression& motion : motion_) {
    const Taylor<Real> value = value_at<Real>(motion, t, parameters_);
    y.push_back(value.value);
    z.push_back(value.first);
    zdot.push_back(value.second);
  }
  const std::vector<Real> forces = inverse_dynamics(table, t, y, z, zdot);
  std::vector<Real> inputs(input_count_, Real(0.0));
  for (std::size_t i = 0; i < drives_.size(); ++i)
    inputs[drives_[i].input] = forces[i] / Real(drives_[i].gear_ratio);
  return inputs;
}

std::vector<double> FollowingInputs::at(double t) const { return inputs_at<double>(t, table_); }

std::vector<LongReal> FollowingInputs::at(const LongReal& t) const {
  JD_CHECK(long_table_, "no table in 50 digits");
  constexpr std::size_t kMostKnown = 50000;
  std::array<double, 4> key{};
  t.split(key.data(), 4);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  if (known_.size() >= kMostKnown) known_.clear();
  return known_[key] = inputs_at<LongReal>(t, *long_table_);
}

bool FollowingInputs::has_kinks() const { return any_has_kinks(motion_); }

std::vector<double> FollowingInputs::state_at(double t) const {
  std::vector<double> x, z;
  for (const model::Expression& motion : motion_) {
    const Taylor<double> value = value_at<double>(motion, t, parameters_);
    x.push_back(value.value);
    z.push_back(value.first);
  }
  x.insert(x.end(), z.begin(), z.end());
  return x;
}

}  // namespace jourdain::studies
