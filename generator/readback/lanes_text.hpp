// The passage about numbers that are computed with at once, as it must be written.
#pragma once

namespace jourdain::readback {

const char* lanes_text();

}  // namespace jourdain::readback
