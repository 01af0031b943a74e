// Numbers beside the mechanism: what [[state]] and [[memory]] have in common, and memories.
#pragma once

#include <optional>
#include <vector>

#include "model/read/toml_repeat.hpp"

namespace jourdain::model {

/// Name, unit, initial and nominal value of the `what` (state, memory) of a table; nothing after a diagnostic that its
/// name is missing or taken.
std::optional<StateVariable> read_state_variable(TomlFile& file, const TomlTable& table, const char* what,
                                                 const Mechanism& mechanism);

/// All [[memory]] tables. Each is a state without rate that is sampled; one for the samples that it lags, and one that
/// counts down to the next of them, which memories of one period share.
class Memories {
 public:
  /// Adds the states. Expressions may name them from now on; what they are sampled to may name all of them.
  Memories(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

  /// Their updates, of names of `scope`.
  void read_updates(const Scope& scope);

 private:
  struct Memory {
    TomlTable table;
    std::optional<std::size_t> first = {};  ///< state that takes the update; nothing after a diagnostic
    std::size_t lag = 0;                    ///< so many states later is the memory itself
    std::optional<std::size_t> timer = {};  ///< nothing: sampled at every step
  };
  struct Timer {
    std::size_t state = 0;
    Expression period;
  };

  std::optional<Memory> declared(const TomlTable& table);
  std::optional<std::size_t> timer_of(const TomlTable& table, const std::string& name,
                                      const Expression& period);
  bool add(const TomlTable& table, const char* what, StateVariable state);

  TomlFile& file_;
  const TomlTables& section_;
  Mechanism& mechanism_;
  std::vector<Memory> memories_;
  std::vector<Timer> timers_;
};

}  // namespace jourdain::model
