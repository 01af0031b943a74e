// [[spring]]
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"
#include "model/indices.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// A spring-damper between the origins of two frames on different bodies. Tension (pulls the ends together), N:
/// stiffness (l − free_length) + damping dl/dt + law(l, dl/dt), with l = √(|Δr|² + kLengthSmoothing²).
struct Spring {
  std::string name;
  FrameIndex from, to;
  Expression stiffness;                 ///< N/m
  Expression damping;                   ///< N s/m
  Expression free_length;               ///< m
  Expression law;                       ///< of arguments 0 (length, m) and 1 (rate, m/s); N
  std::optional<Expression> potential;  ///< of argument 0: energy of the law's conservative part, J
  support::SourceRange where = {};

  static constexpr std::string_view kKind = "spring";
  static std::optional<ScalarCoordinate> pushed() { return {}; }
  std::vector<FrameIndex> ends() const { return {from, to}; }
  std::vector<Expression*> expressions();
  bool conserves_energy() const {
    return damping.is_zero() && (law.is_zero() || (potential && !names_rate()));
  }
  /// Whether the law does.
  bool names_rate() const {
    return any_variable(law, [](const Variable& variable) { return variable.component == 1; });
  }
  static std::string assumption();
};

/// Keeps the direction of a point-to-point force defined at zero length, m.
inline constexpr double kLengthSmoothing = 1e-12;

}  // namespace jourdain::model
