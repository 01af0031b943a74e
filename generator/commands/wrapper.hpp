// Emitted C for tools that have interfaces of their own: a C file over the C interface for each. A new tool is a
// template and a row in the list of wrapper.cpp.
#pragma once

#include <string>
#include <vector>

#include "compile/compile.hpp"

namespace jourdain::commands {

struct Wrapper {
  std::string tool;                    ///< on the command line
  std::string suffix;                  ///< of the file: NAME_suffix.c
  std::vector<std::string> functions;  ///< that it calls, and those of steps behind their method
  std::string header;                  ///< of the tool, whose name no model may have; or empty
  bool steps = false;                  ///< by a stepper
  /// Why the tool cannot have the scene; empty where it can.
  std::string (*refusal)(const programs::SceneFacts&) = nullptr;
  /// `step` is the function that it steps by, where it does.
  std::string (*text)(const CompileOptions&, const CompiledModel&, const std::string& title,
                      const std::string& step) = nullptr;
};

const std::vector<Wrapper>& wrappers();

std::vector<std::string> wrapped_tools();

/// Nothing where no tool has the name.
const Wrapper* find_wrapper(const std::string& tool);

}  // namespace jourdain::commands
