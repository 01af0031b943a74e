// [[constraint]]: what binds velocities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/loop_kinds.hpp"
#include "model/read/ground.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

const std::vector<std::string> kOwnKeys{"velocity", "frame",  "axis",   "radius",    "radii",
                                        "plane",    "normal", "height", "approaches"};

/// The type that the word stands for; as the first where it is none.
LoopType constraint_type(const std::string& word) {
  const std::vector<std::string>& names = constraint_type_names();
  const auto found = std::find(names.begin(), names.end(), word);
  const auto index = static_cast<std::size_t>(found == names.end() ? 0 : found - names.begin());
  return static_cast<LoopType>(loop_type_names().size() + index);
}

/// Why the velocity of a constraint cannot be of it; empty: it can.
std::string_view refusal_in_velocity(const Variable& variable) {
  if (variable.kind == Variable::Kind::kInput)
    return "it is an input; a constraint is of t, coordinates, frames and their rates";
  if (variable.kind == Variable::Kind::kState)
    return "it is a state; a constraint is of t, coordinates, frames and their rates";
  return "";
}

class ConstraintReader {
 public:
  ConstraintReader(TomlFile& file, const toml::table& table, std::size_t number)
      : file_(file),
        name_(name_or_number(file, table, "constraint", number)),
        kind_(loop_kind(constraint_type(file.text_or(table, "type", "velocity")))),
        table_(file, table, fmt::format("constraint '{}'", shown(name_)), file.range(table.source()),
               keys_of("constraint"), keys_of_kind()) {}

  /// Nothing after a diagnostic.
  std::optional<Loop> read(Mechanism& mechanism) {
    const std::size_t mark = file_.error_count();
    Loop loop;
    loop.name = name_;
    loop.where = table_.where("name");
    loop.type = kind_.type;
    if (!table_.has("name") || table_.text("name"))
      check_identifier(file_, loop.where, "constraint", loop.name);
    is_new_name(file_, loop.where, "loops or constraints", loop.name, mechanism.loops);
    if (!table_.choice("type", constraint_type_names())) return {};
    for (const std::string& key : kOwnKeys)
      if (table_.has(key) && !kind_.takes(key))
        table_.error(key, fmt::format("{} is a {} and has no '{}'", table_.what(), kind_.name, key));
    if (kind_.takes("velocity")) read_velocity(loop, mechanism);
    if (kind_.takes("frame")) read_frames(loop, mechanism);
    if (kind_.takes("axis")) loop.to_axis = direction("axis", {0, 1, 0});
    if (kind_.takes("normal")) loop.axis = direction("normal", {0, 0, 1});
    if (kind_.takes("radii")) read_radii(loop);
    if (kind_.takes("radius")) loop.length = table_.positive("radius", needed::kLength);
    if (kind_.takes("height")) read_height(loop);
    if (file_.error_count() != mark) return {};
    return loop;
  }

 private:
  std::vector<std::string> keys_of_kind() const {
    std::vector<std::string> keys{"name", "type"};
    keys.insert(keys.end(), kind_.keys.begin(), kind_.keys.end());
    return keys;
  }

  void read_velocity(Loop& loop, Mechanism& mechanism) {
    if (!table_.has("velocity"))
      return table_.missing("velocity", "an expression of t, coordinates, frames and their rates");
    const std::size_t mark = file_.error_count();
    const auto velocity = [&] {
      return table_.function(
          "velocity", needed::kAnything,
          general_scope_but(file_, mechanism, refusal_in_velocity, "it is of inputs or states"));
    };
    const Expression read = velocity();
    if (file_.error_count() != mark) return;
    refuse_kinks(file_, table_, "velocity", velocity);
    loop.residual = settled(read, mechanism);
    refuse_calls(table_, "velocity", loop.residual);
  }

  /// Of ground that stands still in `plane`.
  void read_height(Loop& loop) {
    Scope scope = scope_of_places();
    for (ScopeEntry entry : time_scope()) {
      entry.refusal =
          "what rolls, rolls on ground that stands still in 'plane', which may be on a body that moves";
      scope.push_back(entry);
    }
    const std::size_t mark = file_.error_count();
    const auto height = [&] { return table_.function("height", needed::kLength, scope); };
    loop.height = height();
    if (file_.error_count() != mark) return;
    if (kinks_of(file_, height) == Kinks::kWhereTablesEnd) {
      file_.diagnostics().warning(
          table_.where("height"),
          fmt::format("{} has a kink where a table ends, where velocities jump", table_.quoted("height")),
          "stay inside; a curve may go on beyond its ends: beyond = \"extend\", or \"repeat\"");
      refuse_hidden_kinks(file_, table_, "height", loop.height);
    } else {
      refuse_kinks(file_, table_, "height", height);
    }
    refuse_calls(table_, "height", loop.height);
    loop.approaches = read_approaches(table_, 1).value_or(loop.approaches);
  }

  void read_radii(Loop& loop) {
    if (!table_.has("radii")) return table_.missing("radii", "three lengths, along the axes of 'frame'");
    loop.radii = table_.vector("radii", needed::kLength);
    for (const Expression& radius : loop.radii)
      if (!(file_.value(radius) > 0)) {
        table_.error("radii", fmt::format("{} must be positive", table_.quoted("radii")));
        return;
      }
  }

  void read_frames(Loop& loop, Mechanism& mechanism) {
    const auto frame = find_frame(file_, table_, "frame", mechanism);
    const auto plane = table_.has("plane")
                           ? find_frame(file_, table_, "plane", mechanism)
                           : find_frame(file_, table_.where("name"), table_.what(), "world", mechanism);
    if (!frame || !plane) return;
    loop.to = *frame;
    loop.from = *plane;
    loop.to_where = table_.where("frame");
  }

  std::array<double, 3> direction(std::string_view key, const std::array<double, 3>& otherwise) const {
    const std::array<double, 3> result = table_.direction(key, otherwise);
    const double length = std::hypot(result[0], result[1], result[2]);
    if (length > 0 && std::isfinite(length)) return result;
    table_.error(key, fmt::format("{} is {}", table_.quoted(key), length == 0 ? "zero" : "infinite"),
                 "it is a direction, such as [0, 0, 1]");
    return otherwise;
  }

  TomlFile& file_;
  std::string name_;
  const LoopKind& kind_;
  TomlTable table_;
};

}  // namespace

void read_constraints(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section)
    if (auto constraint = ConstraintReader(file, *node.as_table(), ++number).read(mechanism))
      mechanism.loops.push_back(std::move(*constraint));
}

}  // namespace jourdain::model
