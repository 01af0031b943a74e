// The TOML model file. Wherever a number stands, a string with an expression over parameters may stand
// ("m/3*l^2", "30*deg"; see parse_expression), but for axes and parameter values, which are constant. So may a
// number with its unit ("30 deg", "2.5 N*m/rad", "100mm"), or both apart: { value = 100, unit = "mm" },
// { value = [1, 2, 3], unit = "mm" }. A bare number is in the unit below. Each must have the dimension of its place,
// expressions where a parameter with a unit stands in them (see dimensions.hpp).
// Keys: keys.cpp.
#include <fmt/format.h>

#include "model/read/finish.hpp"
#include "model/read/keys.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_sections.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;

constexpr double kStandardGravity = 9.81;

class TomlReader {
 public:
  TomlReader(Diagnostics& diagnostics, const toml::table& root) : file_(diagnostics), root_(root) {}

  Mechanism read() {
    const std::vector<std::string> known{"model",    "parameters", "body",  "joint",  "frame",
                                         "actuator", "input",      "force", "spring", "bushing",
                                         "loop",     "coupler",    "loops", "output"};
    const TomlTable top(file_, root_, "the file", {}, known);
    Mechanism mechanism;
    if (const toml::table* section = top.table("parameters"))
      mechanism.parameters = read_parameters(file_, *section);
    file_.declare(mechanism.parameters);
    read_model(top, mechanism);
    if (const auto* section = tables(top, "body")) mechanism.bodies = read_bodies(file_, *section);
    if (const auto* section = tables(top, "joint"))
      mechanism.joints = read_joints(file_, *section, mechanism.bodies);
    if (const auto* section = tables(top, "actuator"))
      mechanism.actuators = read_actuators(file_, *section, mechanism.joints);
    if (const auto* section = tables(top, "frame"))
      mechanism.frames = read_frames(file_, *section, mechanism.bodies);
    if (const auto* section = tables(top, "input"))
      mechanism.inputs = read_inputs(file_, *section, mechanism);
    if (const auto* section = tables(top, "force")) read_forces(file_, *section, mechanism);
    if (const auto* section = tables(top, "spring")) read_springs(file_, *section, mechanism);
    if (const auto* section = tables(top, "bushing")) read_bushings(file_, *section, mechanism);
    if (const auto* section = tables(top, "output")) read_outputs(file_, *section, mechanism);
    if (const auto* section = tables(top, "loop")) read_loops(file_, *section, mechanism);
    if (const auto* section = tables(top, "coupler")) read_couplers(file_, *section, mechanism);
    if (const auto* section = top.table("loops"))
      mechanism.loop_options = read_loop_options(file_, *section, top.where("loops"), mechanism);
    if (top.has("loops") && !top.has("loop") && !top.has("coupler"))
      top.error("loops", "the file has [loops] and no [[loop]]", "each loop joint is a [[loop]]");
    return mechanism;
  }

  const Completeness& complete() { return file_.complete(); }

 private:
  void read_model(const TomlTable& top, Mechanism& mechanism) {
    mechanism.gravity = {0.0, 0.0, -kStandardGravity};
    if (!top.has("model"))
      return file_.error({1, 1, 1}, "the file has no [model]", "it needs at least [model] and a name");
    const toml::table* section = top.table("model");
    if (!section) return;
    mechanism.where = top.where("model");
    const TomlTable table(file_, *section, "[model]", top.where("model"), keys_of("model"));
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

  /// The array of tables [[key]], or nothing (after a diagnostic if it is something else).
  const toml::array* tables(const TomlTable& top, const std::string& key) {
    if (!top.has(key)) return nullptr;
    const toml::array* array = top.find(key)->as_array();
    const bool list_of_tables = array && (array->empty() || array->is_homogeneous(toml::node_type::table));
    if (list_of_tables && array->size() <= kMaximumBodies) return array;
    file_.complete().structure = false;
    if (list_of_tables)
      top.error(key, fmt::format("the file has {} [[{}]] tables, more than {}", array->size(), key,
                                 kMaximumBodies));
    else
      top.error(key, fmt::format("'{}' must be a list of tables", key),
                fmt::format("write [[{}]] for each one", key));
    return nullptr;
  }

  TomlFile file_;
  const toml::table& root_;
};

}  // namespace

std::optional<Mechanism> read_toml(Diagnostics& diagnostics, const ReadOptions& options) {
  if (options.root == RootJoint::kFree) {
    diagnostics.error({}, "a free root can be asked for with URDF and SDF files only",
                      "declare the root's joint in the file");
    return {};
  }
  const std::optional<toml::table> root = parse_toml(diagnostics);
  if (!root) return {};
  TomlReader reader(diagnostics, *root);
  Mechanism mechanism = reader.read();
  return finish_reading(std::move(mechanism), reader.complete(), options, support::Severity::kError,
                        diagnostics);
}

}  // namespace jourdain::model
