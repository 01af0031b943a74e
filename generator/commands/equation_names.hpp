// Names in printed equations: different ones read differently.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::commands {

/// What stands for names, in plain text or in LaTeX, where `l1` and `l_1` are both $l_1$.
class Spelling {
 public:
  explicit Spelling(bool latex) : latex_(latex) {}

  bool is_latex() const { return latex_; }
  std::string operator()(const std::string& name) const;
  /// No name is printed as this text from now on.
  void reserve(const std::string& text) { taken_.insert(text); }
  /// Whether nothing is printed as `name` yet; from now on it is.
  bool take(const std::string& name) { return taken_.insert((*this)(name)).second; }
  /// `wanted`, or that with `suffix` and perhaps a number, which nothing is printed as yet.
  std::string unused(const std::string& wanted, const std::string& suffix);

 private:
  bool latex_;
  std::set<std::string> taken_;  ///< as they are printed
};

/// Parameters that would be printed as coordinates, velocities, inputs, time, entries or each other have other names.
/// All of these are taken in `spelling`, so that values on the way have others, too.
struct PrintedNames {
  model::Mechanism mechanism;  ///< with these names of parameters
  Spelling spelling;           ///< in which they are taken
  struct Change {
    std::string printed, parameter;
  };
  std::vector<Change> changes;
};
PrintedNames printed_names(const model::Mechanism& mechanism, bool latex);

}  // namespace jourdain::commands
