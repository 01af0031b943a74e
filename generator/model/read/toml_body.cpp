// [[body]]
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "model/read/keys.hpp"
#include "model/read/shapes.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

class BodyReader {
 public:
  BodyReader(TomlFile& file, const toml::table& table, const std::string& name, SourceRange header,
             const std::vector<std::string>& keys, bool changes = false)
      : file_(file),
        table_(file, table, name.empty() ? "a body" : fmt::format("body '{}'", shown(name)), header, keys),
        changes_(changes) {}

  Body read() {
    Body body;
    body.name = table_.required_text("name").value_or("");
    body.where = table_.where("name");
    read_over(body);
    return body;
  }

  /// Keys that are left out change nothing.
  void read_over(Body& body) {
    body.center_of_mass = table_.vector("center_of_mass", needed::kLength, body.center_of_mass);
    if (table_.has("inertia_rpy")) body.inertia_axes = table_.rotation("inertia_rpy");
    if (table_.has("inertia_kind")) body.lumped = table_.choice("inertia_kind", {"rigid", "lumped"}) == 1;
    if (table_.has("inertia_at"))
      body.inertia_point = table_.choice("inertia_at", {"center_of_mass", "origin"}) == 1
                               ? InertiaPoint::kOrigin
                               : InertiaPoint::kCenterOfMass;
    if (table_.has("shape") || table_.has("inertia")) body.lenient = false;
    if (table_.has("shape"))
      read_shape(body);
    else
      read_inertia(body);
  }

 private:
  void read_inertia(Body& body) {
    read_mass(body, "mass = 0 makes it massless");
    if (body.shape && !table_.has("inertia")) {
      refuse_beside_shape({"inertia_at"});
      body.inertia = shape_inertia(*body.shape, body.mass);
    }
    if (!table_.has("inertia")) return;
    body.shape.reset();
    body.inertia_where = table_.where("inertia");
    const toml::table* entries = table_.find("inertia")->as_table();
    if (entries && !entries->contains("value")) {
      const TomlTable inertia(file_, *entries, "inertia of " + table_.what(), body.inertia_where,
                              {"xx", "yy", "zz", "xy", "xz", "yz"});
      const auto entry = [&](const char* key) { return inertia.number(key, needed::kInertia); };
      body.inertia = {entry("xx"), entry("yy"), entry("zz"), entry("xy"), entry("xz"), entry("yz")};
    } else {
      const Vector3 moments = table_.vector("inertia", needed::kInertia);
      body.inertia = {moments[0], moments[1], moments[2], 0.0, 0.0, 0.0};
    }
  }

  void refuse_beside_shape(std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (table_.has(key))
        table_.error(key, fmt::format("{} has a shape and '{}'", table_.what(), key),
                     "the shape gives the inertia about the centre of mass");
  }

  void read_mass(Body& body, const std::string& hint) {
    if (changes_ && !table_.has("mass")) return;
    body.mass_where = table_.where("mass");
    body.mass = table_.number("mass", needed::kMass);
    if (table_.has("mass")) return;
    table_.missing("mass", hint);
    file_.complete().numbers = false;
  }

  void read_shape(Body& body) {
    refuse_beside_shape({"inertia", "inertia_at"});
    body.inertia_point = InertiaPoint::kCenterOfMass;
    body.inertia_where = table_.where("shape");
    const toml::table* entries = table_.table("shape");
    const std::optional<Shape::Kind> kind = entries ? shape_kind(*entries) : std::nullopt;
    if (!kind) {
      file_.complete().numbers = false;
      return;
    }
    const TomlTable table(file_, *entries, "shape of " + table_.what(), body.inertia_where,
                          known_keys(*kind));
    const Shape shape = read_lengths(table, *kind);
    if (table.has("density") && *kind != Shape::Kind::kRod) {
      if (table_.has("mass"))
        table_.error("mass", table_.what() + " has a mass and a density", "leave one of them out");
      body.mass = Expression::binary(Expression::Op::kMultiply, table.positive("density", needed::kDensity),
                                     volume(shape));
      body.mass_where = table.where("density");
    } else {
      read_mass(body, *kind == Shape::Kind::kRod ? "" : "or a density in its shape");
    }
    body.inertia = shape_inertia(shape, body.mass);
    body.shape = shape;
  }

