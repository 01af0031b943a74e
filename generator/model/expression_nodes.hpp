// What expressions are made of while they are built; for what builds them in this folder.
#pragma once

#include <cstddef>
#include <unordered_set>
#include <vector>

#include "model/expression.hpp"

namespace jourdain::model {

int operand_count(const Expression::Node& node);

/// By node, whether it depends on a variable.
std::vector<bool> moved_by_variables(const std::vector<Expression::Node>& nodes);

/// The value of an operation on literals among `nodes`.
double folded(const std::vector<Expression::Node>& nodes, const Expression::Node& operation);

/// Nodes, each simplified as it comes: constants are folded, exact identities applied, and what is there is used again.
class NodeList {
 public:
  using Op = Expression::Op;
  using Node = Expression::Node;

  NodeList() : known_(0, Hash{this}, Same{this}) {}
  NodeList(const NodeList&) = delete;
  NodeList& operator=(const NodeList&) = delete;

  /// The position of the expression's value.
  std::size_t append(const Expression& expression);
  /// A leaf, or an operation on earlier nodes.
  std::size_t add(const Node& node);
  /// What the value at `root` needs, left operands first, in whichever order it was added.
  std::vector<Node> finish(std::size_t root) const;

 private:
  struct Hash {
    const NodeList* list;
    std::size_t operator()(std::size_t i) const;
  };
  struct Same {
    const NodeList* list;
    bool operator()(std::size_t a, std::size_t b) const;
  };

  bool is_literal(std::size_t i) const { return nodes_[i].op == Op::kLiteral; }
  bool is(std::size_t i, double value) const { return is_literal(i) && nodes_[i].value == value; }
  std::size_t push(Node node);
  /// What a choice does not take need not have a value.
  std::size_t function(const Node& node);

  std::vector<Node> nodes_;
  std::unordered_set<std::size_t, Hash, Same> known_;  ///< positions
};

}  // namespace jourdain::model
