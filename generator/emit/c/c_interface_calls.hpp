// Functions of a model behind the one signature of the C interface: arrays of doubles in and out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "emit/c/spelling.hpp"
#include "ir/module.hpp"
#include "programs/functions.hpp"

namespace jourdain::emit::c {

class InterfaceCalls {
 public:
  /// An array that passes through the interface.
  struct PassedArray {
    std::string name;
    std::size_t rows = 1, columns = 1;
    int dimensions = 0;  ///< 0: a number, 1: a vector, 2: a matrix

    bool is_matrix() const { return dimensions == 2; }
    std::size_t numbers() const { return rows * columns; }
  };

  /// Of the functions that are emitted, each but steps with a program in `module`; all outlive this.
  InterfaceCalls(const CNames& names, const programs::SceneFacts& scene,
                 const std::vector<programs::FunctionInfo>& functions, const ir::Module& module)
      : names_(names), scene_(scene), functions_(functions), module_(module) {}

  /// Those that a call of every function of an instance `self` begins with.
  std::string arguments(const programs::FunctionInfo& function) const;
  /// The function behind the signature of jourdain_function::call.
  std::string call(const programs::FunctionInfo& function) const;
  /// What the table points at: arguments of all functions.
  std::string argument_arrays() const;
  /// Of the table of functions.
  std::string row(const programs::FunctionInfo& function) const;

 private:
  std::vector<PassedArray> results(const programs::FunctionInfo& function) const;
  std::string output_numbers() const;

  const CNames& names_;
  const programs::SceneFacts& scene_;
  const std::vector<programs::FunctionInfo>& functions_;
  const ir::Module& module_;
};

}  // namespace jourdain::emit::c
