// What changes over time in a run: the columns of its table, and what its plots may show.
#pragma once

#include <string>
#include <vector>

#include "commands/load.hpp"
#include "programs/entries.hpp"
#include "studies/flow.hpp"

namespace jourdain::commands {

struct Signal {
  std::string name;         ///< of the column
  std::string unit;         ///< empty: not known
  std::string kind;         ///< "position", "velocity", "state", "energy", "input", "output"
  std::string output = {};  ///< whose number it is; empty: none's
};

/// Positions, velocities, states, energies, inputs and outputs of a model, in this order. Names differ: what is called
/// like an earlier one, the time or an energy gets its kind appended, and a number where that is a name, too.
class Signals {
 public:
  Signals(const LoadedMechanism& loaded, const std::vector<programs::OutputFacts>& outputs);

  const std::vector<Signal>& list() const { return list_; }
  /// Which names are not what one would expect, a sentence each.
  const std::vector<std::string>& renamed() const { return renamed_; }

  /// Those that are no outputs, and the numbers of the outputs in `chosen`; of all outputs where it is empty.
  std::vector<std::size_t> columns(const std::vector<std::string>& chosen) const;
  /// Those with a name that `pattern` matches, where '*' stands for any characters; where there is none, all
  /// numbers of the output or of the member of one that has that name.
  std::vector<std::size_t> matching(const std::string& pattern) const;
  std::vector<std::size_t> positions() const;
  /// Of the entries of y and z; "1" of quaternions, empty of states.
  std::vector<std::string> state_units() const;

  /// Values at a point, in order; without the outputs where these are not wanted.
  std::vector<double> values(const studies::Flow<double>& flow, const studies::Point<double>& point,
                             bool outputs) const;

 private:
  void tell_apart();

  std::vector<Signal> list_;
  std::vector<std::string> renamed_;
  std::size_t positions_ = 0, state_ = 0;  ///< entries of y, and of y and z
};

}  // namespace jourdain::commands
