// Histograms of what an ensemble draws and where it ends.
#pragma once

#include <string>
#include <vector>

#include "commands/ensemble_text.hpp"

namespace jourdain::commands {

inline constexpr const char* kEnsemblePlotHelp =
    "SVG file with histograms of what is drawn and of the ends; needs gnuplot";

/// False after a message where --plot names no SVG file; true where it names none at all. Throws EnvironmentError where
/// one is asked for and gnuplot cannot be run.
bool is_plot_possible(const std::string& file);

/// A panel for each column over the trusted states, at least one, with lines at 5, 50 and 95 in 100, as one SVG.
std::string ensemble_plot(const EnsembleResult& result, const std::vector<Statistics>& statistics);

/// The same into a file, where one is asked for; a note where no state is to be trusted. `files`, which are written
/// already, and this one, as they are printed.
std::string with_plot(const std::string& files, const std::string& file, const EnsembleResult& result,
                      const std::vector<Statistics>& statistics);

}  // namespace jourdain::commands
