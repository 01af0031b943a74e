// A TOML description as a tree that can be changed in any way, also to what no description may be.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace jourdain::tests {

struct Node {
  enum class Kind { kScalar, kList, kTable };
  Kind kind = Kind::kScalar;
  std::string text = {};  ///< of a scalar, as it stands in a file: quoted where it is a string
  std::vector<Node> items = {};
  std::vector<std::pair<std::string, Node>> entries = {};

  bool is_list() const { return kind == Kind::kList; }
  bool is_table() const { return kind == Kind::kTable; }
  bool is_string() const { return kind == Kind::kScalar && text.starts_with('"'); }
  bool is_number() const { return kind == Kind::kScalar && !is_string(); }
  Node* find(const std::string& key);
};

Node scalar(std::string text);
/// A basic string; control characters, quotes and backslashes are escaped.
std::string quoted(const std::string& text);
/// The contents of a string without escapes.
std::string unquoted(const Node& string);

/// `toml` must be valid.
Node read_tree(const std::string& toml);
/// Tables of the root as [sections], lists of tables as [[sections]], everything else in one line.
std::string print_tree(const Node& root);

/// A node and where it is kept: entry or item `index` of `parent`.
struct Place {
  Node* parent = nullptr;
  std::size_t index = 0;
  Node& node() const { return parent->is_list() ? parent->items[index] : parent->entries[index].second; }
};

/// All nodes below `root`.
std::vector<Place> places(Node& root);

}  // namespace jourdain::tests
