// Seeded random states at which programs, symbolic equations and references are compared.
#pragma once

#include <optional>
#include <vector>

#include "dynamics/direction.hpp"
#include "model/mechanism.hpp"
#include "reference/minimal.hpp"
#include "support/uniform.hpp"
#include "validate/programs.hpp"

namespace jourdain::validate {

/// One point of comparison.
struct Sample {
  double t = 0;
  std::vector<double> parameters, y, z, u, zdot;
  double h = 0;                   ///< of a step that begins, s
  dynamics::Direction direction;  ///< for derivatives
};

/// The sample with quaternions of unit length to 77 digits.
Point point_at(const model::Mechanism& mechanism, const Sample& sample);

reference::VectorX<long double> to_vector(const std::vector<double>& values);

/// The first is the initial state; parameters are varied by up to a tenth from the second on. Where a random
/// state has no values it is moved towards the initial one.
std::vector<Sample> draw_samples(const model::Mechanism& mechanism, std::size_t count);

/// States of all sizes, from a thousandth to a hundred times those of draw_samples.
class FarSamples {
 public:
  explicit FarSamples(const model::Mechanism& mechanism);

  /// Nothing where the equations have no values there.
  std::optional<Sample> draw();

 private:
  const model::Mechanism& mechanism_;
  support::Uniform uniform_;
};

}  // namespace jourdain::validate
