// The passes in their order, with operation counts and time of each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ir/module.hpp"

namespace jourdain::passes {

/// What a pass may change: nothing (the same bits), rounding, or results under an assumption that is printed.
enum class Effect { kExact, kReassociating, kAssuming };

/// One rewriting of a module. Idempotent: run on its own result it gives the same programs, node by node.
struct Pass {
  const char* name;
  Effect effect;
  std::function<ir::Module(const ir::Module&)> run;
  /// Takes much longer than others: it waits until those before it save nothing, and is left out where two ways are
  /// compared.
  bool is_dear = false;
  /// Runs once, on what the others have come to rest at. It saves next to nothing and is left out where two ways are
  /// compared.
  bool is_last = false;
};

/// In the order in which they run. Those that are not last are idempotent together, too.
const std::vector<Pass>& pipeline();

std::vector<std::string> pass_names();
/// Of those that are left out where two ways are compared.
std::vector<std::string> uncompared_pass_names();

struct PassRecord {
  std::string name;
  Effect effect = Effect::kExact;
  std::size_t operations_before = 0,
              operations_after = 0;  ///< arithmetic, all functions and constants together
  double seconds = 0;                ///< taken by the pass
  int round = 1;                     ///< the passes run in rounds until one changes nothing
};

struct Optimised {
  ir::Module module;
  std::vector<PassRecord> records;
};

/// Is shown the module after each pass.
using Watch = std::function<void(const PassRecord&, const ir::Module&)>;

/// Runs the pipeline until it changes nothing, and last passes once. Names in `switched_off` are left out (to count
/// what a pass saves).
Optimised optimise(ir::Module module, const std::vector<std::string>& switched_off = {},
                   const Watch& watch = nullptr);

/// The module after one round of the pipeline without passes that are dear or last: enough to compare operations of two
/// ways to write the same.
ir::Module optimise_once(ir::Module module);

std::size_t arithmetic(const ir::Module& module);

/// Operations of a program after optimise_once.
std::size_t remaining_operations(const ir::Program& program);

/// Operations of a program after all passes.
std::size_t emitted_operations(const ir::Program& program);

}  // namespace jourdain::passes
