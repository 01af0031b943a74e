// Seeded random states at which programs, symbolic equations and references are compared.
#pragma once

#include <vector>

#include "dynamics/direction.hpp"
#include "model/mechanism.hpp"
#include "reference/minimal.hpp"
#include "validate/programs.hpp"

namespace jourdain::validate {

/// One point of comparison.
struct Sample {
  double t = 0;
  std::vector<double> parameters, y, z, u, zdot;
  dynamics::Direction direction;  ///< for derivatives
};

/// The sample with quaternions of unit length to 77 digits.
Point point_at(const model::Mechanism& mechanism, const Sample& sample);

reference::VectorX<long double> to_vector(const std::vector<double>& values);

/// The first is the initial state; parameters are varied by up to a tenth from the second on. Where a random
/// state has no values it is moved towards the initial one.
std::vector<Sample> draw_samples(const model::Mechanism& mechanism, std::size_t count);

}  // namespace jourdain::validate
