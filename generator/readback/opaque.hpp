// The functions that steps call, as functions of which nothing is known but that equal arguments give equal results.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "readback/expected.hpp"
#include "readback/reals.hpp"

namespace jourdain::readback {

/// Of a State: time, positions, velocities, and what its last closing left (regularity, opening, beyond).
struct Motion {
  Exact t = exact(0.0);
  ExactVector y, z, guards;
};

struct Derivatives {
  ExactMatrix M, r_y, r_z, r_u;
  ExactVector r_t;
};

/// What a step of the text and the definition of its method both call. While the text is executed every call
/// with new arguments gets random results; the definition must then ask for exactly these.
class OpaqueSystem {
 public:
  OpaqueSystem(const Expected& expected, std::uint64_t seed) : expected_(expected), random_(seed) {}

  ExactVector position_rate(const Motion& motion);
  ExactVector forward_dynamics(const Motion& motion, const ExactVector& input);
  ExactVector residual(const Motion& motion, const ExactVector& input, const ExactVector& accelerations);
  /// Zero where the program has no entry.
  Derivatives residual_derivatives(const Motion& motion, const ExactVector& input,
                                   const ExactVector& accelerations);
  /// close_loops or project: replaces what its program sets.
  void correct(Motion& motion);
  /// sample, with which a step begins: replaces what its program sets.
  void take_samples(Motion& motion, const ExactVector& input, const Exact& h);
  /// An input that is a function of the state.
  ExactVector sample(const Motion& motion);

  /// From now on only calls that were made before are answered; others throw Refusal.
  void freeze() { frozen_ = true; }
  /// A function that was called by the text alone, or empty.
  std::string unused() const;
  /// Calls by the text; calls that repeat others count.
  int calls(const std::string& function) const;
  /// Of one call, as counted in its program.
  std::size_t operations_of_calls() const;

  Random& random() { return random_; }

 private:
  struct Call {
    ExactVector arguments, results;
    bool used = false;
  };
  const ExactVector& answer(const std::string& function, ExactVector arguments, std::size_t results);
  const ir::Program& program(const std::string& name) const;

  const Expected& expected_;
  Random random_;
  bool frozen_ = false;
  std::map<std::string, std::vector<Call>> calls_;
  std::map<std::string, int> counts_;
};

/// Equal but for rounding in 70 digits.
bool is_close(const Exact& a, const Exact& b, double scale);

}  // namespace jourdain::readback
