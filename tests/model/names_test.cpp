#include "model/names.hpp"

#include <gtest/gtest.h>

namespace jourdain::model {
namespace {

TEST(IsIdentifier, FollowsCpp) {
  for (const char* good : {"a", "_", "A1_b"}) EXPECT_TRUE(is_identifier(good)) << good;
  for (const char* bad : {"", "1a", "a-b", "a b", "\xc3\xa9"}) EXPECT_FALSE(is_identifier(bad)) << bad;
}

TEST(IsReserved, CoversKeywordsMacrosAndEmittedNames) {
  for (const char* word : {"double", "xor", "co_await", "NAN", "M_PI", "errno", "Real", "detail"})
    EXPECT_TRUE(is_reserved(word)) << word;
  for (const char* word : {"m", "l", "gamma", "real", "arm"}) EXPECT_FALSE(is_reserved(word)) << word;
}

TEST(CppName, MakesANamespaceOfAnyText) {
  EXPECT_EQ(cpp_name("pendulum"), "pendulum");
  EXPECT_EQ(cpp_name("double pendulum (2)"), "double_pendulum_2");
  EXPECT_EQ(cpp_name("a__b"), "a_b");
  EXPECT_EQ(cpp_name("3-bar"), "model_3_bar");
  EXPECT_EQ(cpp_name("_x"), "model_x");
  EXPECT_EQ(cpp_name("double"), "double_model");
  EXPECT_EQ(cpp_name("sin"), "sin_model");
  EXPECT_EQ(cpp_name("time"), "time_model");
  EXPECT_EQ(cpp_name("index"), "index_model");  // the namespace of the emitted indices
  EXPECT_EQ(cpp_name(""), "model");
  EXPECT_EQ(cpp_name("\xc3\xa9"), "model");
}

}  // namespace
}  // namespace jourdain::model
