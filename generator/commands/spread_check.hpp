// Whether a description is sound where its parameters are drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/run_setup.hpp"
#include "commands/spreads.hpp"

namespace jourdain::commands {

/// False after a message where a parameter is drawn outside its range, or where the description, whose file `path` is,
/// fails its checks at the least or the greatest value of it in so many states, the others at theirs.
bool is_sound_where_drawn(const RunModel& model, const std::string& path, const std::vector<Spread>& spreads,
                          std::uint64_t seed, std::uint64_t states);

}  // namespace jourdain::commands
