// The sections of a TOML model file. Problems become diagnostics of `file`; what depends on them is left out.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/toml_table.hpp"

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

/// Units of a scalar coordinate, of the force on it and of their ratios; the coordinate of a curve may be anything.
struct CoordinateNeeds {
  Needed position, rate, force, stiffness, damping;
};
CoordinateNeeds coordinate_needs(const Joint& joint, std::size_t coordinate);

/// What belongs to one scalar coordinate, from the table of its joint or from its own; and the keys that such
/// a table has.
void read_coordinate(TomlFile& file, const TomlTable& table, const CoordinateNeeds& needs,
                     Coordinate& coordinate);

/// A function of time, with finite first and second derivatives at t = 0 and the parameters' default values;
/// zero after a diagnostic that it cannot be read or where it is missing. `scope` has t and names that it refuses.
Expression read_time_function(TomlFile& file, const TomlTable& table, std::string_view key,
                              const Needed& needed, const Scope& scope);
/// t alone.
const Scope& time_scope();

/// The scalar coordinate of `joint` that the table's 'coordinate' names; nothing after a diagnostic.
std::optional<std::size_t> find_coordinate(const TomlTable& table, const Joint& joint);

/// All [[frame]] tables.
std::vector<Frame> read_frames(TomlFile& file, const toml::array& section, const std::vector<Body>& bodies);

/// All [[input]] tables.
std::vector<Input> read_inputs(TomlFile& file, const toml::array& section, const Mechanism& mechanism);

/// [[force]], [[spring]], [[bushing]], [[output]], [[loop]] and [[coupler]]: what refers to bodies, joints, frames and
/// inputs, which `mechanism` has already. Bodies that are named where a frame may stand become frames.
void read_forces(TomlFile& file, const toml::array& section, Mechanism& mechanism);
void read_springs(TomlFile& file, const toml::array& section, Mechanism& mechanism);
void read_bushings(TomlFile& file, const toml::array& section, Mechanism& mechanism);
void read_outputs(TomlFile& file, const toml::array& section, Mechanism& mechanism);
void read_loops(TomlFile& file, const toml::array& section, Mechanism& mechanism);
void read_couplers(TomlFile& file, const toml::array& section, Mechanism& mechanism);

/// [loops]; `mechanism` has its joints already.
LoopOptions read_loop_options(TomlFile& file, const toml::table& section, SourceRange where,
                              const Mechanism& mechanism);

}  // namespace jourdain::model
