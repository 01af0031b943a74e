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
  bool is_length = true;  ///< m; otherwise a product of unit vectors, or whatever a residual is
};

struct LoopKind {
  LoopType type = LoopType::kBall;
  std::string_view name;  ///< as a model file has it
  std::span<const LoopRow> rows;
  std::span<const std::string_view> keys;  ///< of a file, beside the name and the type

  bool takes(std::string_view key) const;
  /// Whether it joins two frames; otherwise it is a residual.
  bool has_ends() const { return takes("from"); }
  /// Whether it keeps two points a length apart.
  bool is_bar() const { return takes("length"); }
};

const LoopKind& loop_kind(LoopType type);
inline const LoopKind& loop_kind(const Loop& loop) { return loop_kind(loop.type); }

/// In the order of LoopType.
const std::vector<std::string>& loop_type_names();

}  // namespace jourdain::model
