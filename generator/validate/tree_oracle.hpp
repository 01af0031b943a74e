// What the functions of a mechanism without loops should compute at one state: from the symbolic equations, by
// dense algebra.
#pragma once

#include <vector>

#include "dynamics/equations.hpp"
#include "model/mechanism.hpp"
#include "validate/programs.hpp"

namespace jourdain::validate {

/// The equations at one state, in 77 digits. It refers to what it is made from.
class TreeOracle {
 public:
  /// Where derivatives of the residual hold those of applied forces alone, `load` are the equations without
  /// gravity, whose q̄ they belong to.
  TreeOracle(const model::Mechanism& mechanism, const dynamics::Equations& equations,
             const dynamics::Equations* load, const Point& point);

  std::vector<Expected> operator()(const ir::Program& program) const;

  const ExactMatrix& M() const { return M_; }
  const ExactVector& k_bar() const { return k_; }
  const ExactVector& q_bar() const { return q_; }
  /// M⁻¹ (k̄ − q̄)
  const ExactVector& zdot() const { return zdot_; }
  std::vector<ScaledReal> values(const std::vector<kinematics::Ex>& expressions) const {
    return exact_.values(expressions);
  }

 private:
  std::vector<Expected> acceleration_derivatives() const;
  std::vector<Expected> linearization() const;
  std::vector<Expected> kinematics(const ir::Program& program, std::size_t k) const;
  ExactVector given_accelerations() const;
  ExactVector forces_without_inputs() const;
  Expected state(const ir::Program& program) const;
  std::vector<ScaledReal> mass_entries(const ir::Program& program, const std::string& array) const;
  dynamics::SlopePrecision moved(const dynamics::Equations& equations,
                                 const dynamics::ExactDirection& direction) const;
  ExactVector residual_rate() const;
  ExactVector acceleration_rate(const dynamics::ExactDirection& direction) const;
  std::vector<ScaledReal> displacement_rate() const;
  std::vector<ScaledReal> output_rate() const;

  const model::Mechanism& mechanism_;
  const dynamics::Equations &equations_, *load_;
  const Point& point_;
  model::Tangent tangent_;
  dynamics::LeafValue leaf_;
  dynamics::HighPrecision exact_;
  ExactMatrix M_;
  ExactVector k_, q_, zdot_;
};

/// The leaves of the equations at a point.
dynamics::LeafValue leaves_at(const ir::LeafValues<ScaledReal>& values);

}  // namespace jourdain::validate
