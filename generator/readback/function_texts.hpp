// Functions beside sines: what the C library calls them, and passages that choose by a comparison, with what they mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::readback {

struct LibraryName {
  std::string_view name;
  ir::Op op;
};

/// <math.h> of double, with an "f" behind them of float, and names that stand for choices in the meaning of passages.
const std::vector<LibraryName>& library_names();

/// What models call them in namespace detail.
const std::vector<LibraryName>& emitted_names();

/// A passage and what is read in its place. A second copy of the text, apart from the templates.
struct ChoosingText {
  const char* name;
  const char* cpp;
  const char* c;  ///< @D@: prefix; @R@: number type; @F@: suffix of numbers
  std::string cpp_meaning, c_meaning;
};

const std::vector<ChoosingText>& choosing_texts();

/// What those call, and what functions that take entries of arrays call.
const char* choice();
const char* entries();

}  // namespace jourdain::readback
