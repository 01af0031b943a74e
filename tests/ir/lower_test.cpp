#include "lowering/lower.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "kinematics/numbers.hpp"

namespace jourdain::ir {
namespace {

using kinematics::Ex;
using kinematics::Statements;

struct Symbols {
  Statements statements;
  Ex a = statements.leaf(kinematics::LeafKind::kPosition, 0, "a");
  Ex b = statements.leaf(kinematics::LeafKind::kPosition, 1, "b");
  Ex c = statements.leaf(kinematics::LeafKind::kVelocity, 0, "c");
};

std::string lowered(const Symbols& s, const Ex& value) {
  return print(lowering::lower(s.statements, {{"r", -1, -1, value}}, "p"));
}

TEST(Lower, DoesNotDependOnTheOrderOfTerms) {
  Symbols s, t;
  const Ex one = s.a * s.b + s.c * GiNaC::sin(s.a) - 3 * s.b;
  const Ex other = -3 * t.b + GiNaC::sin(t.a) * t.c + t.b * t.a;
  EXPECT_EQ(lowered(s, one), lowered(t, other));
}

TEST(Lower, DoesNotDependOnTheSignPulledOutOfASum) {
  Symbols s, t;
  EXPECT_EQ(lowered(s, s.c * (s.a - s.b) + s.a * (s.b - s.c)),
            lowered(t, t.a * (t.b - t.c) - t.c * (t.b - t.a)));
}

TEST(Lower, DoesNotDependOnTheOrderOfTermsThatStandForAValueAndItsNegative) {
  std::set<std::string> texts;
  for (int run = 0; run < 40; ++run) {  // GiNaC's order of terms changes with the symbols
    Symbols s;
    std::vector<Ex> names(3);
    for (std::size_t k = 0; k < 3; ++k)
      names[(static_cast<std::size_t>(run) + k) % 3] =
          s.statements.bind("n", k == 1 ? -s.a * s.b : s.a * s.b);
    const Ex sum = names[0] + names[1] + names[2] - s.c;
    texts.insert(lowered(s, s.a * sum));
    texts.insert(lowered(s, -s.a * (-names[0] - names[1] - names[2] + s.c)));
  }
  EXPECT_EQ(texts.size(), 1u);
}

TEST(Lower, LeavesOutStatementsThatNobodyNeeds) {
  Symbols s;
  const Ex used = s.statements.bind("used", s.a * s.b);
  s.statements.bind("unused", s.a + s.c);
  EXPECT_EQ(lowered(s, used + s.c),
            "program p\n%0 = y[0]\n%1 = y[1]\n%2 used = mul %0 %1\n%3 = z[0]\n%4 = add %2 %3\nr := %4\n");
}

TEST(Lower, PowersBecomeProductsQuotientsAndRoots) {
  Symbols s;
  const Program program =
      lowering::lower(s.statements, {{"r", -1, -1, GiNaC::pow(s.a, 3) / s.b + GiNaC::sqrt(s.c)}}, "p");
  LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {2, 4};
  leaves[LeafKind::kVelocity] = {9};
  EXPECT_EQ(interpret(program, leaves)[0], 5.0);
}

TEST(Lower, RoundsExactNumbersToTheNearestDouble) {
  Symbols s;
  const auto rounded = [&](const Ex& number) {
    const Program program = lowering::lower(s.statements, {{"r", -1, -1, number}}, "p");
    return interpret(program, LeafValues<double>{})[0];
  };
  EXPECT_EQ(rounded(GiNaC::numeric(1, 3)), 1.0 / 3.0);
  EXPECT_EQ(rounded(GiNaC::numeric(-2, 7)), -2.0 / 7.0);
  for (const double x : {0.1, 3.7e-300, 1e22, -5.5, std::nextafter(1.0, 2.0)})
    EXPECT_EQ(rounded(kinematics::exact(x)), x);
  const Ex ulp = kinematics::exact(0x1p-52);
  EXPECT_EQ(rounded(1 + ulp * GiNaC::numeric(49, 100)), 1.0);
  EXPECT_EQ(rounded(1 + ulp * GiNaC::numeric(51, 100)), 1.0 + 0x1p-52);
  EXPECT_EQ(rounded(kinematics::sine(kinematics::exact(1.0))), std::sin(1.0));
}

}  // namespace
}  // namespace jourdain::ir
