// Values that are computed at once, as lanes of one variable.
#pragma once

#include <optional>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::emit {

/// Looks up Program::lanes. Values that stand there together are a bundle; the first of them stands for all.
class Bundles {
 public:
  explicit Bundles(const ir::Program& program);

  struct Place {
    std::size_t bundle = 0, lane = 0;
  };

  /// Nothing for a value that is computed alone.
  std::optional<Place> place_of(std::size_t value) const { return places_[value]; }
  /// The first of the bundle of `value`; itself where it is alone.
  std::size_t first(std::size_t value) const { return together(value)[0].value; }
  /// How many are computed at once with `value`, itself among them.
  std::size_t width(std::size_t value) const {
    return places_[value] ? program_.lanes[places_[value]->bundle].size() : 1;
  }
  /// The bundle of `value`, or itself.
  std::vector<ir::ValueId> together(std::size_t value) const;
  /// Operand a (k = 0) or b of all in the bundle.
  std::vector<ir::ValueId> operands(std::size_t value, int k) const;
  /// Are these a bundle, lane by lane?
  bool are_bundle(const std::vector<ir::ValueId>& values) const;
  /// Is the bundle of `value` read as a whole by one other bundle, and by nothing else?
  bool is_read_once(std::size_t value) const { return places_[value] && read_once_[places_[value]->bundle]; }

 private:
  const ir::Program& program_;
  std::vector<std::optional<Place>> places_;
  std::vector<bool> read_once_;
};

}  // namespace jourdain::emit
