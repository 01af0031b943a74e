// Things that expressions and programs name by a number that follows from what they are.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

#include "support/check.hpp"
#include "support/constant_array.hpp"

namespace jourdain::support {

/// FNV-1a, over bytes.
class ContentHash {
 public:
  void take(std::string_view text) {
    for (const char c : text) take_byte(static_cast<unsigned char>(c));
  }
  void take(double value) {
    for (int byte = 0; byte < 8; ++byte)
      take_byte((std::bit_cast<std::uint64_t>(value) >> (8 * byte)) & 0xff);
  }
  std::uint64_t value() const { return value_; }

 private:
  void take_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 1099511628211u; }

  std::uint64_t value_ = 14695981039346656037u;
};

/// Values by number; they stay where they are, and any thread may ask.
template <class Value>
class Numbered {
 public:
  /// That of `hash`, or where another value has it the next one. `are_same` compares two values.
  template <class Same>
  std::uint32_t number_of(const ContentHash& hash, Value value, const Same& are_same) {
    const std::uint64_t bits = hash.value();
    const std::lock_guard lock(mutex_);
    for (auto number = static_cast<std::uint32_t>((bits ^ (bits >> 24) ^ (bits >> 48)) & kLargestArrayNumber);
         ; number = (number + 1) & kLargestArrayNumber) {
      const auto known = by_number_.find(number);
      if (known != by_number_.end() && !are_same(known->second, value)) continue;
      if (known == by_number_.end()) by_number_.emplace(number, std::move(value));
      return number;
    }
  }

  const Value& at(std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    const auto place = by_number_.find(number);
    JD_CHECK(place != by_number_.end(), "nothing has the number {}", number);
    return place->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::uint32_t, Value> by_number_;
};

}  // namespace jourdain::support
