#include "support/diagnostics.hpp"

#include <gtest/gtest.h>

namespace jourdain::support {
namespace {

TEST(Diagnostics, UnderlinesTheSourceAndPutsTheHintBehind) {
  Diagnostics diagnostics("arm.toml", "[[joint]]\nchild = \"forarm\"\n");
  diagnostics.error({2, 9, 8}, "joint 'elbow' names unknown body 'forarm'", "did you mean 'forearm'?");
  EXPECT_EQ(diagnostics.format(),
            "arm.toml:2:9: error: joint 'elbow' names unknown body 'forarm'\n"
            "    2 | child = \"forarm\"\n"
            "      |         ^~~~~~~~ did you mean 'forearm'?\n");
}

TEST(Diagnostics, AreSortedByPositionWithoutDuplicates) {
  Diagnostics diagnostics("f", "a\nb\n");
  diagnostics.warning({2, 1, 1}, "second");
  diagnostics.error({1, 1, 1}, "first");
  diagnostics.error({1, 1, 1}, "first");
  diagnostics.note({}, "whole file");
  EXPECT_EQ(diagnostics.format(),
            "f: note: whole file\n"
            "f:1:1: error: first\n    1 | a\n      | ^\n"
            "f:2:1: warning: second\n    2 | b\n      | ^\n");
}

TEST(Diagnostics, OfAnImportedFileShowItsLinesAndWhereItIsImported) {
  Diagnostics inner("c", "see\n"), middle("b", "bee\n"), outer("a", "a\nway\n");
  inner.error({1, 2, 2}, "wrong");
  EXPECT_EQ(middle.absorb(std::move(inner), {1, 3, 1}), 1);
  middle.warning({1, 1, 1}, "odd");
  EXPECT_EQ(outer.absorb(middle, {2, 1, 1}), 1);
  EXPECT_EQ(outer.absorb(middle, {2, 3, 1}), 3);
  outer.error({2, 1, 3}, "own");
  EXPECT_EQ(outer.format(),
            "a:2:1: error: own\n    2 | way\n      | ^~~\n"
            "b:1:1: warning: odd\n    1 | bee\n      | ^\n      | imported at a:2:1\n"
            "c:1:2: error: wrong\n    1 | see\n      |  ^~\n      | imported at b:1:3\n"
            "      | imported at a:2:1\n");
  EXPECT_TRUE(outer.has_errors());
  EXPECT_EQ(outer.line_in_words({1, 1, 1, 2}, {2, 1, 1}), "line 1 of c");
  EXPECT_EQ(outer.line_in_words({1, 1, 1, 2}, {4, 1, 1, 2}), "line 1");
}

TEST(Diagnostics, CountWhatIsNotShown) {
  Diagnostics diagnostics("f", "abc\n");
  for (int i = 1; i <= 3; ++i) diagnostics.error({1, i, 1}, "wrong");
  const std::string text = diagnostics.format(1);
  EXPECT_NE(text.find("f:1:1: error: wrong"), std::string::npos);
  EXPECT_EQ(text.find("f:1:2"), std::string::npos);
  EXPECT_NE(text.find("f: 2 more errors are not shown\n"), std::string::npos);
}

TEST(Diagnostics, OnlyErrorsCountAsErrors) {
  Diagnostics diagnostics("f", "");
  diagnostics.warning({}, "w");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.error({}, "e");
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Diagnostics, ShowControlAndInvalidBytesAsQuestionMarks) {
  Diagnostics diagnostics("f", std::string("a\tb\0\x1b[2J\xff\xc3\xa9!\n", 13));
  diagnostics.error({1, 11, 1}, "here\n\x07");
  EXPECT_EQ(diagnostics.format(), "f:1:11: error: here??\n    1 | a b??[2J?\xc3\xa9!\n      |           ^\n");
}

TEST(Diagnostics, DropTheCarriageReturnOfALine) {
  Diagnostics diagnostics("f", "ab\r\ncd\r\n");
  diagnostics.error({2, 1, 9}, "wrong");
  EXPECT_EQ(diagnostics.format(), "f:2:1: error: wrong\n    2 | cd\n      | ^~\n");
}

TEST(Diagnostics, CutAHugeLineAroundTheCaret) {
  Diagnostics diagnostics("f", std::string(10'000'000, '['));
  diagnostics.error({1, 5'000'000, 3}, "deep");
  diagnostics.error({1, 10'000'000, 1}, "end");
  diagnostics.error({1, 20'000'000, 1}, "behind the end");
  diagnostics.error({7, 1, 1}, "no such line");
  const std::string text = diagnostics.format();
  EXPECT_LT(text.size(), 2000u);
  EXPECT_NE(text.find("    1 | ...[[[["), std::string::npos);
  EXPECT_NE(text.find("[[[...\n"), std::string::npos);
  EXPECT_NE(text.find(std::string(63, ' ') + "^~~\n"), std::string::npos);
}

TEST(Shown, ShortensAndCleansTextForMessages) {
  EXPECT_EQ(shown("plain"), "plain");
  EXPECT_EQ(shown("a\nb"), "a?b");
  EXPECT_EQ(shown(std::string(100, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(shown("\xe2\x80\xae"), "?");  // right-to-left override
}

TEST(Nearest, FindsTypingMistakesOnly) {
  const std::vector<std::string> names{"forearm", "upper_arm", "hand"};
  EXPECT_EQ(nearest("forarm", names), "forearm");
  EXPECT_EQ(nearest("froearm", names), "forearm");
  EXPECT_EQ(nearest("hnad", names), "hand");
  EXPECT_EQ(nearest("leg", names), "");
  EXPECT_EQ(nearest("", names), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest(std::string(1'000'000, 'x'), names), "");
}

TEST(Nearest, PrefersTheNearestAndThenTheFirst) {
  EXPECT_EQ(nearest("joint_3", {"joint_12", "joint_1", "joint_2"}), "joint_1");
}

}  // namespace
}  // namespace jourdain::support
