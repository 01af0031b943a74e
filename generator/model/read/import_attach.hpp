// Where an imported mechanism stands: what it calls the world is a place on a body of the importing one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// The joints and frames that were merged from a file, from the first to before the last.
struct MergedRange {
  std::size_t first_joint = 0, last_joint = 0;
  std::size_t first_frame = 0, last_frame = 0;
  std::size_t first_loop = 0, last_loop = 0;
};

/// The place that what is imported calls the world: on `body` (none: the world), first `outer`, then `inner` in that.
struct Attachment {
  std::optional<BodyIndex> body;
  Placement outer, inner;
  std::string prefix;      ///< of the names of what is made for it
  SourceRange where = {};  ///< of the import
};

/// Turns parents that are the world, and frames on it, to the place. Where the angles of two placements would have to
/// be added up the imported file hangs on a body without mass that is fixed at the place. Free joints start from there;
/// the first one that cannot, as the place is on a body, is returned.
std::optional<JointIndex> attach(Mechanism& mechanism, const MergedRange& range, const Attachment& place);

}  // namespace jourdain::model
