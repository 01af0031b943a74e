#include "model/names.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jourdain::model {
namespace {

TEST(IsIdentifier, FollowsCpp) {
  for (const char* good : {"a", "_", "A1_b"}) EXPECT_TRUE(is_identifier(good)) << good;
  for (const char* bad : {"", "1a", "a-b", "a b", "\xc3\xa9"}) EXPECT_FALSE(is_identifier(bad)) << bad;
}

TEST(IsReserved, CoversKeywordsMacrosAndEmittedNames) {
  for (const char* word : {"double", "xor", "co_await", "typeof", "NAN", "M_PI", "errno", "Real", "detail",
                           "_Bool", "_Static_assert", "JOURDAIN_FUNCTION"})
    EXPECT_TRUE(is_reserved(word)) << word;
  for (const char* word : {"m", "l", "gamma", "real", "arm", "_x"}) EXPECT_FALSE(is_reserved(word)) << word;
}

TEST(CppName, LeavesToFilesAndHeadersWhatTheyAreCalled) {
  const std::vector<std::string> files = {"math", "string",   "stdint", "features", "Math",
                                          "pack", "ensemble", "shim",   "Jourdain"};
  const std::vector<std::string> emitted = {"get",   "step",         "call",       "compute",
                                            "where", "from_literal", "table_entry"};
  const std::vector<std::string> own = {"jourdain_interface", "jourdain_ensemble", "JOURDAIN_FMI2",
                                        "jourdain_status", "jourdain_shim_table"};
  std::vector<std::string> all = files;
  all.insert(all.end(), emitted.begin(), emitted.end());
  all.insert(all.end(), own.begin(), own.end());
  for (const std::string& name : all) {
    EXPECT_TRUE(is_taken_by_files(name)) << name;
    EXPECT_EQ(cpp_name(name), fmt::format("{}_model", name));
    EXPECT_EQ(cpp_name(cpp_name(name)), cpp_name(name)) << name;
  }
  for (const char* name : {"arm", "stepper", "Get", "maths", "model", "jourdain_model", "jourdains"})
    EXPECT_EQ(cpp_name(name), name);
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
