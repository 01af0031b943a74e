// The functions that can be emitted. A new one is one line in the table of functions.cpp.
#pragma once

#include <string>
#include <vector>

namespace jourdain::emit {

enum class Shape {
  kState,   ///< returns a State
  kScalar,  ///< returns a Real
  kVector,  ///< fills Real (&)[nz]
  kMatrix,  ///< fills Real (&)[nz][nz]
  kStep     ///< advances a State; its body is a template file, not a program
};

struct FunctionInfo {
  std::string name;
  Shape shape = Shape::kVector;
  std::string result;  ///< name of the array, and of the program's outputs
  bool takes_input = false;
  bool takes_acceleration = false;  ///< Real (&zdot)[nz]
  std::vector<std::string> needs;   ///< functions that its body calls
  std::string comment;              ///< doc comment, lines separated by '\n'
};

/// In the order of emission.
const std::vector<FunctionInfo>& all_functions();

/// Names of all functions; what is emitted unless the user says otherwise.
std::vector<std::string> function_names();

/// `wanted` with the functions they need, in the order of emission.
std::vector<FunctionInfo> with_needed(const std::vector<std::string>& wanted);

}  // namespace jourdain::emit
