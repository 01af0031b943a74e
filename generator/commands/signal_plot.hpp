// Signals over time as a picture.
#pragma once

#include <string>
#include <vector>

#include "commands/signals.hpp"

namespace jourdain::commands {

/// A signal at the times of all of them.
struct SampledSignal {
  Signal signal;
  std::vector<double> values;
};

/// One SVG with a plot for each unit, below each other. Nothing where no value is finite.
std::string signal_plot(const std::string& title, const std::vector<double>& times,
                        const std::vector<SampledSignal>& signals);

}  // namespace jourdain::commands
