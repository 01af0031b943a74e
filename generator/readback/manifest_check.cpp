#include "readback/manifest_check.hpp"

#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "readback/api.hpp"
#include "readback/methods.hpp"
#include "readback/tokens.hpp"
#include "readback/what_is_read.hpp"

namespace jourdain::readback {

namespace {

using nlohmann::json;

/// Parses, and refuses objects that have a key twice.
json parse_once(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  return json::parse(text, [&keys](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Refusal("the key " + value.dump() + " twice");
    return true;
  });
}

/// As the manifest prints it: two digits; denormal ones too.
double number(double value) { return std::strtod(fmt::format("{:.2g}", value).c_str(), nullptr); }

class ManifestCheck {
 public:
  ManifestCheck(const json& root, const Expected& expected, Findings& findings)
      : root_(root), expected_(expected), findings_(findings) {}

  void check() {
    names();
    loops();
    parameters();
    variables();
    operations();
    steps();
    texts();
    expect("backward_error", number(expected_.backward_error));
    if (std::isfinite(expected_.condition))
      expect("condition", number(expected_.condition));
    else
      expect("condition", nlohmann::json());
    for (const auto& [key, value] : root_.items())
      if (!seen_.count(key)) findings_.add("NAME.json has the key {}", key);
  }

 private:
  void expect(const std::string& key, const json& wanted) {
    seen_.insert(key);
    if (!root_.contains(key) || root_[key] != wanted)
      findings_.add("NAME.json: {} is {}, must be {}", key,
                    root_.contains(key) ? root_[key].dump() : "missing", wanted.dump());
  }

  void names() {
    std::vector<std::string> outputs;
    for (const ExpectedOutput& output : expected_.outputs) outputs.push_back(output.name);
    expect("name", expected_.name);
    expect("title", shown({expected_.title})[0]);
    expect("model", shown({expected_.path})[0]);
    expect("sha256", expected_.sha256);
    if (!expected_.imported.empty()) imported();
    if (!expected_.options.empty()) expect("options", shown(expected_.options));
    expect("position_count", expected_.positions.size());
    expect("velocity_count", expected_.velocities.size());
    expect("input_count", expected_.inputs.size());
    expect("output_count", outputs.size());
    expect("parameter_count", expected_.parameters.size());
    expect("positions", expected_.positions);
    expect("velocities", expected_.velocities);
    expect("inputs", expected_.inputs);
    expect("outputs", outputs);
    expect("functions", expected_.functions);
    called();
  }

  void called() {
    json wanted = json::array();
    for (const auto& [name, function] : expected_.user_functions())
      wanted.push_back({{"name", name}, {"arguments", function.arguments}});
    if (!wanted.empty()) expect("user_functions", wanted);
  }

  void imported() {
    json wanted = json::array();
    for (const support::FileHash& file : expected_.imported)
      wanted.push_back({{"model", shown({file.path})[0]}, {"sha256", file.sha256}});
    expect("imported", wanted);
  }

  json ranges(const std::vector<ExpectedRange>& list, const std::vector<std::string>& names) const {
    json object = json::object();
    for (const ExpectedRange& range : list) object[names[range.index]] = {range.low, range.high};
    return object;
  }

  void loops() {
    if (expected_.constraints.empty()) return;
    std::vector<std::string> dependents, names;
    for (const std::size_t entry : expected_.dependents) dependents.push_back(expected_.positions[entry]);
    for (const ExpectedParameter& parameter : expected_.parameters) names.push_back(parameter.name);
    expect("constraints", expected_.constraints);
    expect("dependent_positions", dependents);
    std::vector<std::string> carried;
    for (const std::size_t entry : expected_.carried) carried.push_back(expected_.positions[entry]);
    if (!carried.empty()) expect("carried_positions", carried);
    expect("least_regularity", expected_.least_regularity);
    expect("greatest_opening", expected_.greatest_opening);
    if (!expected_.proven_positions.empty())
      expect("proven_ranges", ranges(expected_.proven_positions, expected_.positions));
    if (!expected_.proven_parameters.empty())
      expect("proven_parameters", ranges(expected_.proven_parameters, names));
  }

  void parameters() {
    std::vector<std::string> names;
    std::vector<double> values;
    json ranges = json::object();
    for (const ExpectedParameter& parameter : expected_.parameters) {
      names.push_back(parameter.name);
      values.push_back(parameter.value);
      if (parameter.range) ranges[parameter.name] = *parameter.range;
    }
    expect("parameters", names);
    expect("parameter_values", values);
    if (!ranges.empty()) expect("parameter_ranges", ranges);
  }

  void variables() {
    json wanted = json::array();
    for (const ExpectedVariable& variable : expected_.variables) {
      json row = {{"name", shown({variable.name})[0]}, {"role", variable.role},
                  {"index", variable.index},           {"quantity", variable.quantity},
                  {"unit", shown({variable.unit})[0]}, {"description", shown({variable.description})[0]}};
      if (variable.is_array) {
        row["rows"] = variable.rows;
        row["columns"] = variable.columns;
        row["numbers"] = shown(variable.numbers);
      }
      if (!variable.start.empty()) row["start"] = variable.start;
      if (variable.range) row["range"] = *variable.range;
      if (!variable.derivative_of.empty()) row["derivative_of"] = shown({variable.derivative_of})[0];
      if (const std::vector<std::string> read = what_is_read(variable, expected_); !read.empty())
        row["depends_on"] = read;
      wanted.push_back(row);
    }
    expect("variables", wanted);
  }

  void operations() {
    json wanted = json::object();
    for (const auto& [name, count] : findings_.counts) {
      json& entry = wanted[name];
      entry = {{"arithmetic", count.arithmetic()},
               {"add", count.add},
               {"sub", count.subtract},
               {"mul", count.multiply},
               {"div", count.divide},
               {"sqrt", count.sqrt},
               {"neg", count.negate},
               {"sin", count.sin},
               {"cos", count.cos}};
      if (count.atan2 > 0) entry["atan2"] = count.atan2;
      if (count.functions > 0) entry["functions"] = count.functions;
      if (count.selections > 0) entry["selections"] = count.selections;
    }
    expect("operations", wanted);
  }

  void steps() {
    json wanted = json::object();
    for (const auto& [name, cost] : findings_.steps)
      wanted[name] = {{"order", order_of(name, expected_.all_derivatives && expected_.carried.empty())},
                      {"evaluations", cost.evaluations},
                      {"operations", cost.operations}};
    expect("steps", wanted);
  }

  void texts() {
    expect("assumptions", shown(expected_.assumptions));
    expect("left_out", shown(expected_.left_out));
    seen_.insert("generator");
    if (!root_.contains("generator") || !root_["generator"].is_string() ||
        !root_["generator"].get<std::string>().starts_with("Jourdain "))
      findings_.add("NAME.json does not name its generator");
  }

  /// Sentences with their control characters as '?'.
  static std::vector<std::string> shown(std::vector<std::string> sentences) {
    for (std::string& sentence : sentences)
      for (char& c : sentence)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return sentences;
  }

  const json& root_;
  const Expected& expected_;
  Findings& findings_;
  std::set<std::string> seen_;
};

}  // namespace

void check_manifest(const std::string& text, const Expected& expected, Findings& findings) {
  findings.guarded("NAME.json", [&] {
    const json root = parse_once(text);
    if (!root.is_object()) throw Refusal("no object");
    ManifestCheck(root, expected, findings).check();
  });
}

}  // namespace jourdain::readback
