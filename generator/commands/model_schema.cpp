#include "commands/model_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/joint_kinds.hpp"
#include "model/read/keys.hpp"
#include "support/check.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;

Json reference(const std::string& name) { return {{"$ref", "#/definitions/" + name}}; }

Json any_of(const std::vector<Json>& choices) { return {{"anyOf", choices}}; }

Json list_of(const Json& entry) { return {{"type", "array"}, {"items", entry}}; }

Json closed_table(const Json& properties) {
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

/// Also an expression, or with its unit. Written out: beside a reference editors show no meaning.
Json number() { return any_of({{{"type", "number"}}, {{"type", "string"}}, reference("quantity")}); }

/// Numbers, or one table that gives them all their unit.
Json vector_of(int count) {
  Json list = list_of(number());
  list["minItems"] = list["maxItems"] = count;
  Json with_unit = closed_table({{"value", list}, {"unit", {{"type", "string"}}}});
  with_unit["required"] = {"value", "unit"};
  return any_of({list, with_unit});
}

/// `"a", "b"`: the words between the quotes.
Json quoted_words(std::string_view type) {
  Json words = Json::array();
  for (std::size_t open = type.find('"'); open != std::string_view::npos; open = type.find('"', open)) {
    const std::size_t close = type.find('"', open + 1);
    words.push_back(std::string(type.substr(open + 1, close - open - 1)));
    open = close + 1;
  }
  return {{"enum", words}};
}

/// What a value of this type (model::Key) may be.
Json value_of(std::string_view type) {
  const auto is_one_of = [type](std::initializer_list<std::string_view> list) {
    return std::find(list.begin(), list.end(), type) != list.end();
  };
  if (type.starts_with('"')) return quoted_words(type);
  if (is_one_of({"text", "name", "word"})) return {{"type", "string"}};
  if (is_one_of({"number", "constant", "expression", "expression of t"})) return number();
  if (is_one_of({"2 numbers", "2 constants"})) return vector_of(2);
  if (is_one_of({"3 numbers", "3 constants", "3 expressions"})) return vector_of(3);
  if (is_one_of({"4 numbers"})) return vector_of(4);
  if (is_one_of({"3 letters"})) return {{"type", "string"}, {"pattern", "^[xyz]{3}$"}};
  if (is_one_of({"integer"})) return {{"type", "integer"}};
  if (is_one_of({"true, false"})) return {{"type", "boolean"}};
  if (is_one_of({"list of names", "texts"})) return list_of({{"type", "string"}});
  if (is_one_of({"list of constants"})) return list_of(number());
  if (is_one_of({"list of numbers or lists"})) return list_of(any_of({number(), list_of(number())}));
  if (is_one_of({"table of numbers"})) return {{"type", "object"}, {"additionalProperties", number()}};
  JD_CHECK(false, "the schema knows no type '{}'", type);
}

/// Tables whose keys are no section of their own.
Json table_of(std::string_view section, std::string_view key) {
  if (key == "inertia")
    return any_of({vector_of(3), closed_table({{"xx", number()},
                                               {"yy", number()},
                                               {"zz", number()},
                                               {"xy", number()},
                                               {"xz", number()},
                                               {"yz", number()},
                                               {"unit", {{"type", "string"}}}})});
  if (key == "shape") {
    Json shape = closed_table({{"kind", {{"enum", {"box", "cylinder", "sphere", "rod"}}}},
                               {"size", vector_of(3)},
                               {"radius", number()},
                               {"length", number()},
                               {"axis", {{"enum", {"x", "y", "z"}}}},
                               {"density", number()}});
    shape["required"] = {"kind"};
    return shape;
  }
  JD_CHECK(section == "import" && key == "parameters", "the schema knows no table '{}'", key);
  return value_of("table of numbers");
}

Json property(const model::KeySection& section, const model::Key& key) {
  const std::string_view type = key.type;
  Json schema = type.ends_with("table") ? table_of(section.name, key.name) : value_of(type);
  std::string text = *key.unit ? std::string(key.unit) : "";
  for (const std::string& part :
       {std::string(key.meaning), *key.standard ? fmt::format("where left out: {}", key.standard) : ""})
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
  if (!text.empty()) schema["description"] = text;
  return schema;
}

Json properties(const model::KeySection& section) {
  Json list = Json::object();
  for (const model::Key& key : section.keys) list[key.name] = property(section, key);
  return list;
}

const model::KeySection& section_named(std::string_view name) {
  for (const model::KeySection& section : model::key_sections())
    if (section.name == name) return section;
  JD_CHECK(false, "no section '{}'", name);
}

/// A joint has the keys of its coordinate, or a table of them for each; a free one starts at three numbers.
Json joint_properties() {
  Json list = properties(section_named("joint"));
  const Json coordinate = properties(section_named("coordinate"));
  for (const auto& [key, schema] : coordinate.items()) list[key] = schema;
  for (const char* key : {"initial_position", "initial_velocity"})
    list[key] = any_of({list[key], vector_of(3)});
  for (std::size_t type = 0; type < model::joint_type_names().size(); ++type)
    for (const model::JointMotion& motion : model::joint_kind(static_cast<model::JointType>(type)).motions)
      if (!motion.suffix.empty()) list[std::string(motion.suffix)] = reference("coordinate");
  return list;
}

/// Keys that say which thing a table is, without which it is none.
Json required(const model::KeySection& section) {
  Json list = Json::array();
  for (const model::Key& key : section.keys)
    for (const char* word : {"name", "type", "kind", "file", "count", "value"})
      if (!*key.standard && std::string_view(key.name) == word &&
          (std::string_view(word) != "value" || std::string_view(section.name) == "parameter"))
        list.push_back(word);
  return list;
}

/// Tables that stand in lists: [[body]] and so on.
std::vector<std::string> list_names() {
  std::vector<std::string> names;
  for (const model::KeySection& section : model::key_sections())
    if (std::string_view(section.heading).starts_with("[[")) names.emplace_back(section.name);
  return names;
}

Json definition(const model::KeySection& section) {
  const std::string_view name = section.name;
  Json list = name == "joint" ? joint_properties() : properties(section);
  if (name == "override") {
    const Json body = properties(section_named("body"));
    for (const Json& keys : {body, joint_properties()})
      for (const auto& [key, schema] : keys.items())
        if (!list.contains(key)) list[key] = schema;
  }
  if (name == "repeat")
    for (const std::string& table : list_names())
      if (table != "repeat") list[table] = list_of(reference(table));
  Json schema = closed_table(list);
  schema["description"] = section.meaning;
  if (const Json keys = required(section); !keys.empty()) schema["required"] = keys;
  return schema;
}

}  // namespace

