// What files in C for one number type call things.
#pragma once

#include <cstddef>
#include <string>

#include "emit/tree.hpp"

namespace jourdain::emit::c {

struct CNames {
  std::string model;  ///< as C++ would have it
  bool is_float = false;

  /// Of the files, without their ending: the model's name, with "_f" where numbers are floats.
  std::string file() const { return is_float ? model + "_f" : model; }
  std::string global(const std::string& name) const { return file() + "_" + name; }
  /// Of what the source alone uses.
  std::string internal(const std::string& name) const { return global("detail_" + name); }

  const char* real() const { return is_float ? "float" : "double"; }
  /// Behind the names of functions of the C library.
  const char* suffix() const { return is_float ? "f" : ""; }
  /// Shortest decimal that reads back as `value`, rounded to the number type.
  std::string digits(double value) const;
  /// The same; negative ones are in parentheses.
  std::string literal(double value) const;

  /// "panda_state"; structs of steps are internal.
  std::string type(const Type& type) const;
  std::string count(const char* what) const { return global(std::string(what) + "_count"); }
};

/// Is it one that steps alone use? Then nothing is constant in C, which has no constant arrays of arrays.
bool is_internal(const Type& type);

/// A doc comment of one or more lines.
std::string c_doc(const std::string& content, std::size_t indent);

/// A comment of one or more lines.
std::string c_comment(const std::string& content, std::size_t indent);

/// `text` without what would end or begin a comment, or spell a trigraph.
std::string c_safe(const std::string& text);

}  // namespace jourdain::emit::c
