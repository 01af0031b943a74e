// What differs between the states of an ensemble: "mass=normal(5%)".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/run_setup.hpp"
#include "commands/signals.hpp"

namespace jourdain::commands {

/// One number that is drawn for each state, about the value that it has.
struct Spread {
  enum class Of { kParameter, kPosition, kVelocity, kInput };
  std::string name;
  Of of = Of::kParameter;
  std::size_t entry = 0;  ///< of the parameters, y, z or u
  bool is_normal = true;  ///< else uniform
  double width = 0;       ///< deviation, or half of the interval; SI units
  double base = 0;        ///< of parameters and inputs; positions and velocities are spread about the start

  /// The value of state k, as the program of an ensemble draws it; of parameters and inputs. `number` is the spread's
  /// place.
  double value(std::uint64_t seed, std::uint64_t k, std::size_t number) const;
};

/// Reads NAME=normal(DEVIATION) and NAME=uniform(HALF), where NAME is a parameter or the column of a position, a
/// velocity or an input, and a width may be a share of a parameter's or an input's value as in 5%. On a mistake prints
/// it.
std::optional<std::vector<Spread>> read_spreads(const std::vector<std::string>& words, const RunModel& model,
                                                const CompiledModel& compiled, const Signals& signals,
                                                const std::vector<double>& inputs);

}  // namespace jourdain::commands
