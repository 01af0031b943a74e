// The sections of a TOML model file. Problems become diagnostics of `file`; what depends on them is left out.
#pragma once

#include <toml++/toml.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_repeat.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// [parameters]: those with a value of their own in the order of the file, derived ones behind what they name. `file`
/// has declared them then.
void read_parameters(TomlFile& file, const toml::table& section, Mechanism& mechanism);

/// All [[table]] tables: `file` has declared them then.
void read_lookup_tables(TomlFile& file, const TomlTables& section, const ImportChain& chain);
/// All [[function]] tables, which may call tables and functions before them: `file` has declared them then. `options`
/// say whether external ones stay calls.
void read_functions(TomlFile& file, const TomlTables& section, const ReadOptions& options);

// Each of the following appends to what `mechanism` has, which may be imported.

/// All [[body]] tables, without those whose name is missing or taken.
void read_bodies(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[joint]] tables. A joint whose end is unknown names body 0 and leaves the file's structure incomplete.
void read_joints(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[actuator]] tables whose joint is known and can move. One takes the place of an implied one.
void read_actuators(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// Units of a scalar coordinate, of the force on it and of their ratios; the coordinate of a curve may be anything.
struct CoordinateNeeds {
  Needed position, rate, force, stiffness, damping;
};
CoordinateNeeds coordinate_needs(const Joint& joint, std::size_t coordinate);

CoordinateNeeds coordinate_needs(const Mechanism& mechanism, const std::optional<ScalarCoordinate>& at);

/// What belongs to one scalar coordinate, from the table of its joint or from its own. Keys that are left out change
/// nothing.
void read_coordinate(TomlFile& file, const TomlTable& table, const CoordinateNeeds& needs,
                     Coordinate& coordinate);

/// The tables of states beside the mechanism.
struct StateTables {
  const TomlTables &states, &memories, &signals;
};

/// What motions may name from now on: t, states of `mechanism` and of the tables. Others are refused by name.
void declare_motion_scope(TomlFile& file, const StateTables& tables, const TomlTables& inputs,
                          const Mechanism& mechanism);
/// States that motions of this file name become those of `mechanism`, which has all of them.
void settle_motions(const TomlFile& file, Mechanism& mechanism);

/// An error where `function`, which is differentiated, calls one of the user.
void refuse_calls(const TomlTable& table, std::string_view key, const Expression& function);
/// Where value, slope or curvature of an expression may jump.
enum class Kinks { kNone, kWhereTablesEnd, kAnywhere };
/// Those of what `read`, which succeeds, makes of a text of the file.
Kinks kinks_of(TomlFile& file, const std::function<Expression()>& read);

/// An error where what `read` makes of `key`, which is differentiated twice, may have a kink.
void refuse_kinks(TomlFile& file, const TomlTable& table, std::string_view key,
                  const std::function<Expression()>& read);

/// An error where `function`, the value of `key`, may have a hidden one: see model/hidden_kinks.hpp.
void refuse_hidden_kinks(TomlFile& file, const TomlTable& table, std::string_view key,
                         const Expression& function);

/// A function of time, with finite first and second derivatives at t = 0 and the parameters' default values;
/// zero after a diagnostic that it cannot be read or where it is missing. `scope` has t and names that it refuses.
Expression read_time_function(TomlFile& file, const TomlTable& table, std::string_view key,
                              const Needed& needed, const Scope& scope);
/// t alone.
const Scope& time_scope();

/// The scalar coordinate of `joint` that the table's 'coordinate' names; nothing after a diagnostic.
std::optional<std::size_t> find_coordinate(const TomlTable& table, const Joint& joint);
/// The one that the table's 'joint' and 'coordinate' name.
std::optional<ScalarCoordinate> find_coordinate(TomlFile& file, const TomlTable& table,
                                                const Mechanism& mechanism);

/// All [[stop]] tables: forces on coordinates; all [[contact]] tables: loads on frames.
void read_stops(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_contacts(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
/// All [[tyre]] tables: loads on frames, two states and a frame each.
void read_tyres(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[kinematics]] tables; each makes one function per entry of its quantities.
void read_kinematics(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[frame]] tables.
void read_frames(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[input]] tables.
void read_inputs(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// False after a diagnostic that expressions cannot call `what` (a state, a signal) so; the table's key is 'name'.
bool check_signal_name(TomlFile& file, const TomlTable& table, const char* what, const std::string& name,
                       const Mechanism& mechanism);

/// All [[friction]] tables: forces on coordinates and a state each.
void read_frictions(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[state]], [[memory]] and [[signal]] tables: rates and updates may name all of them, and what forces may name; a
/// signal those before it. `file` has declared the signals then.
void read_states(TomlFile& file, const StateTables& tables, Mechanism& mechanism);

/// [[force]], [[spring]], [[bushing]], [[cable]], [[gear_mesh]], [[output]], [[loop]], [[coupler]] and
/// [[constraint]]: what refers to bodies, joints, frames, inputs and states, which `mechanism` has already. Bodies that
/// are named where a frame may stand become frames.
void read_forces(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_springs(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_bushings(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_cables(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_gear_meshes(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_outputs(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_loops(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_couplers(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
void read_constraints(TomlFile& file, const TomlTables& section, Mechanism& mechanism);

/// All [[override]] tables: keys of bodies and joints that are imported.
void read_overrides(TomlFile& file, const TomlTables& section, Mechanism& mechanism);
/// The keys of a body or joint that the table has; the table's key 'body' or 'joint' names it.
void change_body(TomlFile& file, const toml::table& table, SourceRange where, Body& body);
void change_joint(TomlFile& file, const toml::table& table, SourceRange where, Joint& joint);

/// [loops]; `mechanism` has its joints already.
LoopOptions read_loop_options(TomlFile& file, const toml::table& section, SourceRange where,
                              const Mechanism& mechanism);

}  // namespace jourdain::model
