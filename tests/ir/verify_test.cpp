// Each kind of broken program is named.
#include "ir/verify.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ir/builder.hpp"

namespace jourdain::ir {
namespace {

/// r[0] = −(y[0] z[0]), r[1] = y[0] + 2.
Program sound() {
  Builder b;
  const Signed y = b.leaf(LeafKind::kPosition, 0), z = b.leaf(LeafKind::kVelocity, 0);
  b.output("r", 0, -1, -b.multiply(y, z));
  b.output("r", 1, -1, b.add(y, b.literal(2)));
  return b.finish("p");
}

LeafCounts leaves() {
  LeafCounts counts;
  counts[LeafKind::kPosition] = counts[LeafKind::kVelocity] = 1;
  return counts;
}

/// The only defect of the sound program after a change.
template <class Change>
std::string defect(const Change& change) {
  Program program = sound();
  change(program);
  const std::vector<std::string> found = defects(program, leaves());
  EXPECT_EQ(found.size(), 1u) << print(program);
  return found.empty() ? "" : found[0];
}

TEST(Verify, FindsNothingInASoundProgram) { EXPECT_TRUE(defects(sound(), leaves()).empty()); }

TEST(Verify, NamesOperandsThatDoNotPrecede) {
  EXPECT_EQ(defect([](Program& p) { p.nodes[2].b = ValueId(2); }),
            "p: %2 = mul of %2, which does not precede it");
  EXPECT_EQ(defect([](Program& p) { p.nodes[3].a = ValueId(77); }),
            "p: %3 = neg of %77, which does not precede it");
}

TEST(Verify, NamesLeavesThatTheFunctionDoesNotHave) {
  EXPECT_EQ(defect([](Program& p) { p.nodes[0].index = 1; }), "p: %0 is y[1] of 1");
  EXPECT_EQ(defect([](Program& p) { p.nodes[1].leaf = LeafKind::kMultiplier; }), "p: %1 is lambda[0] of 0");
}

TEST(Verify, NamesLiteralsThatAreNotFinite) {
  EXPECT_EQ(defect([](Program& p) { p.nodes[4].literal = std::numeric_limits<double>::infinity(); }),
            "p: %4 is the literal inf");
}

TEST(Verify, NamesEntriesOfArraysThatAreNoneYet) {
  EXPECT_EQ(defect([](Program& p) { p.nodes[2].op = Op::kEntry; }),
            "p: %2 is an entry of an array that %1 decides, which is no literal");
}

TEST(Verify, NamesCallsThatAreNone) {
  EXPECT_EQ(defect([](Program& p) { p.nodes[2].op = Op::kCall; }),
            "p: %2 calls what %1 decides, which is no literal");
  Program program = sound();
  program.nodes[2].op = Op::kArgument;
  EXPECT_EQ(defects(program, leaves()),
            (std::vector<std::string>{"p: %2 is an argument behind %1, which is none",
                                      "p: %3 takes arguments of a call for a value"}));
}

TEST(Verify, NamesWrongOutputs) {
  EXPECT_EQ(defect([](Program& p) { p.outputs[0].value = ValueId(9); }), "p: output 'r' is %9 of 6");
  EXPECT_EQ(defect([](Program& p) { p.outputs[1].row = 0; }), "p: output 'r' [0][-1] is given twice");
}

TEST(Verify, NamesWhatNothingUses) {
  EXPECT_EQ(defect([](Program& p) { p.outputs[0].value = ValueId(2); }), "p: %3 is used by nothing");
}

TEST(Verify, CountsLabels) {
  EXPECT_EQ(defect([](Program& p) { p.labels.pop_back(); }), "p: 5 labels for 6 values");
}

}  // namespace
}  // namespace jourdain::ir
