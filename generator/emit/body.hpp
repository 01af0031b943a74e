// Statements of a program: one per named or shared value, in the program's order.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emit/tree.hpp"
#include "emit/unique_names.hpp"

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

/// Statements of a function. A compiler's time grows faster than the length of a function, and what passes from part to
/// part goes through memory: TALOS' forward dynamics (1865) take 0.9 of the time, and 0.9 of the code, in one part
/// instead of two; its derivatives (26 000) compile in 44 s in parts of 1500, in 53 s in parts of 3000.
struct Lengths {
  std::size_t whole = 4000;  ///< a longer one is cut
  std::size_t part = 1500;   ///< its parts hold at most so many
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

}  // namespace jourdain::emit
