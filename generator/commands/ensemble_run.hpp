// Ensembles of a model: drawn, stepped in vectors and threads by a program that the machine's compiler makes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/ensemble_result.hpp"
#include "commands/run_setup.hpp"
#include "commands/spreads.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::commands {

struct EnsembleChoices {
  std::string method = "rk4", real = "double";
  bool turns_sines = false;
  std::uint64_t seed = 1;
  std::uint64_t threads = 0;   ///< 0: as many as the machine runs at once
  std::vector<double> inputs;  ///< one value each
};

/// Do initial values follow a parameter that is drawn?
bool starts_follow(const RunModel& model, const std::vector<Spread>& spreads);

/// Compiles once; runs as often as asked for.
class EnsembleProgram {
 public:
  /// Of a model that was emitted for packs, with `initial_state`, the step of the method, outputs and what closes
  /// loops.
  /// Throws EnvironmentError where the compiler cannot be run or fails.
  EnsembleProgram(const RunModel& model, const CompiledModel& compiled, const std::vector<Spread>& spreads,
                  const EnsembleChoices& choices);

  /// `steps` steps of length `h`, s, of the states begin to end - 1, by their numbers. All that is no number is the
  /// same NaN.
  EnsembleRows run(std::uint64_t begin, std::uint64_t end, std::uint64_t steps, double h) const;

  /// SHA-256 of all that is compiled: of the same programs the same.
  const std::string& sha256() const { return sha256_; }

 private:
  EnsembleChoices choices_;
  std::size_t numbers_ = 0;  ///< of a row
  std::string sha256_;
  support::TemporaryFolder folder_;
};

}  // namespace jourdain::commands
