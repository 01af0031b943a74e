// One mechanism put beside another.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Puts `prefix` before all names that the mechanism declares; its frame "world" keeps its name.
void add_prefix(Mechanism& mechanism, const std::string& prefix);

/// A name that both declare, in words, and where the first one does.
struct NameClash {
  std::string what;  ///< "bodies 'base'"
  SourceRange first;
};
std::optional<NameClash> name_clash(const Mechanism& mechanism, const Mechanism& part);

struct Merge {
  /// By parameter of the part, what takes its place, of the mechanism's parameters; none: it comes along.
  std::vector<std::optional<Expression>> parameters;
  int file = 0;  ///< is added to the numbers of the part's files
};

/// Nothing is merged, and false returned, where an expression would be longer than kMaximumExpressionSize.
bool merge(Mechanism& mechanism, Mechanism part, const Merge& how);

}  // namespace jourdain::model
