// Frames by name, as descriptions and the command line give them.
#pragma once

#include <optional>
#include <string_view>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// The frame of a body at its origin, or of the world; it is made on first use.
FrameIndex frame_of(Mechanism& mechanism, std::optional<BodyIndex> body);

/// The frame of that name, a body's or "world"'s too. Nothing where there is none.
std::optional<FrameIndex> frame_named(Mechanism& mechanism, std::string_view name);

}  // namespace jourdain::model
