// Shards of an ensemble put together.
#pragma once

#include <string>
#include <vector>

#include "commands/ensemble_result.hpp"

namespace jourdain::commands {

/// An ensemble and the file that it was read from.
struct StoredShard {
  std::string path;
  EnsembleResult result;
};

/// Sentences on what keeps the shards, at least one, from being one ensemble: those of others than the first, states
/// that several have or none has, and what to run again. Empty: nothing.
std::vector<std::string> merge_problems(const std::vector<StoredShard>& shards);

/// The ensemble of shards without problems: as if it had been computed at once. Values are read from theirs.
EnsembleResult merged(std::vector<StoredShard> shards);

}  // namespace jourdain::commands
