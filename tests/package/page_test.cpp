// The commands of templates/README.md, as they stand there, in clean folders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <vector>

#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kSource = JOURDAIN_SOURCE_DIR;

/// The first block of a language in a page, or one further down.
std::string block(const std::string& page, const std::string& language, int which = 0) {
  const std::string text = support::read_file(kSource + "/" + page);
  const std::string fence = "```" + language + "\n";
  std::size_t begin = text.find(fence) + fence.size();
  for (; which > 0; --which) begin = text.find(fence, begin) + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

/// The numbers behind each name at the begin of a line.
std::map<std::string, std::vector<double>> printed_numbers(const std::string& text) {
  std::map<std::string, std::vector<double>> numbers;
  std::istringstream lines(text);
  for (std::string line, name; std::getline(lines, line);) {
    std::istringstream words(line);
    words >> name;
    for (double number = 0; words >> number;) numbers[name].push_back(number);
  }
  return numbers;
}

/// Positions at the end of a simulation by the installed command.
std::vector<double> simulated(const std::string& model, const std::string& options, std::size_t count) {
  const support::ProcessResult result = run_script(
      kSource + "/models",
      fmt::format("{}/bin/jourdain simulate {}.toml {} --output -", installation(), model, options));
  EXPECT_EQ(result.status, 0) << result.output;
  std::istringstream rows(result.output);
  std::string row, last;
  while (std::getline(rows, row)) last = row;
  std::istringstream entries(last);
  std::vector<double> positions;
  std::getline(entries, row, ',');  // time
  while (positions.size() < count && std::getline(entries, row, ',')) positions.push_back(std::stod(row));
  return positions;
}

/// Where the two mechanisms of the example end, as printed by name.
void expect_as_simulated(const std::string& output, const std::string& panda, const std::string& squeezer,
                         double tolerance) {
  const auto printed = printed_numbers(output);
  for (const auto& [model, options] : {std::pair("panda", panda), std::pair("squeezer", squeezer)}) {
    ASSERT_TRUE(printed.count(model)) << output;
    const std::vector<double>& positions = printed.at(model);
    ASSERT_EQ(positions.size(), 7u);
    const std::vector<double> expected = simulated(model, options, 7);
    ASSERT_EQ(expected.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(positions[i], expected[i], tolerance) << model << i;
  }
}

struct Way {
  const char* name;
  const char* generator;
  const char* example;  ///< folder of tests/embed/examples
};

class Page : public testing::TestWithParam<Way> {};

TEST_P(Page, MakesAProgramThatComputesWhatTheCommandDoes) {
  const auto& [name, generator, example] = GetParam();
  const support::TemporaryFolder folder;
  const support::ProcessResult result = run_script(
      kSource, block("templates/README.md", "sh"),
      {"BUILD=" + build_folder(), "PREFIX=" + folder.path() + "/usr", "PROJECT=" + folder.path() + "/swing",
       std::string("CMAKE_GENERATOR=") + generator, std::string("LANGUAGE=") + example});
  ASSERT_EQ(result.status, 0) << result.output;
  // The same statements in the same order; the command's CSV has 16 digits.
  expect_as_simulated(result.output, "--duration 1 --step 1e-3", "--duration 0.03 --step 1e-5", 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Ways, Page,
                         testing::Values(Way{"Ninja", "Ninja", "cpp"},
                                         Way{"Makefiles", "Unix Makefiles", "cpp"}, Way{"C", "Ninja", "c"}),
                         [](const auto& way) { return way.param.name; });

TEST(Pages, MakeAFirmwareThatComputesWhatTheCommandDoes) {
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(kSource, block("templates/README.md", "sh", 1),
                 {"PREFIX=" + installation(), "FIRMWARE=" + folder.path() + "/swing"});
  ASSERT_EQ(result.status, 0) << result.output;
  // Float on both sides, with sines of two libraries; six decimals are printed.
  expect_as_simulated(result.output, "--duration 0.2 --step 1e-3 --real float",
                      "--duration 0.003 --step 1e-5 --real float", 1e-5);
}

/// Lines that the page shows are those of the example.
TEST(Pages, ShowTheLinesOfTheExample) {
  const std::string example = support::read_file(kSource + "/tests/embed/examples/cpp/CMakeLists.txt");
  std::istringstream lines(block("templates/README.md", "cmake"));
  for (std::string line; std::getline(lines, line);)
    EXPECT_NE(example.find(line + "\n"), std::string::npos) << line;
}

}  // namespace
}  // namespace jourdain::tests
