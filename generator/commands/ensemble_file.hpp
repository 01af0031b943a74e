// Ensembles in files: HDF5 behind a head of 512 bytes that holds the SHA-256 of all that follows. The same ensemble
// gives the same bytes. runtime/ensembles.md has the layout.
#pragma once

#include <optional>
#include <string>

#include "commands/ensemble_result.hpp"

namespace jourdain::commands {

/// Does the name end in .h5?
bool is_ensemble_file(const std::string& path);

/// Throws EnvironmentError naming the path.
void write_ensemble_file(const std::string& path, const EnsembleResult& result);

/// Nothing, and what is wrong in `problem`, where the file is none of `write_ensemble_file`, is damaged, or holds what
/// cannot be. Values are read when they are asked for, so that the file has to stay. Throws EnvironmentError naming the
/// path where it cannot be read.
std::optional<EnsembleResult> read_ensemble_file(const std::string& path, std::string& problem);

}  // namespace jourdain::commands
