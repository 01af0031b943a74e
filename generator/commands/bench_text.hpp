// What `jourdain bench` prints.
#pragma once

#include <string>

#include "commands/bench_run.hpp"

namespace jourdain::commands {

/// A measured model.
struct BenchReport {
  const LoadedMechanism& loaded;
  const CompiledModel& compiled;
  const BenchChoices& choices;
  const BenchResult& result;
};

/// For a terminal: a table, and sentences on what its columns mean.
std::string bench_text(const BenchReport& report);

std::string bench_json(const BenchReport& report);

}  // namespace jourdain::commands
