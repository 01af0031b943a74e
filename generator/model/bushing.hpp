// [[bushing]]
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"
#include "model/indices.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Six spring-dampers between two frames on different bodies, along and about the axes of `from`. In these axes, with d
/// from the origin of `from` to that of `to`, ḋ as seen there, ω the angular velocity of `to` relative to `from`, and
/// θ = 2 sin(φ/2) n of the rotation by φ about n that turns `from` into `to`:
///
///   potential     ½ Σ stiffness_i d_i² + ½ Σ torsional_stiffness_i θ_i²
///   force         −(stiffness_i d_i + damping_i ḋ_i), on the body of `to` at its origin
///   moment        that of the potential less torsional_damping_i ω_i, on the body of `to`
///
/// and both reversed on the body of `from`, the force on the same line of action: at the origin of `to`. A turn about
/// one of the axes meets the moment −torsional_stiffness_i sin φ: θ is the angle where that is small, and its potential
/// is greatest after half a turn. Exchanging the frames changes neither the torsional potential nor, where the
/// three stiffnesses are equal, the other one; it changes what the damping of d does, which belongs to the
/// axes of `from`.
struct Bushing {
  std::string name;
  FrameIndex from, to;
  Vector3 stiffness, damping;                      ///< N/m, N s/m
  Vector3 torsional_stiffness, torsional_damping;  ///< N m/rad, N m s/rad
  support::SourceRange where = {};

  static constexpr std::string_view kKind = "bushing";
  static std::optional<ScalarCoordinate> pushed() { return {}; }
  std::vector<FrameIndex> ends() const { return {from, to}; }
  std::vector<Expression*> expressions();
  bool conserves_energy() const;
  static std::string assumption();
};

}  // namespace jourdain::model
