#include "loops/closed_form/near_states.hpp"

#include <algorithm>
#include <cmath>

#include "passes/rewrite.hpp"
#include "support/uniform.hpp"

namespace jourdain::loops {

using ir::LeafKind;

namespace {

constexpr double kFarthest = 0.3;
/// Formulas of an identity differ by rounding, others by their size.
constexpr double kAgreement = 1e-9;

}  // namespace

Samples samples_near(const std::vector<double>& initial_y, const std::vector<bool>& varied,
                     const std::vector<double>& parameters,
                     const std::vector<std::optional<std::array<double, 2>>>& parameter_range,
                     std::size_t count) {
  support::Uniform uniform(1);
  double radius = kFarthest;
  const auto offset = [&] { return uniform(-radius, radius); };
  Samples samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i][LeafKind::kPosition] = initial_y;
    samples[i][LeafKind::kParameter] = parameters;
    samples[i][LeafKind::kTime] = {0};
    if (i == 0) continue;
    for (std::size_t k = 0; k < initial_y.size(); ++k)
      if (varied[k]) samples[i][LeafKind::kPosition][k] += offset();
    samples[i][LeafKind::kTime][0] += offset();
    for (std::size_t k = 0; k < parameter_range.size(); ++k)
      if (const auto& range = parameter_range[k]) {
        double& value = samples[i][LeafKind::kParameter][k];
        value += offset() / kFarthest * ((*range)[1] - (*range)[0]) / 2;
        value = std::clamp(value, (*range)[0], (*range)[1]);
      }
    radius /= 2;
  }
  return samples;
}

namespace {

/// None of no values.
ir::Program program_of(const std::vector<Scalar>& values) {
  if (values.empty()) return {};
  ir::Builder builder = *values[0].builder;
  for (const Scalar& value : values) builder.output("value", -1, -1, value.value);
  return passes::remove_dead_code(builder.finish("values"));
}

}  // namespace

std::vector<std::vector<double>> evaluated(const std::vector<Scalar>& values, const Samples& samples) {
  std::vector<std::vector<double>> results;
  const ir::Program program = program_of(values);
  for (const ir::LeafValues<double>& sample : samples) results.push_back(ir::interpret(program, sample));
  return results;
}

std::vector<std::vector<support::ScaledReal>> exactly_evaluated(const std::vector<Scalar>& values,
                                                                const Samples& samples) {
  std::vector<std::vector<support::ScaledReal>> results;
  const ir::Program program = program_of(values);
  for (const ir::LeafValues<double>& sample : samples) {
    ir::LeafValues<support::ScaledReal> exact;
    for (std::size_t kind = 0; kind < sample.of.size(); ++kind)
      exact.of[kind].assign(sample.of[kind].begin(), sample.of[kind].end());
    results.push_back(ir::interpret(program, exact));
  }
  return results;
}

double initial(Scalar value, const Samples& samples) { return evaluated({value}, {samples[0]})[0][0]; }

bool agree(Scalar a, Scalar b, Scalar scale, const Samples& samples) {
  for (const std::vector<double>& values : evaluated({a, b, scale}, samples))
    if (std::fabs(values[0] - values[1]) > kAgreement * std::fabs(values[2])) return false;
  return true;
}

bool vanishes(Scalar a, Scalar scale, const Samples& samples) {
  return agree(a, {a.builder, a.builder->literal(0)}, scale, samples);
}

}  // namespace jourdain::loops
