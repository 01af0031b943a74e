// What reading back found, and what it looked at.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::readback {

/// Operations of one call of a step and how often it called what it steps.
struct StepCost {
  std::size_t operations = 0;
  int evaluations = 0;
};

struct Findings {
  std::vector<std::string> differences;  ///< sentences
  std::map<std::string, ir::Operations>
      counts;  ///< executed by one call, by function; "model": by the constructor
  std::map<std::string, StepCost> steps;
  std::size_t numbers = 0;  ///< results compared
  std::size_t points = 0;   ///< at which steps were compared with their methods

  template <class... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    differences.push_back(fmt::format(format, std::forward<Arguments>(arguments)...));
  }
  /// `found` must equal `wanted`.
  template <class A, class B>
  void expect(const std::string& what, const A& found, const B& wanted) {
    if (!(found == wanted)) add("{} is '{}', must be '{}'", what, found, wanted);
  }
  /// Runs `check`; what it throws is a difference.
  template <class Check>
  void guarded(const std::string& what, Check&& check) {
    try {
      check();
    } catch (const std::exception& error) {
      add("{}: {}", what, error.what());
    }
  }
};

}  // namespace jourdain::readback
