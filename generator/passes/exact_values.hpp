// The values of a program in 77 digits, at leaves that look random.
#pragma once

#include <cstdint>
#include <vector>

#include "ir/program.hpp"
#include "support/scaled_real.hpp"

namespace jourdain::passes {

/// Values at one of some samples, each computed when it is first asked for: few are.
class ExactValues {
 public:
  ExactValues(const ir::Program& program, std::uint64_t sample);

  const support::ScaledReal& of(ir::ValueId id);

 private:
  support::ScaledReal computed(const ir::Node& node) const;

  const ir::Program& program_;
  std::uint64_t sample_;
  std::vector<support::ScaledReal> values_;
  std::vector<bool> is_known_;
};

}  // namespace jourdain::passes
