// C++ statements of a program: one per named or shared value, in the program's order.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "emit/unique_names.hpp"
#include "ir/program.hpp"

namespace jourdain::emit {

/// How leaves are spelt, e.g. state.y[3].
using LeafText = std::function<std::string(ir::LeafKind, std::size_t index)>;

/// How results are written, e.g. `M[0][1] = value;`.
using OutputText = std::function<std::string(const ir::Output&, const std::string& value)>;

/// Statements of a part of a function; parts communicate through an array `w` of Real.
struct Part {
  std::vector<std::string> lines;
};

struct Body {
  std::vector<Part> parts;    ///< the last one writes the outputs
  std::size_t work_size = 0;  ///< entries of `w`; 0 where there is one part
};

/// A compiler's time is close to quadratic in the length of a function, so that a part holds at most this many
/// statements.
inline constexpr std::size_t kMaximumStatements = 1500;

/// Values that live in a variable declared elsewhere (members of the model): they are assigned, not declared.
using StoredValues = std::map<ir::ValueId, std::string>;

/// Values used once and not named are written inside the expression that uses them; the order of operations is that of
/// the program. A pair of sin and cos of one angle is computed by one call.
Body print_body(const ir::Program& program, Names names, const LeafText& leaf, const OutputText& output,
                const StoredValues& stored = {}, std::size_t maximum_statements = kMaximumStatements);

/// Does a sine or cosine depend on time? Such angles are computed as detail::Angle; a value that passes from
/// part to part is rounded.
bool turns_with_time(const ir::Program& program);

/// Shortest decimal that reads back as `value`, as a Real.
std::string literal_text(double value);

}  // namespace jourdain::emit
