// The TOML model file. Wherever a number stands, a string with an expression over parameters may stand
// ("m/3*l^2", "30*deg"; see parse_expression), but for axes and parameter values, which are constant. So may a
// number with its unit ("30 deg", "2.5 N*m/rad", "100mm"), or both apart: { value = 100, unit = "mm" },
// { value = [1, 2, 3], unit = "mm" }. A bare number is in the unit below. Each must have the dimension of its place,
// expressions where a parameter with a unit stands in them (see dimensions.hpp).
// Keys: keys.cpp.
#include <fmt/format.h>

#include "model/read/import_file.hpp"
#include "model/read/keys.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_import.hpp"
#include "model/read/toml_repeat.hpp"
#include "model/read/toml_sections.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;

/// Tables that a file may have any number of, and that [[repeat]] may hold.
const std::vector<std::string> kLists{
    "import",    "override",   "body",    "joint",  "frame",      "actuator", "input",
    "force",     "spring",     "bushing", "output", "kinematics", "loop",     "coupler",
    "stop",      "contact",    "table",   "state",  "friction",   "signal",   "cable",
    "gear_mesh", "constraint", "tyre",    "memory", "function"};

class TomlReader {
 public:
  TomlReader(Diagnostics& diagnostics, const toml::table& root, const ReadOptions& options)
      : file_(diagnostics),
        top_(file_, root, "the file", {}, known_tables()),
        repeats_(file_, root, kLists),
        options_(options),
        chain_(options.importing ? *options.importing
                                 : ImportChain{canonical_path(diagnostics.path()), nullptr, &budget_}) {}

  Mechanism read() {
    Mechanism mechanism;
    if (const toml::table* section = top_.table("parameters")) read_parameters(file_, *section, mechanism);
    take_given_values(mechanism);
    read_model(mechanism);
    const TomlTables importing = repeats_.tables("import", true);
    const std::vector<Import> imports = read_imports(file_, importing, options_, chain_, mechanism);
    take_given_values(mechanism);
    // Names that an import would have declared are unknown then: not each is one more mistake.
    if (imports.size() < importing.size()) return mechanism;
    check_loop_options(imports);
    read_lookup_tables(file_, repeats_.tables("table"), chain_);
    read_functions(file_, repeats_.tables("function"), options_);
    const TomlTables states = repeats_.tables("state"), memories = repeats_.tables("memory"),
                     signals = repeats_.tables("signal"), inputs = repeats_.tables("input");
    declare_motion_scope(file_, {states, memories, signals}, inputs, mechanism);
    read_bodies(file_, repeats_.tables("body"), mechanism);
    read_joints(file_, repeats_.tables("joint"), mechanism);
    read_overrides(file_, repeats_.tables("override"), mechanism);
    read_actuators(file_, repeats_.tables("actuator"), mechanism);
    read_frames(file_, repeats_.tables("frame"), mechanism);
    attach_imports(file_, imports, mechanism);
    read_inputs(file_, inputs, mechanism);
    read_frictions(file_, repeats_.tables("friction"), mechanism);
    read_states(file_, {states, memories, signals}, mechanism);
    settle_motions(file_, mechanism);
    read_forces(file_, repeats_.tables("force"), mechanism);
    read_stops(file_, repeats_.tables("stop"), mechanism);
    read_contacts(file_, repeats_.tables("contact"), mechanism);
    read_tyres(file_, repeats_.tables("tyre"), mechanism);
    read_springs(file_, repeats_.tables("spring"), mechanism);
    read_bushings(file_, repeats_.tables("bushing"), mechanism);
    read_cables(file_, repeats_.tables("cable"), mechanism);
    read_gear_meshes(file_, repeats_.tables("gear_mesh"), mechanism);
    read_outputs(file_, repeats_.tables("output"), mechanism);
    read_kinematics(file_, repeats_.tables("kinematics"), mechanism);
    read_loops(file_, repeats_.tables("loop"), mechanism);
    read_couplers(file_, repeats_.tables("coupler"), mechanism);
    read_constraints(file_, repeats_.tables("constraint"), mechanism);
    if (const toml::table* section = top_.table("loops"))
      mechanism.loop_options = read_loop_options(file_, *section, top_.where("loops"), mechanism);
    if (top_.has("loops") && mechanism.loops.empty() && !top_.has("loop") && !top_.has("coupler") &&
        !top_.has("constraint"))
      top_.error("loops", "the file has [loops] and no [[loop]]", "each loop joint is a [[loop]]");
    return mechanism;
  }

  const Completeness& complete() { return file_.complete(); }

 private:
  static std::vector<std::string> known_tables() {
    std::vector<std::string> known{"model", "parameters", "repeat", "loops"};
    known.insert(known.end(), kLists.begin(), kLists.end());
    return known;
  }

  /// Those of the file that imports this one.
  void take_given_values(Mechanism& mechanism) {
    if (options_.parameters.empty()) return;
    for (Parameter& parameter : mechanism.parameters)
      if (const auto given = options_.parameters.find(parameter.name); given != options_.parameters.end())
        parameter.value = given->second;
    file_.declare(mechanism);
  }

  void check_loop_options(const std::vector<Import>& imports) {
    bool found = false;
    for (const Import& import : imports) {
      if (import.has_loop_options && found && !top_.has("loops"))
        file_.error(import.where,
                    fmt::format("'{}' has [loops], and so has a file that is imported before",
                                support::shown(import.file)),
                    "[loops] of this file would take their place");
      found = found || import.has_loop_options;
    }
  }

  void read_model(Mechanism& mechanism) {
    mechanism.gravity = {0.0, 0.0, -kStandardGravity};
    if (!top_.has("model") && options_.importing) return;
    if (!top_.has("model"))
      return file_.error({1, 1, 1}, "the file has no [model]", "it needs at least [model] and a name");
    const toml::table* section = top_.table("model");
    if (!section) return;
    mechanism.where = top_.where("model");
    const TomlTable table(file_, *section, "[model]", top_.where("model"), keys_of("model"));
    mechanism.name = table.required_text("name").value_or("");
    check_model_name(table, mechanism.name);
    mechanism.description = table.text("description").value_or("");
    mechanism.source = table.text("source").value_or("");
    mechanism.gravity = table.vector("gravity", needed::kAcceleration, mechanism.gravity);
  }

  static void check_model_name(const TomlTable& table, const std::string& name) {
    constexpr int kLongest = 100;
    int length = 0;
    for (std::size_t i = 0; i < name.size(); ++length) {
      i += support::utf8_at(name, i).bytes;
    }
    if (length > kLongest)
      table.error("name", fmt::format("the model's name is longer than {} characters", kLongest));
  }

  TomlFile file_;
  TomlTable top_;
  Repeats repeats_;
  const ReadOptions& options_;
  ImportBudget budget_;
  ImportChain chain_;
};

}  // namespace

std::optional<Part> read_toml(Diagnostics& diagnostics, const ReadOptions& options) {
  if (options.root == RootJoint::kFree) {
    diagnostics.error({}, "a free root can be asked for with URDF and SDF files only",
                      "declare the root's joint in the file");
    return {};
  }
  const std::optional<toml::table> root = parse_toml(diagnostics);
  if (!root) return {};
  TomlReader reader(diagnostics, *root, options);
  Mechanism mechanism = reader.read();
  return Part{std::move(mechanism), reader.complete(), support::Severity::kError};
}

}  // namespace jourdain::model
