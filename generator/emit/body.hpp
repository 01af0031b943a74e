// Statements of a program: one per named or shared value, in the program's order.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emit/parts.hpp"
#include "emit/tree.hpp"
#include "emit/unique_names.hpp"
#include "ir/module.hpp"

namespace jourdain::emit {

/// Where leaves are, e.g. entry 3 of y of the state.
using LeafPlace = std::function<Expression(ir::LeafKind, std::size_t index)>;

/// What is done with results, e.g. M[0][1] is set.
using ResultStatement = std::function<Statement(const ir::Output&, Expression value)>;

/// Parts of a function communicate through an array `w` of reals.
struct Body {
  std::vector<Statements> parts;  ///< the last one writes the outputs
  std::size_t work_size = 0;      ///< entries of `w`; 0 where there is one part
};

/// Values that live in a variable declared elsewhere (members of the model): they are assigned, not declared.
using StoredValues = std::map<ir::ValueId, std::string>;

/// Values used once and not named are written inside the expression that uses them; the order of operations is that of
/// the program. A pair of sin and cos of one angle is computed by one call.
Body body_of(const ir::Program& program, Names names, const LeafPlace& leaf, const ResultStatement& result,
             const StoredValues& stored = {}, const Lengths& lengths = {});

/// Does a sine or cosine depend on time? Such angles are computed as angles; a value that passes from
/// part to part is rounded.
bool turns_with_time(const ir::Program& program);
/// Has any of the module's functions one?
bool any_turns_with_time(const ir::Module& module);

}  // namespace jourdain::emit
