// Which signals a run writes and draws.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/signals.hpp"

namespace jourdain::commands {

/// A sentence on a name that no output has; empty where there is none.
std::string unknown_output(const model::Mechanism& mechanism, const std::vector<std::string>& chosen);

/// What --plot asks for.
struct PlotRequest {
  std::string file;                   ///< empty: no plot
  std::vector<std::string> patterns;  ///< of signals; none: the positions
};

/// From the values of --plot: the one that ends with ".svg" is the file, NAME.svg where there is none. Nothing
/// after a message.
std::optional<PlotRequest> plot_request(const std::vector<std::string>& values, const std::string& name);

/// Signals that a run writes and draws, by index.
struct Selection {
  std::vector<std::size_t> written, drawn;

  bool has_outputs(const Signals& signals) const;
};

/// What is written holds the numbers of these outputs, of all where there are none. Nothing after a message.
std::optional<Selection> select(const Signals& signals, const std::vector<std::string>& outputs,
                                const PlotRequest& plot);

}  // namespace jourdain::commands
