// Structs, constants, names and declarations of the text against what the model has.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "readback/expected.hpp"
#include "readback/findings.hpp"
#include "readback/syntax.hpp"

namespace jourdain::readback {

/// In front of every source: GCC packs neighbouring numbers into vectors of 256 bits, no wider ones.
inline constexpr const char* kNarrowVectors[] = {
    "#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ > 7 && defined(__AVX512F__)",
    "#pragma GCC target(\"prefer-vector-width=256\")", "#endif"};

/// In front of sources with functions that are marked so, steps that hold short ones: in those GCC packs nothing.
inline constexpr const char* kStages[] = {
    "#if !defined(JOURDAIN_STAGES) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && "
    "defined(__x86_64__)",
    "#if defined(__GNUC__) && __GNUC__ > 10 && !defined(__clang__) && !defined(__EDG__) && "
    "!defined(__NVCOMPILER) && !defined(__CUDACC__)",
    "#define JOURDAIN_STAGES __attribute__((optimize(\"no-tree-vectorize\")))", "#endif", "#endif"};

/// Files, members, sizes, defaults, limits, names.
void check_structs(const Unit& unit, const Expected& expected, Findings& findings);

/// The namespace of indices: a constant for each position, velocity and input, spelt like its name, with its entry.
void check_indices(const Unit& unit, const Expected& expected, Findings& findings);

/// Names of those constants and what they are. Of names that are spelt alike the later ones have a number.
std::vector<std::pair<std::string, std::size_t>> index_names(const Expected& expected);

/// The same of C: files, structs, counts, indices, limits, default values, names.
void check_c_structs(const Unit& unit, const Expected& expected, const std::string& prefix,
                     Findings& findings);

/// Names of the arrays of names, and their entries.
std::vector<std::pair<std::string, std::vector<std::string>>> name_arrays(const Expected& expected);

/// Every function is declared, defined and instantiated for double and float as the API has it, and nothing
/// else is; the operations that comments state are those that were counted.
void check_declarations(const Unit& unit, const Expected& expected, Findings& findings);

/// loops_closed and loops_proven, at their limits, beside them, and where something is not a number.
void check_guards(const Unit& unit, const Expected& expected, Findings& findings);

}  // namespace jourdain::readback
