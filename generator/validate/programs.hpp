// Programs at one state, in 77 digits and in double, against what they should compute.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/direction.hpp"
#include "ir/module.hpp"
#include "reference/exact_algebra.hpp"
#include "validate/agreement.hpp"

namespace jourdain::validate {

using reference::determinant;
using reference::ExactMatrix;
using reference::ExactVector;
using reference::solved;
using reference::to_exact;
using reference::to_list;

/// Where programs are evaluated. Derivatives are contracted with the direction.
struct Point {
  ir::LeafValues<ScaledReal> exact;
  ir::LeafValues<double> rounded;  ///< the nearest doubles
  dynamics::ExactDirection direction;
  std::size_t output_numbers = 0;
  std::size_t states = 0;  ///< velocities that displace nothing; asked for where others are carried along
};

/// A part of what a program computes: all its numbers, or Jacobians times the direction, row by row.
struct Part {
  std::string name;
  std::vector<ScaledReal> values;
};

/// What a part should be, and by what.
struct Expected {
  std::string oracle;
  std::vector<ScaledReal> values;
  /// By differences: they know nothing of how rounding is amplified.
  bool scales_are_unknown = false;
  /// Numbers of which it only knows that they are positive and no more than this.
  std::vector<std::size_t> shares = {};
  double largest_share = 1;
  /// What it may be as well, by another rule.
  std::function<Expected()> otherwise = {};
  /// The share of their scale that numbers of the program may differ by.
  long double allowed = kAlgebra;
};

/// Of a program with one part.
inline std::vector<Expected> expecting(const char* oracle, std::vector<ScaledReal> values) {
  return {{oracle, std::move(values)}};
}

/// Which function a program computes. One that is not in the table has no oracle: it throws.
ir::FunctionId function_of(const ir::Program& program);

/// Whether its numbers are derivatives of those of others, which have two at a kink.
bool is_derivative(const ir::Program& program);
ir::Module without_derivatives(ir::Module module);

/// What the parts of a program should be, in the order of `parts_of`. A function without an oracle cannot be
/// emitted: it throws.
using Oracle = std::function<std::vector<Expected>(const ir::Program&)>;

std::vector<Part> parts_of(const ir::Program& program, const std::vector<ScaledReal>& values,
                           const Point& point);

void compare_programs(const ir::Module& module, const Point& point, const Oracle& oracle,
                      Agreement& agreement);

/// The nearest doubles of all leaves.
ir::LeafValues<double> rounded(const ir::LeafValues<ScaledReal>& leaves);

}  // namespace jourdain::validate
