// Executes what is emitted from its tree, without any text: what a language needs to know is in the tree.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emit/model_code.hpp"

namespace jourdain::tests {

/// A number, the entries of an array or the members of a struct; what is not there yet is made when asked for, zero.
struct Value {
  double number = 0;
  std::map<long, Value> entries;
  std::map<std::string, Value> members;
};

/// Inputs are held.
class TreeInterpreter {
 public:
  /// The parameters at their defaults.
  TreeInterpreter(const emit::ModelCode& code, const programs::SceneFacts& scene);

  /// Calls an emitted function with arguments in the order of its parameters; `model` goes before them.
  Value call(const std::string& function, const std::vector<Value*>& arguments);

 private:
  class Frame;

  const emit::ModelCode& code_;
  const programs::SceneFacts& scene_;
  std::map<std::string, const emit::Function*> functions_;
  Value parameters_, model_;
};

}  // namespace jourdain::tests
