// The sections of a TOML model file. Problems become diagnostics of `file`; what depends on them is left out.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "model/mechanism.hpp"
#include "model/toml_table.hpp"

namespace jourdain::model {

/// [parameters], in the order of the file.
std::vector<Parameter> read_parameters(TomlFile& file, const toml::table& section);

/// All [[body]] tables, without those whose name is missing or taken.
std::vector<Body> read_bodies(TomlFile& file, const toml::array& section);

/// All [[joint]] tables; `bodies` are those they may name. A joint whose end is unknown names body 0 and
/// leaves the file's structure incomplete.
std::vector<Joint> read_joints(TomlFile& file, const toml::array& section, const std::vector<Body>& bodies);

/// All [[actuator]] tables whose joint is known and can move.
std::vector<Actuator> read_actuators(TomlFile& file, const toml::array& section,
                                     const std::vector<Joint>& joints);

}  // namespace jourdain::model
