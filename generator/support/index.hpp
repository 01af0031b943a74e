// Distinct index types, so that a body can never be looked up with a joint's number.
#pragma once

#include <compare>
#include <cstddef>

namespace jourdain::support {

/// Position in one particular sequence; `Tag` names the sequence. Converts to std::size_t only explicitly.
template <class Tag>
struct Index {
  std::size_t value = 0;

  constexpr Index() = default;
  constexpr explicit Index(std::size_t v) : value(v) {}
  friend constexpr auto operator<=>(const Index&, const Index&) = default;  // NOLINT(modernize-use-nullptr)
};

}  // namespace jourdain::support
