// Free motion as the compiler's programs have it: compiled as the command does by default, stepped as the
// emitted rk4_step does.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compile/compile.hpp"
#include "model/mechanism.hpp"

namespace jourdain::tests {

struct CompiledLinkage {
  loops::LoopPlan plan;
  CompiledModel model;
};

/// What the command would write, or its words on why it writes nothing.
std::variant<CompiledLinkage, std::string> compiled_or_refused(const model::Mechanism& mechanism);

struct SwingState {
  double t = 0;  ///< s
  std::vector<double> y, z;
};

/// What a step's closing says of itself; absent where it says nothing.
struct ClosingReport {
  std::optional<double> regularity, opening;
};

/// Steps of one compiled mechanism at the parameters' default values, inputs zero.
class CompiledSwing {
 public:
  /// Both must outlive this.
  CompiledSwing(const model::Mechanism& mechanism, const CompiledModel& compiled);

  SwingState start() const;
  /// Classical Runge-Kutta step of length h (s), quaternions brought to unit length, loops closed.
  ClosingReport step(SwingState& state, double h) const;

  double kinetic_energy(const SwingState& state) const;  ///< J
  double energy(const SwingState& state) const;          ///< kinetic and potential, J
  /// Largest |g| of the loops' rows, m or without unit.
  double opening(const SwingState& state) const;
  /// Arithmetic operations of a step's evaluations and its closing.
  std::size_t step_operations() const;

 private:
  struct Rates {
    std::vector<double> y, z;
  };

  const ir::Program* find(const char* function) const { return ir::find_program(compiled_.module, function); }
  std::vector<double> values(const ir::Program& program, const SwingState& state) const;
  double scalar(const char* function, const SwingState& state) const;
  Rates rates(const SwingState& state) const;

  const CompiledModel& compiled_;
  const ir::Program *position_rate_, *forward_dynamics_, *closing_;
  mutable ir::LeafValues<double> leaves_;
};

}  // namespace jourdain::tests
