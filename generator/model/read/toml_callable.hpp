// Names of what expressions call.
#pragma once

#include <string>

#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// Diagnostics where expressions cannot call `what` (a table, a function) so; the table's key is 'name'.
void check_callable_name(TomlFile& file, const TomlTable& table, const char* what, const std::string& name);

}  // namespace jourdain::model
