// Frames and the names that expressions may use for what moves.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// The frame that `table[key]` names. A body or the world becomes a frame on first use. Nothing after a diagnostic.
std::optional<FrameIndex> find_frame(TomlFile& file, const TomlTable& table, std::string_view key,
                                     Mechanism& mechanism);

/// The frame of that name, wherever it stands; `who` names it.
std::optional<FrameIndex> find_frame(TomlFile& file, SourceRange where, const std::string& who,
                                     const std::string& name, Mechanism& mechanism);

/// The frames on two bodies, or one on the world, that 'from' and 'to' name. Nothing where one is unknown; two on one
/// body stand after a diagnostic.
std::optional<std::pair<FrameIndex, FrameIndex>> find_ends(TomlFile& file, const TomlTable& table,
                                                           Mechanism& mechanism);

/// t, inputs, states, coordinates and their rates, frames and bodies with position, velocity and angular velocity;
/// signals of the file.
Scope general_scope(const TomlFile& file, const Mechanism& mechanism);

/// general_scope without what `refusal` gives a reason for, and without signals of that: those `of_signals`.
Scope general_scope_but(const TomlFile& file, const Mechanism& mechanism,
                        std::string_view (*refusal)(const Variable&), std::string_view of_signals);

/// The unit of an input; of an actuator's, anything where there is a gear, which may turn one kind of motion into
/// the other.
Needed input_needs(const Mechanism& mechanism, const Actuator& actuator);
Needed input_needs(const Input& input);

/// Position, velocity or angular velocity of a frame, as `kind` says.
Vector3 frame_components(Variable::Kind kind, FrameIndex frame);

/// An expression of general_scope as it stands in the mechanism: bodies that it names become frames.
Expression settled(const Expression& expression, Mechanism& mechanism);

}  // namespace jourdain::model
