#include "fuzz/description_tree.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace jourdain::tests {

namespace {

Node converted(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Node result{.kind = Node::Kind::kTable};
    for (const auto& [key, value] : *table)
      result.entries.emplace_back(std::string(key.str()), converted(value));
    return result;
  }
  if (const auto* array = node.as_array()) {
    Node result{.kind = Node::Kind::kList};
    for (const toml::node& item : *array) result.items.push_back(converted(item));
    return result;
  }
  if (const auto* text = node.as_string()) return scalar(quoted(text->get()));
  if (const auto* number = node.as_floating_point()) return scalar(fmt::format("{}", number->get()));
  if (const auto* number = node.as_integer()) return scalar(fmt::format("{}", number->get()));
  return scalar(node.value_or(false) ? "true" : "false");
}

std::string printed_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c == '_' || c == '-' || (c < 0x80 && std::isalnum(c));
  });
  return bare ? key : quoted(key);
}

std::string in_line(const Node& node) {
  std::vector<std::string> parts;
  for (const Node& item : node.items) parts.push_back(in_line(item));
  for (const auto& [key, value] : node.entries) parts.push_back(printed_key(key) + " = " + in_line(value));
  if (node.is_list()) return fmt::format("[{}]", fmt::join(parts, ", "));
  return node.is_table() ? fmt::format("{{ {} }}", fmt::join(parts, ", ")) : node.text;
}

std::string lines(const Node& table) {
  std::string text;
  for (const auto& [key, value] : table.entries) text += printed_key(key) + " = " + in_line(value) + "\n";
  return text;
}

bool is_section_list(const Node& node) {
  return node.is_list() && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(), [](const Node& n) { return n.is_table(); });
}

void collect(Node& node, std::vector<Place>& found) {
  for (std::size_t i = 0; i < std::max(node.items.size(), node.entries.size()); ++i) {
    found.push_back({&node, i});
    collect(found.back().node(), found);
  }
}

}  // namespace

Node* Node::find(const std::string& key) {
  for (auto& [name, value] : entries)
    if (name == key) return &value;
  return nullptr;
}

Node scalar(std::string text) { return {.text = std::move(text)}; }

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (const auto byte = static_cast<unsigned char>(c); byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04x}", byte);
    else
      out += c;
  }
  return out + "\"";
}

std::string unquoted(const Node& string) { return string.text.substr(1, string.text.size() - 2); }

Node read_tree(const std::string& toml) { return converted(toml::parse(std::string_view(toml))); }

std::string print_tree(const Node& root) {
  std::string head, sections;
  for (const auto& [key, value] : root.entries) {
    const std::string name = printed_key(key);
    if (value.is_table())
      sections += fmt::format("[{}]\n{}\n", name, lines(value));
    else if (is_section_list(value))
      for (const Node& item : value.items) sections += fmt::format("[[{}]]\n{}\n", name, lines(item));
    else
      head += fmt::format("{} = {}\n", name, in_line(value));
  }
  return head + sections;
}

std::vector<Place> places(Node& root) {
  std::vector<Place> found;
  collect(root, found);
  return found;
}

}  // namespace jourdain::tests
