// Expressions as nodes, each once: equal indices mean equal trees, operand by operand and bit by bit.
#pragma once

#include <unordered_map>
#include <vector>

#include "ir/program.hpp"
#include "readback/domain.hpp"

namespace jourdain::readback {

/// Nothing is simplified, nothing reordered.
class NodeTable : public Domain {
 public:
  /// `rounds_to_float`: literals are floats.
  explicit NodeTable(bool rounds_to_float = false) : rounds_to_float_(rounds_to_float) {}

  Number literal(double value) override;
  Number array(std::vector<double> values) override;
  Number leaf(ir::LeafKind kind, std::size_t index);
  /// A leaf that no program has: what stood in a place before.
  Number mark(std::size_t index);

  /// The values of a program's outputs as nodes of this table, in order; nothing is counted.
  std::vector<Number> insert(const ir::Program& program);

  /// "(y[0] + 2.5) * …", to a depth of a few operations.
  std::string print(Number number, int depth = 3) const;
  std::size_t size() const { return nodes_.size(); }

 protected:
  Number apply(ir::Op op, Number a, Number b) override;
  bool is_literal(Number) const override { return false; }  // programs have no operations of two literals

 private:
  struct Node {
    std::uint32_t op = 0, a = 0, b = 0;  ///< a leaf's kind and index
    std::uint64_t bits = 0;              ///< of a literal
    friend bool operator==(const Node&, const Node&) = default;
  };
  struct Hash {
    std::size_t operator()(const Node& node) const;
  };
  Number intern(const Node& node);
  double rounded(double value) const;

  bool rounds_to_float_;
  std::vector<Node> nodes_;
  std::unordered_map<Node, Number, Hash> known_;
};

}  // namespace jourdain::readback
