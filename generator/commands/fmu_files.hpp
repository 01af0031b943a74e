// What lies in an FMU beside its description: C sources, a library, and the archive of all.
#pragma once

#include <string>
#include <vector>

#include "commands/fmu_scene.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

/// The C files of an FMU: those of the model, and what makes an FMU of them, whose instances ask for `token`.
std::vector<support::FileText> fmu_sources(const FmuScene& scene, FmiVersion version,
                                           const std::string& token,
                                           const std::vector<support::FileText>& model_files);

/// Names of those that are compiled.
std::vector<std::string> compiled_sources(const std::vector<support::FileText>& files);

/// The folder of binaries/ for what a compiler of C makes: "linux64", "x86_64-linux". Throws EnvironmentError where the
/// standard has no name for it.
std::string platform_of(const std::vector<std::string>& compiler, FmiVersion version);

/// A zip archive of these files in this order; of the same files always the same bytes. Throws EnvironmentError where
/// libzip fails.
std::string zip_archive(const std::vector<support::FileText>& files);

}  // namespace jourdain::commands
