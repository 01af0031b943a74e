#include "support/utf8.hpp"

#include <gtest/gtest.h>

namespace jourdain::support {
namespace {

TEST(Utf8, TellsWellFormedCharactersFromOtherBytes) {
  EXPECT_EQ(utf8_at("a", 0).bytes, 1u);
  EXPECT_EQ(utf8_at("\xc3\xa9", 0).bytes, 2u);
  EXPECT_EQ(utf8_at("\xe2\x82\xac", 0).bytes, 3u);
  EXPECT_EQ(utf8_at("\xf0\x9f\x98\x80", 0).bytes, 4u);
  for (const char* bad :
       {"\x80", "\xc3", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82"}) {
    EXPECT_FALSE(utf8_at(bad, 0).valid) << bad;
    EXPECT_EQ(utf8_at(bad, 0).bytes, 1u);
  }
}

TEST(Utf8, DoesNotPrintControlCharacters) {
  EXPECT_TRUE(utf8_at("~", 0).printable);
  for (const char* control : {"\x1b", "\x7f", "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xae"})
    EXPECT_FALSE(utf8_at(control, 0).printable);
}

}  // namespace
}  // namespace jourdain::support
