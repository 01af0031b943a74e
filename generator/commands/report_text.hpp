// Tables about a compiled model for the terminal.
#pragma once

#include <string>

#include "compile/compile.hpp"

namespace jourdain::commands {

/// Operations per function by kind, aligned.
std::string operations_table(const ir::Module& module);
/// What of the written files was read back and compared.
std::string readback_text(const readback::Record& record);

std::string verdict_text(const validate::Verdict& verdict);
/// Each function, what it was compared with and how well.
std::string oracles_text(const validate::Verdict& verdict);
/// The programs after a pass, with operations and time.
std::string programs_text(const passes::PassRecord& pass, const ir::Module& module);

/// Operations of functions that are computed at once with others; empty where there are none.
std::string lanes_text(const ir::Module& module);
std::string passes_text(const std::vector<passes::PassRecord>& passes);
std::string omissions_text(const std::vector<Omission>& omissions);

}  // namespace jourdain::commands
