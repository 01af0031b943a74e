#include "commands/ensemble_shard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace jourdain::commands {

std::string Shard::text() const { return fmt::format("{}/{}", part, parts); }

Shard shard_of(std::uint64_t states, std::uint64_t part, std::uint64_t parts) {
  const std::uint64_t each = states / parts, rest = states % parts;
  const std::uint64_t begin = each * (part - 1) + std::min(part - 1, rest);
  return {part, parts, begin, begin + each + (part <= rest ? 1 : 0)};
}

std::optional<Shard> read_shard(const std::string& word, std::uint64_t states) {
  std::uint64_t part = 0, parts = 0;
  const char* const end = word.data() + word.size();
  const auto first = std::from_chars(word.data(), end, part);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return {};
  const auto second = std::from_chars(first.ptr + 1, end, parts);
  if (second.ec != std::errc() || second.ptr != end || part < 1 || part > parts || parts > states) return {};
  return shard_of(states, part, parts);
}

}  // namespace jourdain::commands
