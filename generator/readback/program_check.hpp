// Functions of the text against the programs that were validated: the same expressions, operand by operand and
// bit by bit.
#pragma once

#include "readback/expected.hpp"
#include "readback/findings.hpp"
#include "readback/node_table.hpp"
#include "readback/syntax.hpp"

namespace jourdain::readback {

/// Executes every function that has a program over nodes, with leaves for state, inputs, accelerations and the
/// model's members, and the model's constructor with leaves for parameters. All that they write must be the
/// node that the program has for it; what the program has nothing for must be zero where the API says so and
/// untouched otherwise.
void check_programs(const Unit& unit, const Expected& expected, NodeTable& table, Findings& findings);

/// The functions that stand for sin, cos, sqrt and atan2, for double, float and another number type.
void check_library(const Unit& unit, const Expected& expected, Findings& findings);

}  // namespace jourdain::readback
