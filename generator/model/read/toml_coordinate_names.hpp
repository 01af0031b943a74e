// Scalar coordinates that a TOML description names, as in the layout of y and z.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/mechanism.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// The coordinate of that name, prescribed ones too; a diagnostic "`who` unknown coordinate 'name'" with what to write
/// otherwise, but where not all joints could be read.
std::optional<ScalarCoordinate> find_scalar(TomlFile& file, SourceRange where, std::string_view who,
                                            const std::string& name, const Mechanism& mechanism);

}  // namespace jourdain::model
