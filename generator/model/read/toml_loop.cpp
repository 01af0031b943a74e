// [[loop]] and [loops]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/loop_kinds.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_coordinate_names.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

const std::vector<std::string> kTreatments{"explicit", "partitioned", "multipliers"};
const std::vector<std::string> kKeysOfAll{"name", "type"};
const std::vector<std::string> kOwnKeys{"from", "to", "axis", "to_axis", "length", "residual"};
constexpr int kMostIterations = 20;

template <class Keys>
std::vector<std::string> joined(std::vector<std::string> first, const Keys& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Those of a loop whose type can be read, or of a ball.
std::vector<std::string> keys_of_type(const toml::table& table) {
  const auto type =
      std::find(loop_type_names().begin(), loop_type_names().end(), table["type"].value_or(std::string()));
  const auto index = type == loop_type_names().end() ? 0 : type - loop_type_names().begin();
  return joined(kKeysOfAll, loop_kind(static_cast<LoopType>(index)).keys);
}

/// Why a residual cannot be of it; empty: it can.
std::string_view refusal_in_residual(const Variable& variable) {
  if (variable.kind == Variable::Kind::kInput)
    return "it is an input; a residual is of t, coordinates, positions and axes of frames";
  if (variable.kind == Variable::Kind::kState)
    return "it is a state; a residual is of t, coordinates, positions and axes of frames";
  if (variable.is_rate())
    return "it is a velocity; a residual is of t, coordinates, positions and axes of frames; [[constraint]] "
           "takes "
           "rates";
  return "";
}

/// The general scope, in which all that moves is refused.
Scope length_scope(const TomlFile& file, const Mechanism& mechanism) {
  Scope scope = general_scope(file, mechanism);
  for (ScopeEntry& entry : scope)
    if (entry.meaning || entry.variable.kind != Variable::Kind::kTime)
      entry.refusal = "the length of a rod is of t and parameters";
  return scope;
}

class LoopReader {
 public:
  LoopReader(TomlFile& file, const toml::table& table, std::size_t number)
      : file_(file),
        name_(name_or_number(file, table, "loop", number)),
        table_(file, table, fmt::format("loop '{}'", shown(name_)), file.range(table.source()),
               joined(kKeysOfAll, kOwnKeys), keys_of_type(table)) {}

  /// Nothing after a diagnostic.
  std::optional<Loop> read(Mechanism& mechanism) {
    const std::size_t mark = file_.error_count();
    Loop loop;
    loop.name = name_;
    loop.where = table_.where("name");
    if (!table_.has("name") || table_.text("name")) check_identifier(file_, loop.where, "loop", loop.name);
    is_new_name(file_, loop.where, "loops", loop.name, mechanism.loops);
    if (!read_type(loop)) return {};
    const bool ends = read_ends(loop, mechanism);
    read_axes(loop);
    if (loop_kind(loop).takes("length")) read_length(loop, mechanism);
    if (loop_kind(loop).takes("residual")) read_residual(loop, mechanism);
    if (!ends || file_.error_count() != mark) return {};
    return loop;
  }

 private:
  bool read_type(Loop& loop) {
    if (!table_.has("type"))
      table_.missing("type", fmt::format("one of {}", fmt::join(loop_type_names(), ", ")));
    const auto type = table_.choice("type", loop_type_names());
    if (!type || !table_.has("type")) return false;
    loop.type = static_cast<LoopType>(*type);
    const LoopKind& kind = loop_kind(loop);
    for (const std::string& key : kOwnKeys)
      if (table_.has(key) && !kind.takes(key))
        table_.error(key, fmt::format("{} is a {} and has no '{}'", table_.what(), kind.name, key));
    return true;
  }

  bool read_ends(Loop& loop, Mechanism& mechanism) {
    if (!loop_kind(loop).has_ends()) return true;
    const auto from = find_frame(file_, table_, "from", mechanism),
               to = find_frame(file_, table_, "to", mechanism);
    if (!from || !to) return false;
    loop.from = *from;
    loop.to = *to;
    loop.to_where = table_.where("to");
    return true;
  }

  void read_axes(Loop& loop) {
    loop.axis = axis("axis", loop.axis);
    loop.to_axis = axis("to_axis", loop.axis);
  }

  std::array<double, 3> axis(std::string_view key, const std::array<double, 3>& otherwise) {
    const std::array<double, 3> result = table_.direction(key, otherwise);
    const double length = std::hypot(result[0], result[1], result[2]);
    if (length == 0)
      table_.error(key, fmt::format("{} is zero", table_.quoted(key)),
                   "an axis is a direction, such as [0, 0, 1]");
    if (!std::isfinite(length))
      table_.error(key, fmt::format("the length of {} is infinite", table_.quoted(key)));
    return length == 0 ? otherwise : result;
  }

  void read_length(Loop& loop, const Mechanism& mechanism) {
    if (!table_.has("length"))
      return table_.missing("length", "m; an expression of t and parameters, or a number");
    const std::size_t mark = file_.error_count();
    loop.length =
        read_time_function(file_, table_, "length", needed::kLength, length_scope(file_, mechanism));
    refuse_calls(table_, "length", loop.length);
    if (file_.error_count() != mark) return;
    const auto start = loop.length.evaluate<double>(
        file_.values(), [](double v) { return v; }, [](const Variable&) { return 0.0; });
    if (!(start > 0))
      table_.error("length",
                   fmt::format("{} must be positive, it is {} at t = 0", table_.quoted("length"), start),
                   "a ball joint holds two points together");
  }

  void read_residual(Loop& loop, Mechanism& mechanism) {
    if (!table_.has("residual"))
      return table_.missing("residual", "an expression of t, coordinates, positions and axes of frames");
    const std::size_t mark = file_.error_count();
    const auto residual = [&] {
      return table_.function(
          "residual", needed::kAnything,
          general_scope_but(file_, mechanism, refusal_in_residual,
                            "it is of more than t, coordinates, positions and axes of frames"));
    };
    const Expression read = residual();
    if (file_.error_count() != mark) return;
    refuse_kinks(file_, table_, "residual", residual);
    loop.residual = settled(read, mechanism);
    refuse_calls(table_, "residual", loop.residual);
    if (loop.residual.calls(support::Function::kAtan2))
      table_.error("residual",
                   fmt::format("{} has an arctangent, which jumps by a turn", table_.quoted("residual")),
                   "sines and cosines of angles, or products, can say the same");
  }

  TomlFile& file_;
  std::string name_;
  TomlTable table_;
};

/// One name in 'independent'; nothing after a diagnostic.
std::optional<ScalarCoordinate> find_independent(TomlFile& file, const toml::node& node,
                                                 const Mechanism& mechanism) {
  const SourceRange where = file.range(node.source());
  const toml::value<std::string>* text = node.as_string();
  if (!text) {
    file.error(where, fmt::format("'independent' of [loops] holds names of coordinates, not {}",
                                  type_in_words(node)));
    return {};
  }
  const auto found = find_scalar(file, where, "[loops] names", text->get(), mechanism);
  if (!found || !mechanism.joints[found->joint.value].coordinates[found->coordinate].motion) return found;
  file.error(where,
             fmt::format("coordinate '{}' is prescribed and cannot be independent", shown(text->get())));
  return {};
}

class OptionsReader {
 public:
  OptionsReader(TomlFile& file, const toml::table& section, SourceRange where)
      : file_(file), table_(file, section, "[loops]", where, keys_of("loops")) {}

  LoopOptions read(const Mechanism& mechanism) {
    if (table_.has("treatment"))
      if (const auto treatment = table_.choice("treatment", kTreatments))
        options_.treatment = static_cast<LoopTreatment>(*treatment);
    refuse("independent", LoopTreatment::kMultipliers, "they keep all coordinates");
    refuse("iterations", LoopTreatment::kExplicit, "closed forms need none");
    refuse("stabilisation", LoopTreatment::kExplicit, "it belongs to multipliers");
    refuse("stabilisation", LoopTreatment::kPartitioned, "it belongs to multipliers");
    if (table_.has("independent")) read_independent(mechanism);
    if (table_.has("iterations")) read_iterations();
    if (table_.has("stabilisation")) read_stabilisation();
    return options_;
  }

 private:
  void refuse(std::string_view key, LoopTreatment treatment, const char* hint) {
    if (options_.treatment != treatment || !table_.has(key)) return;
    const std::string& word = kTreatments[static_cast<std::size_t>(treatment)];
    table_.error(key, fmt::format("treatment \"{}\" has no '{}'", word, key), hint);
  }

  void read_independent(const Mechanism& mechanism) {
    const toml::array* names = table_.find("independent")->as_array();
    if (!names)
      return table_.error("independent",
                          fmt::format("'independent' of [loops] must be a list of names, not {}",
                                      type_in_words(*table_.find("independent"))));
    for (const toml::node& node : *names) {
      const auto found = find_independent(file_, node, mechanism);
      if (!found) continue;
      const bool taken =
          std::any_of(options_.independent.begin(), options_.independent.end(), [&](const auto& name) {
            return name.joint == found->joint && name.coordinate == found->coordinate;
          });
      if (taken)
        file_.error(file_.range(node.source()),
                    fmt::format("[loops] names coordinate '{}' twice", shown(node.as_string()->get())));
      else
        options_.independent.push_back({found->joint, found->coordinate});
    }
  }

  void read_iterations() {
    const toml::node& node = *table_.find("iterations");
    const toml::value<std::int64_t>* integer = node.as_integer();
    const toml::value<double>* number = node.as_floating_point();
    if (integer && integer->get() >= 1 && integer->get() <= kMostIterations) {
      options_.iterations = static_cast<int>(integer->get());
      return;
    }
    const std::string found = integer  ? fmt::format("{}", integer->get())
                              : number ? fmt::format("{}", number->get())
                                       : std::string(type_in_words(node));
    table_.error("iterations",
                 fmt::format("'iterations' of [loops] must be an integer from 1 to {}, not {}",
                             kMostIterations, found),
                 "their number is fixed, so that the cost of a step is known");
  }

  void read_stabilisation() {
    const std::size_t mark = file_.error_count();
    const double rate =
        file_.constant(*table_.find("stabilisation"), {table_.quoted("stabilisation"), needed::kPerTime});
    if (file_.error_count() != mark) return;
    if (rate < 0)
      table_.error("stabilisation", fmt::format("{} is negative", table_.quoted("stabilisation")));
    options_.stabilisation = rate;
  }

  TomlFile& file_;
  TomlTable table_;
  LoopOptions options_;
};

}  // namespace

void read_loops(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section)
    if (auto loop = LoopReader(file, *node.as_table(), ++number).read(mechanism))
      mechanism.loops.push_back(std::move(*loop));
}

LoopOptions read_loop_options(TomlFile& file, const toml::table& section, SourceRange where,
                              const Mechanism& mechanism) {
  LoopOptions options = OptionsReader(file, section, where).read(mechanism);
  options.where = where;
  return options;
}

}  // namespace jourdain::model
