// The passes in their order, with operation counts before and after each.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"

namespace jourdain::passes {

/// What a pass may change: nothing (the same bits), rounding, or results under an assumption that is printed.
enum class Effect { kExact, kReassociating, kAssuming };

struct PassRecord {
  std::string name;
  Effect effect = Effect::kExact;
  std::size_t operations_before = 0,
              operations_after = 0;  ///< arithmetic, all functions and constants together
};

struct Optimised {
  ir::Module module;
  std::vector<PassRecord> records;
};

/// Runs the pipeline. Names in `switched_off` are left out (to count what a pass saves).
Optimised optimise(ir::Module module, const std::vector<std::string>& switched_off = {});

std::size_t arithmetic(const ir::Module& module);

}  // namespace jourdain::passes
