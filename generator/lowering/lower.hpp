// The one bridge out of GiNaC: symbolic statements to a straight-line program, independent of GiNaC's term order.
#pragma once

#include <string>
#include <vector>

#include "ir/program.hpp"
#include "kinematics/statements.hpp"

namespace jourdain::lowering {

/// One result to compute: entry [row][column] of the array `name` (negative: no such subscript).
struct Target {
  std::string name;
  int row = -1;
  int column = -1;
  kinematics::Ex value;
};

/// What Statements::hold binds: the value itself, or a leaf of that kind.
enum class Held { kValues, kLeaves };

/// Program that computes the targets, from those statements that they need. GiNaC orders terms by hashes that change
/// from run to run; here operands are sorted by a key that depends on the order of declaration alone, and the sign of
/// a sum's first term is pulled out. Numbers are rounded to double once.
ir::Program lower(const kinematics::Statements& statements, const std::vector<Target>& targets,
                  std::string name, Held held = Held::kValues);

}  // namespace jourdain::lowering
