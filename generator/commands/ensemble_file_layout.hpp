// Names and head of an ensemble's file, for its writer and its reader.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::commands {

inline constexpr std::size_t kHead = 512;  ///< bytes, which HDF5 leaves alone
inline constexpr std::string_view kHeadLine = "Jourdain ensemble, HDF5 from byte 512 on, whose SHA-256 is\n";
inline constexpr const char* kEnsembleFormat = "Jourdain ensemble";
inline constexpr std::uint64_t kEnsembleFormatVersion = 1;
inline constexpr const char *kRows = "rows", *kHalfStep = "half_step", *kState = "state",
                            *kTrusted = "trusted";

/// The head of a file whose other bytes have that hash.
inline std::string head_of(const std::string& sha256) {
  std::string head = std::string(kHeadLine) + sha256 + "\n";
  head.resize(kHead, '\n');
  return head;
}

/// begin, begin + 1, and so on.
inline std::vector<std::uint64_t> state_numbers(std::uint64_t begin, std::uint64_t count) {
  std::vector<std::uint64_t> list;
  for (std::uint64_t k = 0; k < count; ++k) list.push_back(begin + k);
  return list;
}

}  // namespace jourdain::commands
