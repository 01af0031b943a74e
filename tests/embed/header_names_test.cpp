// No model's or parameter's name clashes with what the C library's headers declare.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <tuple>

#include "agreement/compiled_batch.hpp"
#include "model/names.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// Not <complex.h>, whose I is a good name for an inertia.
std::string includes() {
  std::string text;
  for (const char* header :
       {"cassert", "cctype",  "cerrno",  "cfenv",   "cfloat",   "cinttypes", "climits", "clocale",
        "cmath",   "csetjmp", "csignal", "cstdarg", "cstddef",  "cstdint",   "cstdio",  "cstdlib",
        "cstring", "ctime",   "cuchar",  "cwchar",  "cwctype",  "array",     "vector",  "string",
        "chrono",  "thread",  "fstream", "math.h",  "unistd.h", "iostream"})
    text += fmt::format("#include <{}>\n", header);
  return text;
}

/// Every identifier in the preprocessed headers and among the macros that are defined then; none that are
/// reserved to the compiler.
std::set<std::string> identifiers(const std::string& compiler, const char* standard,
                                  const std::string& file) {
  const std::string text = support::run_process({compiler, standard, "-E", "-P", file}).output + "\n" +
                           support::run_process({compiler, standard, "-E", "-dM", file}).output;
  std::set<std::string> found;
  std::string word;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
      continue;
    }
    if (model::is_identifier(word) && word[0] != '_' && word.find("__") == std::string::npos)
      found.insert(word);
    word.clear();
  }
  return found;
}

using CompilerAndStandard = std::tuple<const char*, const char*>;
class HeaderNames : public testing::TestWithParam<CompilerAndStandard> {};

TEST_P(HeaderNames, ClashWithNoModelAndNoMember) {
  const auto [compiler, standard] = GetParam();
  ASSERT_TRUE(have_compiler(compiler));
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/names.cpp";
  support::write_file(file, includes());
  const std::set<std::string> names = identifiers(compiler, standard, file);
  EXPECT_GT(names.size(), 4000u);
  std::string text = includes();
  std::size_t models = 0, members = 0;
  for (const std::string& name : names) {
    if (model::cpp_name(name) == name)
      text += fmt::format("namespace {} {{ struct Model {{}}; }}  // {}\n", name, ++models);
    if (!model::is_reserved(name))
      text += fmt::format("struct Member{} {{ double {}; }};\n", ++members, name);
  }
  EXPECT_GT(models, 1000u);
  EXPECT_GT(members, 3000u);
  support::write_file(file, text);
  const support::ProcessResult result =
      support::run_process({compiler, standard, "-fsyntax-only", "-w", file});
  EXPECT_EQ(result.status, 0) << result.output.substr(0, 2000);
}

INSTANTIATE_TEST_SUITE_P(Compilers, HeaderNames,
                         testing::Combine(testing::Values("g++", "clang++"),
                                          testing::Values("-std=c++17", "-std=gnu++17", "-std=c++20")),
                         [](const auto& given) {
                           std::string name =
                               std::get<0>(given.param) + std::string(std::get<1>(given.param));
                           std::erase_if(name,
                                         [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

}  // namespace
}  // namespace jourdain::tests
