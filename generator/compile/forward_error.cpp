#include "compile/forward_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace jourdain {

namespace {

constexpr std::size_t kStates = 8;         // those of the validation
constexpr std::size_t kExtremeStates = 5;  // the first of them, at extremes
constexpr double kExtreme = 1e6;
/// Operations in 77 digits that are worth looking at extremes.
constexpr std::size_t kMostOperations = 100000;

double units_at(const ir::Program& zdot, const validate::Point& point) {
  const std::vector<support::ScaledReal> exact = ir::interpret(zdot, point.exact);
  const std::vector<double> found = ir::interpret(zdot, point.rounded);
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (!isfinite(exact[i])) return 0;  // no accelerations there
    if (!std::isfinite(found[i])) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::fabs(static_cast<double>(exact[i])));
    error = std::max(error, std::fabs(static_cast<double>(exact[i] - support::ScaledReal(found[i]))));
  }
  return largest > 0 ? error / largest / 0x1p-53 : 0;
}

}  // namespace

ForwardError::ForwardError(const model::Mechanism& mechanism)
    : mechanism_(mechanism), samples_(validate::draw_samples(mechanism, kStates)) {
  for (validate::Sample& sample : samples_) sample.t = 0;  // how angles of time are rounded is another matter
  Case& usual = cases_.emplace_back();
  for (const validate::Sample& sample : samples_)
    usual.points.push_back(validate::point_at(mechanism, sample));
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i) {
    const model::Parameter& parameter = mechanism.parameters[i];
    const std::array<double, 2> ends = parameter.range.value_or(
        std::array<double, 2>{parameter.value / kExtreme, parameter.value * kExtreme});
    for (const double end : ends) add(fmt::format("{} = {:g}", parameter.name, end), i, end);
  }
}

void ForwardError::add(const std::string& where, std::size_t parameter, double value) {
  Case& extreme = cases_.emplace_back();
  extreme.where = where;
  for (std::size_t k = 0; k < kExtremeStates; ++k) {
    validate::Sample sample = samples_[k];
    sample.parameters[parameter] = value;
    extreme.points.push_back(validate::point_at(mechanism_, sample));
  }
}

SampledError ForwardError::of(const ir::Program& zdot) const {
  SampledError worst;
  const std::size_t all = zdot.nodes.size() * kExtremeStates * cases_.size();
  for (const Case& each : cases_) {
    if (&each != cases_.data() && all > kMostOperations) break;
    std::vector<double> units;
    for (const validate::Point& point : each.points) units.push_back(units_at(zdot, point));
    std::sort(units.begin(), units.end());
    const double judged = std::isfinite(units.back()) ? units[units.size() / 2] : units.back();
    if (judged > worst.units) worst = {judged, each.where};
  }
  return worst;
}

}  // namespace jourdain
