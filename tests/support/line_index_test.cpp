#include "support/line_index.hpp"

#include <gtest/gtest.h>

namespace jourdain::support {
namespace {

TEST(LineIndex, CountsColumnsInCharacters) {
  const std::string text = "ab\n\xc3\xa9 = 1\n";
  const LineIndex lines(text);
  const SourceRange range = lines.range(6, 1);
  EXPECT_EQ(range.line, 2);
  EXPECT_EQ(range.column, 3);
  EXPECT_EQ(lines.offset(2, 3), 6u);
}

TEST(LineIndex, KeepsARangeOnItsLine) {
  const std::string text = "abc\ndef\n";
  const SourceRange range = LineIndex(text).range(1, 100);
  EXPECT_EQ(range.column, 2);
  EXPECT_EQ(range.length, 2);
}

TEST(LineIndex, ToleratesPositionsOutside) {
  const std::string text = "abc";
  const LineIndex lines(text);
  EXPECT_EQ(lines.line(0), "");
  EXPECT_EQ(lines.line(9), "");
  EXPECT_EQ(lines.offset(1, 100), 3u);
  EXPECT_EQ(lines.offset(9, 1), 3u);
  EXPECT_EQ(lines.range(3, 1).column, 4);
}

}  // namespace
}  // namespace jourdain::support
