// The types of loop joints: one row for each, with the rows that each keeps at zero and what generic code asks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// One constraint row, named after what is zero in it (see LoopType).
struct LoopRow {
  std::string_view name;
  bool is_length = true;     ///< m; otherwise a product of unit vectors, or whatever a residual is
  bool has_position = true;  ///< otherwise it binds velocities alone, and its g is 0
};

struct LoopKind {
  LoopType type = LoopType::kBall;
  std::string_view name;  ///< as a model file has it
  std::span<const LoopRow> rows;
  std::span<const std::string_view> keys;  ///< of a file, beside the name and the type

  bool takes(std::string_view key) const;
  /// Whether it joins two frames; otherwise it is an expression.
  bool has_ends() const { return takes("from") || takes("frame"); }
  /// Whether it stands in [[constraint]]; otherwise it closes a chain.
  bool is_constraint() const { return takes("frame") || takes("velocity"); }
  /// Whether it keeps two points a length apart.
  bool is_bar() const { return takes("length"); }
};

const LoopKind& loop_kind(LoopType type);
inline const LoopKind& loop_kind(const Loop& loop) { return loop_kind(loop.type); }

/// What messages call it: "loop 'pin'".
std::string in_words(const Loop& loop);

/// Whether some row binds velocities alone.
bool binds_velocities(const Mechanism& mechanism);

/// A bar whose length is not positive at that time (s), which is then closed as if it were as long the other way; null
/// where there is none.
const Loop* bar_without_length(const Mechanism& mechanism, const std::vector<double>& parameters, double t);

/// Whose constraint row that is.
const Loop& loop_of_row(const Mechanism& mechanism, std::size_t row);

/// Of [[loop]], the first ones, in the order of LoopType; of [[constraint]], the others.
const std::vector<std::string>& loop_type_names();
const std::vector<std::string>& constraint_type_names();

}  // namespace jourdain::model
