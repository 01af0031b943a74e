// Which initial values the description gives.
#pragma once

#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// An initial value of the description; line 0 where it gives none.
struct GivenValue {
  support::SourceRange where;
  bool follows = false;  ///< parameters

  bool is_given() const { return where.line > 0; }
};

/// By velocity of the tree.
struct GivenValues {
  std::vector<GivenValue> position, velocity;
};

GivenValues given_values(const model::Mechanism& mechanism, const model::CoordinateLayout& layout);

}  // namespace jourdain::loops
