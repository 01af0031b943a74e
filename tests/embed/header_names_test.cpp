// No model's or parameter's name clashes with what the C library's headers declare, nor a model's with these headers
// and with what emitted files call their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "agreement/compiled_batch.hpp"
#include "embed/emit_model.hpp"
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

/// None that are reserved to the compiler.
std::set<std::string> identifiers_of(const std::string& text) {
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

/// Every identifier in the preprocessed headers and among the macros that are defined then.
std::set<std::string> identifiers(const std::string& compiler, const char* standard,
                                  const std::string& file) {
  return identifiers_of(support::run_process({compiler, standard, "-E", "-P", file}).output + "\n" +
                        support::run_process({compiler, standard, "-E", "-dM", file}).output + "\n");
}

std::string without_comments(const std::string& text) {
  static const std::regex comments(R"(/\*([^*]|\*+[^*/])*\*+/|//[^\n]*|"([^"\\\n]|\\.)*")");
  return std::regex_replace(text, comments, " ");
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

/// True in /usr/include, /usr/include/x86_64-linux-gnu and the like, where <NAME.h> is looked for.
bool is_include_folder(const std::filesystem::path& folder) {
  return folder.filename() == "include" || (folder.parent_path().filename() == "include" &&
                                            folder.filename().string().find("-linux-") != std::string::npos);
}

TEST(HeaderFiles, AreFoundThoughTheModelsFolderIsSearchedFirst) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/names.cpp";
  support::write_file(file, includes());
  std::size_t headers = 0;
  for (const char* compiler : {"g++", "clang++"}) {
    std::istringstream words(support::run_process({compiler, "-std=c++20", "-M", file}).output);
    for (std::filesystem::path header; words >> header;) {
      const std::string name = header.stem().string();
      if (header.extension() != ".h" || !is_include_folder(header.parent_path()) || name[0] == '_' ||
          !model::is_identifier(name))
        continue;
      EXPECT_NE(model::cpp_name(name), name) << header;
      ++headers;
    }
  }
  EXPECT_GT(headers, 40u);
}

/// The interface in C with functions of many names, and the templates of what is built upon it, of a model `qq`.
std::string c_text() {
  const support::TemporaryFolder folder;
  emit_model("four_bar", folder.path(),
             {"--name", "qq", "--language", "c", "--interface", "--real", "double", "--functions",
              "constraint_residual,linearize,euler_step,rk4_step,semi_implicit_euler_step,"
              "adams_bashforth2_step,linearly_implicit_euler_step,outputs,center_of_mass_jacobian,momentum,"
              "centroidal_momentum_matrix,centroidal_momentum_bias,close_loops,project,forward_dynamics,"
              "position_rate"});
  std::string text;
  for (const char* name : {"/qq.h", "/qq.c", "/qq_interface.h", "/qq_interface.c"})
    text += support::read_file(folder.path() + name);
  for (const char* kind : {"fmu", "wrap"})
    for (const auto& entry :
         std::filesystem::directory_iterator(JOURDAIN_SOURCE_DIR "/templates/" + std::string(kind)))
      if (entry.path().extension() == ".in") text += support::read_file(entry.path().string());
  return without_comments(std::regex_replace(text, std::regex("@N@|@NAME@"), "qq"));
}

// A model `get` has `get_parameters`.
TEST(EmittedNames, InCBeginLikeThoseOfNoModel) {
  const std::set<std::string> names = identifiers_of(c_text());
  std::set<std::string> beginnings;
  for (const std::string& name : names)
    for (std::size_t i = name.find('_'); i != std::string::npos; i = name.find('_', i + 1))
      if (name.find("qq") == std::string::npos && names.contains("qq" + name.substr(i)))
        beginnings.insert(name.substr(0, i));
  for (const char* known : {"get", "set", "step", "call", "compute", "saved"})
    EXPECT_TRUE(beginnings.contains(known)) << known;
  for (const std::string& beginning : beginnings) EXPECT_NE(model::cpp_name(beginning), beginning);
}

// A model's namespace stands outside of everything, and hides nothing but what is looked for there.
TEST(EmittedNames, InCppAreHiddenByNoModelsNamespace) {
  for (const char* model : {"cart_stops", "wind_turbine", "four_bar"}) {
    const support::TemporaryFolder folder;
    emit_model(model, folder.path(), {"--name", "qq", "--packs"});
    std::string text = "#include <cmath>\n#include <cstring>\n#include <math.h>\n";
    std::size_t count = 0;
    for (const char* file : {"/qq.hpp", "/qq_kernels.hpp"})
      for (const std::string& name :
           identifiers_of(without_comments(support::read_file(folder.path() + file))))
        if (model::cpp_name(name) == name && name != "qq" && name != "JOURDAIN_FUNCTION") {
          text += fmt::format("namespace {} {{}}\n", name);
          ++count;
        }
    EXPECT_GT(count, 50u);
    support::write_file(folder.path() + "/hidden.cpp", text + "#include \"qq.cpp\"\n");
    for (const char* compiler : {"g++", "clang++"}) {
      const support::ProcessResult result = support::run_process(
          {compiler, "-std=c++17", "-fsyntax-only", "-w", folder.path() + "/hidden.cpp"});
      EXPECT_EQ(result.status, 0) << model << "\n" << result.output.substr(0, 2000);
    }
  }
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
