// Which names may become C++ identifiers, and how others are turned into one.
#pragma once

#include <string>
#include <string_view>

namespace jourdain::model {

/// [A-Za-z_][A-Za-z0-9_]*
bool is_identifier(std::string_view name);

/// A C++17/20/23 keyword, alternative token, or a name that the standard library's C headers define as a macro or
/// that emitted code uses itself at that place (`Real`, `Model`, `State`, `Input`, `Parameters`, `detail`, …); what
/// begins with '_' and a capital, as keywords of C, or with "JOURDAIN_", as macros of emitted files.
bool is_reserved(std::string_view name);

/// No model may have that name: with it an emitted file would declare a name of its own twice, or take the place of
/// another file or of a header of the C library.
bool is_taken_by_files(std::string_view name);

/// Namespace name for a model: every character outside [A-Za-z0-9_] becomes '_', runs of '_' one (identifiers with
/// "__" are reserved), a leading digit or '_' gets the prefix "model_", a reserved word, a
/// name that the C library declares and one that is taken by files get the suffix "_model".
/// Never empty.
std::string cpp_name(std::string_view name);

}  // namespace jourdain::model