std::string model_schema() {
  const Json number_or_text = any_of({{{"type", "number"}}, {{"type", "string"}}});
  Json definitions = Json::object();
  Json with_unit = closed_table({{"value", number_or_text}, {"unit", {{"type", "string"}}}});
  with_unit["required"] = {"value", "unit"};
  definitions["quantity"] = with_unit;
  Json top = Json::object();
  for (const model::KeySection& section : model::key_sections()) {
    const std::string name = section.name;
    const std::string_view heading = section.heading;
    definitions[name] = definition(section);
    if (name == "parameter")
      top["parameters"] = {
          {"type", "object"},
          {"description", section.meaning},
          {"additionalProperties", any_of({{{"type", "number"}}, {{"type", "string"}}, reference(name)})}};
    else if (heading.starts_with("[["))
      top[name] =
          name == "import" ? any_of({list_of(reference(name)), reference(name)}) : list_of(reference(name));
    else if (heading.starts_with("["))
      top[name] = reference(name);
  }
  Json schema = {{"$schema", "http://json-schema.org/draft-04/schema#"},
                 {"title", "A mechanism, as Jourdain reads it"}};
  schema.update(closed_table(top));
  schema["definitions"] = definitions;
  return schema.dump(1) + "\n";
}

}  // namespace jourdain::commands
