// The functions of an emitted model as runtime/embedding.md promises them: arguments, their order and shapes, and where
// results go. Stated here once more, without a look at what writes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "readback/expected.hpp"

namespace jourdain::readback {

/// How a function hands back what it computes.
enum class Result {
  kState,       ///< returns a State
  kNumber,      ///< returns a number
  kArrays,      ///< fills arrays
  kStruct,      ///< fills members of a struct
  kCorrection,  ///< changes entries of a State
  kSampling,    ///< the same where a step of length h begins
  kStep         ///< advances a State by a method
};

struct ArrayArgument {
  std::string name;  ///< also of the program's outputs
  std::vector<std::size_t> extents;
};

struct FunctionApi {
  std::string name;
  Result result = Result::kArrays;
  bool takes_input = false, takes_acceleration = false;
  std::vector<ArrayArgument> arrays;  ///< kArrays
  bool symmetric = false;             ///< its array holds outputs [i][j], i ≤ j, in both places
  bool sparse = false;                ///< entries without an output of the program are zero
  std::string structure;              ///< kStruct
  int history = 0;                    ///< kStep: of earlier rates
  bool implicit = false;              ///< kStep: remembers accelerations

  /// As C++ has it, in C with pointers to structs. For number type `real`:
  /// "void k_bar(const Model<Real>&, const State<Real>&, Real (&)[7]) noexcept".
  std::string signature(const Expected& expected, const std::string& real) const;
  /// What the header calls the parameters, in order.
  std::vector<std::string> parameter_names() const;
};

/// Nothing where no function has that name.
std::optional<FunctionApi> api_of(const std::string& name, const Expected& expected);

/// Members of `Linearization`.
std::vector<ArrayArgument> linearization_members(const Expected& expected);

/// Numbers of all outputs together.
std::size_t output_numbers(const Expected& expected);

/// dy/dt is not z.
bool has_rate(const Expected& expected);

/// "close_loops", "project", or empty for trees.
std::string correction_of(const Expected& expected);

}  // namespace jourdain::readback
