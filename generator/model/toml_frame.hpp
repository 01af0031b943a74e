// Frames and the names that expressions may use for what moves.
#pragma once

#include <optional>
#include <string>

#include "model/toml_table.hpp"

namespace jourdain::model {

/// The frame that `table[key]` names. A body or the world becomes a frame on first use. Nothing after a diagnostic.
std::optional<FrameIndex> find_frame(TomlFile& file, const TomlTable& table, std::string_view key,
                                     Mechanism& mechanism);

/// t, inputs, coordinates and their rates, frames and bodies with position, velocity and angular velocity.
Scope general_scope(const Mechanism& mechanism);

/// An expression of general_scope as it stands in the mechanism: bodies that it names become frames.
Expression settled(const Expression& expression, Mechanism& mechanism);

}  // namespace jourdain::model