  std::optional<Shape::Kind> shape_kind(const toml::table& entries) {
    const TomlTable table(file_, entries, "shape of " + table_.what(), table_.where("shape"),
                          all_keys(entries));
    if (!table.has("kind")) {
      table.missing("kind", "box, cylinder, sphere or rod");
      return {};
    }
    const std::optional<std::size_t> kind = table.choice("kind", {"box", "cylinder", "sphere", "rod"});
    return kind ? std::optional(static_cast<Shape::Kind>(*kind)) : std::nullopt;
  }

  static std::vector<std::string> all_keys(const toml::table& entries) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : entries) keys.emplace_back(key.str());
    return keys;
  }

  static std::vector<std::string> known_keys(Shape::Kind kind) {
    switch (kind) {
      case Shape::Kind::kBox:
        return {"kind", "size", "density"};
      case Shape::Kind::kCylinder:
        return {"kind", "radius", "length", "axis", "density"};
      case Shape::Kind::kSphere:
        return {"kind", "radius", "density"};
      case Shape::Kind::kRod:
        return {"kind", "length", "axis"};
    }
    return {};
  }

  Shape read_lengths(const TomlTable& table, Shape::Kind kind) {
    Shape shape{.kind = kind};
    const bool round = kind == Shape::Kind::kCylinder || kind == Shape::Kind::kSphere;
    const bool long_one = kind == Shape::Kind::kCylinder || kind == Shape::Kind::kRod;
    if (kind == Shape::Kind::kBox) shape.size = read_size(table);
    if (round) shape.radius = table.positive("radius", needed::kLength);
    if (long_one) shape.length = table.positive("length", needed::kLength);
    if (long_one && table.has("axis")) shape.axis = table.choice("axis", {"x", "y", "z"}).value_or(2);
    return shape;
  }

  Vector3 read_size(const TomlTable& table) {
    Vector3 size = table.vector("size", needed::kLength, {1.0, 1.0, 1.0});
    if (!table.has("size")) {
      table.missing("size");
      file_.complete().numbers = false;
    }
    for (const Expression& edge : size)
      if (file_.value(edge) < 0) {
        table.error("size",
                    fmt::format("{} has a negative edge: {} m", table.quoted("size"), file_.value(edge)));
        file_.complete().numbers = false;
      }
    return size;
  }

  TomlFile& file_;
  TomlTable table_;
  bool changes_;  ///< a body that is there already
};

bool keeps(TomlFile& file, const Body& body, const Mechanism& mechanism) {
  if (body.name.empty()) return false;
  check_identifier(file, body.where, "body", body.name);
  if (body.name == "world") {
    file.error(body.where, "no body may be called 'world'", "it is the inertial frame");
    return false;
  }
  return is_new_name(file, body.where, "bodies", body.name, mechanism.bodies) &&
         is_new_name(file, body.where, "frames", body.name, mechanism.frames);
}

}  // namespace

void read_bodies(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const toml::table& table = *node.as_table();
    Body body =
        BodyReader(file, table, file.text_or(table, "name"), file.range(node.source()), keys_of("body"))
            .read();
    if (keeps(file, body, mechanism))
      mechanism.bodies.push_back(std::move(body));
    else
      file.complete().structure = false;
  }
}

void change_body(TomlFile& file, const toml::table& table, SourceRange where, Body& body) {
  std::vector<std::string> keys = keys_of("body");
  std::replace(keys.begin(), keys.end(), std::string("name"), std::string("body"));
  BodyReader(file, table, body.name, where, keys, true).read_over(body);
}

}  // namespace jourdain::model
