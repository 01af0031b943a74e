// Whole files of C, read as C++ that means the same: structs and functions as templates over the number type, with
// their names as C++ has them.
#pragma once

#include "readback/expression_parser.hpp"
#include "support/files.hpp"

namespace jourdain::readback {

/// Reads a header and its source. Throws Refusal.
void parse_c(Unit& unit, const support::FileText& header, const support::FileText& source, const CText& c);

}  // namespace jourdain::readback
