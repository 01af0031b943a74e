// The types of loop joints by name, with the rows that each keeps at zero.
#pragma once

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
  std::string_view name;  ///< as a model file has it
  std::vector<LoopRow> rows;
};

const LoopKind& loop_kind(LoopType type);

/// In the order of LoopType.
const std::vector<std::string>& loop_type_names();

}  // namespace jourdain::model
