#include "fuzz/toml_mutation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "fuzz/hostile_values.hpp"

namespace jourdain::tests {

namespace {

using Wanted = std::function<bool(const Node&)>;

/// A node of that sort, or none.
Node* pick(Node& tree, const Wanted& wanted, Random& random) {
  std::vector<Node*> found;
  for (const Place& place : places(tree))
    if (wanted(place.node())) found.push_back(&place.node());
  return found.empty() ? nullptr : one_of(found, random);
}

Place pick_place(Node& tree, Random& random) {
  const std::vector<Place> all = places(tree);
  return all.empty() ? Place{} : one_of(all, random);
}

/// Values of the key "name" in all tables, and names of parameters.
std::vector<std::string> names_in(Node& tree) {
  std::vector<std::string> names;
  for (const Place& place : places(tree))
    if (place.parent->is_table() && place.parent->entries[place.index].first == "name" &&
        place.node().is_string())
      names.push_back(unquoted(place.node()));
  if (const Node* parameters = tree.find("parameters"))
    for (const auto& [name, value] : parameters->entries) names.push_back(name);
  return names;
}

/// What expressions may hold: names, rates, points of frames.
std::vector<std::string> symbols_in(Node& tree) {
  static const std::vector<std::string> kSuffixes = {".rate", ".x", ".y", ".vz", ".wx", ".angle", ".q"};
  std::vector<std::string> symbols = names_in(tree);
  for (std::size_t i = symbols.size(); i-- > 0;)
    symbols.push_back(symbols[i] + kSuffixes[i % kSuffixes.size()]);
  symbols.insert(symbols.end(), {"t", "length", "rate", "s"});
  return symbols;
}

void erase(const Place& place) {
  const auto at = static_cast<std::ptrdiff_t>(place.index);
  if (place.parent->is_list())
    place.parent->items.erase(place.parent->items.begin() + at);
  else
    place.parent->entries.erase(place.parent->entries.begin() + at);
}

void delete_node(Node& tree, Node&, Random& random) {
  if (const Place place = pick_place(tree, random); place.parent) erase(place);
}

void duplicate_node(Node& tree, Node&, Random& random) {
  const Place place = pick_place(tree, random);
  if (!place.parent) return;
  if (place.parent->is_list()) {
    const Node copy = place.node();
    place.parent->items.push_back(copy);
  } else if (random.chance(0.2)) {
    const auto copy = place.parent->entries[place.index];
    place.parent->entries.push_back(copy);
  }
}

void rename_key(Node& tree, Node& donor, Random& random) {
  const Place place = pick_place(tree, random);
  if (!place.parent || !place.parent->is_table()) return;
  std::string& key = place.parent->entries[place.index].first;
  const Place other = pick_place(donor, random);
  if (random.chance(0.4) && other.parent && other.parent->is_table())
    key = other.parent->entries[other.index].first;
  else
    key = random.chance(0.5) ? hostile_name(random) : key.substr(0, key.size() / 2) + "e";
}

void hostile_scalar(Node& tree, Node&, Random& random) {
  Node* node = pick(
      tree, [](const Node& n) { return n.kind == Node::Kind::kScalar; }, random);
  static const std::vector<std::string> kOthers = {"true",
                                                   "false",
                                                   "1979-05-27",
                                                   "07:32:00",
                                                   "1979-05-27T07:32:00Z",
                                                   "[]",
                                                   "{}",
                                                   "[[]]",
                                                   "\"\"",
                                                   "''",
                                                   "'x'",
                                                   "\"\"\"\nx\"\"\"",
                                                   "[1, 2, 3, 4]",
                                                   "[\"a\"]",
                                                   "{ value = 1 }",
                                                   "\"1 mm\"",
                                                   "\"3 furlong\"",
                                                   "\"90 deg\"",
                                                   "",
                                                   "nul"};
  if (!node) return;
  const double choice = random.unit();
  if (choice < 0.5)
    node->text = hostile_number(random);
  else
    node->text = choice < 0.75 ? quoted(hostile_name(random)) : one_of(kOthers, random);
}

/// A number that stays one.
void change_number(Node& tree, Node&, Random& random) {
  Node* node = pick(
      tree, [](const Node& n) { return n.is_number(); }, random);
  if (!node) return;
  const double value = std::strtod(node->text.c_str(), nullptr);
  static const std::vector<double> kFactors = {-1, 0.5, 2, 1e-3, 1e3, 1e-12, 1e12, 1 + 1e-9, 1 + 1e-15, 0};
  node->text = fmt::format("{}", value * one_of(kFactors, random));
}

void number_of_any_size(Node& tree, Node&, Random& random) {
  if (Node* node = pick(
          tree, [](const Node& n) { return n.is_number(); }, random))
    node->text = any_number(random);
}

void expression(Node& tree, Node&, Random& random) {
  const bool anywhere = random.chance(0.2);
  Node* node = pick(
      tree, [&](const Node& n) { return anywhere ? n.kind == Node::Kind::kScalar : n.is_number(); }, random);
  if (node) node->text = quoted(any_expression(symbols_in(tree), static_cast<int>(random.below(5)), random));
}

/// The value of a number as text, with a unit at times.
void number_as_text(Node& tree, Node&, Random& random) {
  static const std::vector<std::string> kTails = {"",     "",     " m", " mm", " deg", " kg",
                                                  "*deg", " + 0", "*1", "/3",  "^2",   " N m/rad"};
  if (Node* node = pick(
          tree, [](const Node& n) { return n.is_number(); }, random))
    node->text = quoted(node->text + one_of(kTails, random));
}

void copy_table(Node& tree, Node& donor, Random& random) {
  if (donor.entries.empty()) return;
  const auto& [key, section] = donor.entries[random.below(donor.entries.size())];
  Node* here = tree.find(key);
  if (here && here->is_list() && section.is_list() && !section.items.empty())
    here->items.push_back(section.items[random.below(section.items.size())]);
  else if (!here)
    tree.entries.emplace_back(key, section);
}

void swap_values(Node& tree, Node&, Random& random) {
  const Wanted is_scalar = [](const Node& n) { return n.kind == Node::Kind::kScalar; };
  Node* a = pick(tree, is_scalar, random);
  Node* b = pick(tree, is_scalar, random);
  if (a && b) std::swap(a->text, b->text);
}

void change_type(Node& tree, Node& donor, Random& random) {
  const Place place = pick_place(tree, random), other = pick_place(donor, random);
  if (place.parent && other.parent) place.node() = Node(other.node());
}

void wrap(Node& tree, Node&, Random& random) {
  const Place place = pick_place(tree, random);
  if (!place.parent) return;
  Node inner = place.node();
  Node outer{.kind = random.chance(0.5) ? Node::Kind::kList : Node::Kind::kTable};
  if (outer.is_list())
    outer.items.push_back(std::move(inner));
  else
    outer.entries.emplace_back(random.chance(0.5) ? "value" : "x", std::move(inner));
  place.node() = std::move(outer);
}

/// A list with more or fewer items.
void resize_list(Node& tree, Node&, Random& random) {
  Node* list = pick(
      tree, [](const Node& n) { return n.is_list() && !n.items.empty(); }, random);
  if (!list) return;
  if (random.chance(0.5))
    list->items.resize(random.below(list->items.size()));
  else
    std::rotate(list->items.begin(), list->items.begin() + 1, list->items.end());
}

/// One name, everywhere: a scene that stays valid if the new name may be one.
void rename_everywhere(Node& tree, Node&, Random& random) {
  const std::vector<std::string> names = names_in(tree);
  if (names.empty()) return;
  const std::string before = one_of(names, random);
  const std::string after = random.chance(0.85) ? hostile_name(random) : one_of(names, random);
  for (const Place& place : places(tree)) {
    if (place.parent->is_table() && place.parent->entries[place.index].first == before)
      place.parent->entries[place.index].first = after;
    if (place.node().is_string() && unquoted(place.node()) == before) place.node().text = quoted(after);
  }
}

/// A reference to another thing that is there.
void other_name(Node& tree, Node&, Random& random) {
  const std::vector<std::string> names = names_in(tree);
  if (Node* node = pick(
          tree, [](const Node& n) { return n.is_string(); }, random);
      node && !names.empty())
    node->text = quoted(random.chance(0.1) ? "world" : one_of(names, random));
}

/// A table of one of the sections, of keys that it may have.
void new_table(Node& tree, Node&, Random& random) {
  static const std::vector<std::pair<std::string, std::vector<std::string>>> kTables = {
      {"output", {"name", "kind", "frame", "joint", "value"}},
      {"frame", {"name", "body", "position", "rpy"}},
      {"force", {"frame", "force", "moment", "axes"}},
      {"force", {"joint", "coordinate", "value"}},
      {"spring", {"from", "to", "stiffness", "damping", "free_length", "law"}},
      {"actuator", {"joint", "name", "gear_ratio", "rotor_inertia"}},
      {"loop", {"name", "type", "from", "to", "axis", "length"}},
      {"input", {"name", "unit"}}};
  static const std::vector<std::string> kKinds = {
      "pose",           "velocity",         "acceleration", "jacobian", "reaction", "drive",
      "kinetic_energy", "potential_energy", "expression",   "ball",     "revolute", "rod",
      "planar_pin",     "residual",         "point_on_line"};
  const auto& [section, keys] = one_of(kTables, random);
  const std::vector<std::string> symbols = symbols_in(tree), names = names_in(tree);
  Node table{.kind = Node::Kind::kTable};
  for (const std::string& key : keys) {
    if (random.chance(0.25) && key != "name") continue;
    std::string value = quoted(any_expression(symbols, 2, random));
    if (key == "name") value = quoted(fmt::format("new{}", random.below(1000)));
    if (key == "kind" || key == "type") value = quoted(one_of(kKinds, random));
    if (key == "axes") value = quoted(random.chance(0.5) ? "world" : "frame");
    if (key == "position" || key == "rpy" || key == "axis" || key == "force" || key == "moment")
      value = fmt::format("[{}, {}, {}]", random.chance(0.3) ? value : "0.5", any_number(random), "1");
    if ((key == "frame" || key == "body" || key == "joint" || key == "from" || key == "to") && !names.empty())
      value = quoted(random.chance(0.15) ? "world" : one_of(names, random));
    table.entries.emplace_back(key, scalar(value));
  }
  Node* here = tree.find(section);
  if (!here) here = &tree.entries.emplace_back(section, Node{.kind = Node::Kind::kList}).second;
  if (here->is_list()) here->items.push_back(std::move(table));
}

}  // namespace

void mutate(Node& tree, Node& donor, Random& random) {
  using Mutation = void (*)(Node&, Node&, Random&);
  static const std::vector<Mutation> kMutations = {
      delete_node,    duplicate_node,     rename_key,         hostile_scalar, change_number,
      change_number,  number_of_any_size, number_of_any_size, expression,     expression,
      number_as_text, copy_table,         swap_values,        change_type,    wrap,
      resize_list,    rename_everywhere,  rename_everywhere,  other_name,     new_table,
      new_table};
  one_of(kMutations, random)(tree, donor, random);
}

}  // namespace jourdain::tests
