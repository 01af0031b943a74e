// What becomes of couplers whose joints are locked.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// To be called before the joints of these names are locked. Drops couplers of followers among them, which leaves
/// what they followed free, and adds to `names` the joints that follow one of them and start from there, at
/// zero; each with a note. A follower with an offset from a locked joint stays, held by its coupler.
void settle_followers(Mechanism& mechanism, std::vector<std::string>& names,
                      support::Diagnostics& diagnostics);

}  // namespace jourdain::model
