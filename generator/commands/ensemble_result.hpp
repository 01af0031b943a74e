// An ensemble as it is judged, printed, drawn and kept: what was computed, and where its numbers are.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "commands/ensemble_shard.hpp"

namespace jourdain::commands {

inline constexpr std::uint64_t kMostStates = 100000000;
inline constexpr std::uint64_t kJudged = 32;  ///< first states that are stepped with half the step, too

/// What decides an ensemble's numbers, and what made them. The same for all of its shards.
struct EnsembleFacts {
  std::string generator, compiler;           ///< "Jourdain 0.1.0"; first line of the compiler's --version
  std::string program_sha256;                ///< of all that was compiled
  std::string model, source, source_sha256;  ///< name; file, without folders
  std::string method, real;                  ///< "rk4" or "rk4 with turned sines"; number type
  double step = 0;                           ///< s
  std::uint64_t steps = 0, seed = 0, states = 0;  ///< states: of the whole
  double accuracy = 0;                            ///< what half the step may move ends by, in deviations
  std::vector<std::pair<std::string, double>> parameters, inputs;
  std::vector<std::pair<std::string, std::string>> spreads;  ///< "mass" and "normal(5%)"
};

/// Calls `visit` with the name and the value of each that is no list, in order.
template <class Facts, class Visit>
void for_each_fact(Facts& facts, Visit&& visit) {
  visit("generator", facts.generator);
  visit("compiler", facts.compiler);
  visit("program_sha256", facts.program_sha256);
  visit("model", facts.model);
  visit("source", facts.source);
  visit("source_sha256", facts.source_sha256);
  visit("method", facts.method);
  visit("real", facts.real);
  visit("step", facts.step);
  visit("steps", facts.steps);
  visit("seed", facts.seed);
  visit("states", facts.states);
  visit("accuracy", facts.accuracy);
}

/// Likewise with each list.
template <class Facts, class Visit>
void for_each_list(Facts& facts, Visit&& visit) {
  visit("parameters", facts.parameters);
  visit("inputs", facts.inputs);
  visit("spreads", facts.spreads);
}

struct EnsembleColumn {
  std::string name, unit;  ///< unit may be empty
  bool is_drawn = false;   ///< else of the end

  bool operator==(const EnsembleColumn&) const = default;
};

/// Where states ended, one after the other, by columns.
struct EnsembleRows {
  std::vector<std::vector<double>> columns;  ///< drawn, in the order of the spreads; y, z, outputs
  std::vector<std::uint8_t> trusted;         ///< 1: finite throughout, outputs at the end, loops closed
};

/// All or a shard of an ensemble.
struct EnsembleResult {
  EnsembleFacts facts;
  Shard shard;
  std::vector<EnsembleColumn> columns;  ///< the drawn ones first
  std::vector<std::uint8_t> trusted;    ///< 1 or 0 for each state
  EnsembleRows halved;                  ///< ends of the first states with half the step
  std::function<std::vector<double>(std::size_t column)> values;  ///< one for each state

  std::size_t drawn_count() const;
  /// The values, one for each state, of those that are trusted.
  std::vector<double> of_trusted(const std::vector<double>& values_of_all) const;
};

/// How many of a shard's first states are stepped with half the step.
std::uint64_t judged_count(const Shard& shard);

/// How two ensembles differ whose numbers do not belong together, as in "seed is 8, not 7"; empty: in nothing but the
/// states that they hold.
std::string difference(const EnsembleResult& of, const EnsembleResult& from);

}  // namespace jourdain::commands
