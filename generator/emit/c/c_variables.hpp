// The table of variables as constants in C.
#pragma once

#include <string>

#include "emit/c/spelling.hpp"
#include "emit/file_text.hpp"

namespace jourdain::emit::c {

/// A string literal.
std::string c_string(const std::string& text);

/// A comment of several lines as one.
std::string in_one_line(std::string comment);

/// Constants of the C interface: `variables`, as jourdain_interface.h describes them, and what these point at.
std::string variable_tables(const ModelText& model, const ir::Module& module);

}  // namespace jourdain::emit::c
