// Straight-line symbolic statements: every intermediate of the derivation is bound to a named symbol, so that no
// expression ever grows beyond a few terms.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "kinematics/spatial.hpp"
#include "support/leaf_kind.hpp"

namespace jourdain::kinematics {

using support::LeafKind;

/// A free symbol of the statements.
struct Leaf {
  LeafKind kind = LeafKind::kParameter;
  std::size_t index = 0;  ///< entry of the parameter list, y, z, ż, λ or u; 0 for t
  GiNaC::symbol symbol;
};

struct Statement {
  GiNaC::symbol name;
  Ex value;  ///< of leaves, numbers and earlier names
  /// Its number among those that derivatives take for leaves, whose changes are given apart.
  std::optional<std::size_t> held = {};
};

/// Leaves and statements in order of declaration. Numbers are exact rationals or floats of `kDigits` digits.
class Statements {
 public:
  Ex leaf(LeafKind kind, std::size_t index, const std::string& name);

  /// Binds `value` to a new symbol and returns that; numbers, symbols and negated symbols come back as they are.
  Ex bind(const std::string& name, const Ex& value);
  /// Binds `value` to a new symbol whatever it is, which derivatives take for a leaf.
  Ex hold(const std::string& name, const Ex& value);
  Vector3 bind(const std::string& name, const Vector3& value);
  /// Binds a matrix row by row.
  Matrix3 bind(const std::string& name, const Matrix3& value);
  /// Binds the upper triangle of a symmetric matrix.
  Matrix3 bind_symmetric(const std::string& name, const Matrix3& value);

  /// Forgets statements from number `count` on, for others in their place.
  void rewind(std::size_t count) {
    statements_.erase(statements_.begin() + static_cast<std::ptrdiff_t>(count), statements_.end());
  }

  const std::vector<Leaf>& leaves() const { return leaves_; }
  const std::vector<Statement>& all() const { return statements_; }

 private:
  std::vector<Leaf> leaves_;
  std::vector<Statement> statements_;
  std::size_t held_ = 0;
};

bool is_number(const Ex& value);
/// 0, 1 or −1.
bool is_trivial(const Ex& value);

}  // namespace jourdain::kinematics
