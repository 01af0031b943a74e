// Parts of an ensemble's states: "3/16".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace jourdain::commands {

/// The states begin to end - 1 of an ensemble, and what part of it that is.
struct Shard {
  std::uint64_t part = 1, parts = 1;
  std::uint64_t begin = 0, end = 0;

  std::uint64_t size() const { return end - begin; }
  std::string text() const;  ///< "3/16"
};

/// Part `part` from 1 to `parts` of so many states: parts differ by one state at most, the first are the larger ones.
Shard shard_of(std::uint64_t states, std::uint64_t part, std::uint64_t parts);

/// Reads "3/16"; nothing where it is no part, or where parts would be without a state.
std::optional<Shard> read_shard(const std::string& word, std::uint64_t states);

}  // namespace jourdain::commands
