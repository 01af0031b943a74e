// Names that headers of the C library take.
#pragma once

#include <string_view>

namespace jourdain::model {

/// A macro of a header of the C library or of C++'s own headers for it, or one that compilers define by
/// themselves: no identifier of emitted code may have that name, wherever it stands.
bool is_macro(std::string_view name);

/// A function, type or variable that these headers declare outside all namespaces: no namespace may have that name.
bool is_global_name(std::string_view name);

}  // namespace jourdain::model
