// Reports' pages in a browser: nothing overlaps, nothing fails, the slider moves the picture, the first screen
// says what to do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;

#ifndef JOURDAIN_SANITIZED  // arithmetic in 50 digits is too slow there

const std::string kSource = JOURDAIN_SOURCE_DIR;
constexpr double kFirstScreen = 700;  // pixels

/// What the browser saw at two widths, and what it wrote to its console.
struct Seen {
  json at_1400, at_400;
  std::string console;
};

/// Entities that a serialised <pre> can have.
std::string unescaped(std::string text) {
  for (const auto& [entity, character] :
       {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&nbsp;", " "}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string(entity).size(), character);
  return text;
}

std::string console_lines(const std::string& output) {
  std::string lines;
  for (std::size_t at = 0; (at = output.find(":CONSOLE", at)) != std::string::npos; ++at)
    lines += output.substr(at, output.find('\n', at) - at) + "\n";
  return lines;
}

Seen look_at(const std::string& page, const std::string& folder) {
  const support::ProcessResult result = support::run_process(
      {"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
       "--allow-file-access-from-files", "--user-data-dir=" + folder + "/browser", "--window-size=1900,1200",
       "--enable-logging=stderr", "--v=0", "--virtual-time-budget=20000", "--dump-dom",
       "file://" + kSource + "/tests/report/page_check.html?file://" + page});
  const std::string open = "<pre id=\"findings\">";
  const std::size_t begin = result.output.find(open);
  Seen seen;
  seen.console = console_lines(result.output);
  if (result.status != 0 || begin == std::string::npos) {
    ADD_FAILURE() << "chromium ended with " << result.status << ":\n" << result.output;
    return seen;
  }
  const std::size_t end = result.output.find("</pre>", begin);
  const json findings = json::parse(
      unescaped(result.output.substr(begin + open.size(), end - begin - open.size())), nullptr, false);
  if (!findings.is_array() || findings.size() != 2) {
    ADD_FAILURE() << "the page could not be looked at:\n" << seen.console;
    return seen;
  }
  seen.at_1400 = findings[0];
  seen.at_400 = findings[1];
  return seen;
}

void make_report(const std::string& name, const std::vector<std::string>& more, const std::string& out) {
  std::vector<std::string> command = {JOURDAIN_BINARY, "report", kSource + "/models/" + name + ".toml",
                                      "--tolerance",   "1e-6",   "--effort",
                                      "0.3",           "-o",     out};
  command.insert(command.end(), more.begin(), more.end());
  const support::ProcessResult result = support::run_process(command);
  ASSERT_EQ(result.status, 0) << result.output;
}

void expect_readable(const json& seen, double width, const json& advice) {
  EXPECT_EQ(seen["width"], width);
  EXPECT_LE(seen["scroll_width"].get<double>(), width);
  EXPECT_TRUE(seen["overlaps"].empty()) << seen["overlaps"].dump(1);
  EXPECT_TRUE(seen["labels_outside"].empty()) << seen["labels_outside"].dump(1);
  EXPECT_FALSE(seen["has_nan"].get<bool>());
  EXPECT_EQ(seen["pictures"], 5);
  EXPECT_EQ(seen["clocks"], 5);
  EXPECT_GT(seen["names"].get<int>(), 5);
  const std::string lead = seen["lead"];
  EXPECT_NE(lead.find(advice["method"].get<std::string>()), std::string::npos) << lead;
  EXPECT_NE(lead.find(fmt::format("{:.4g} ms", 1e3 * advice["step_s"].get<double>())), std::string::npos)
      << lead;
  EXPECT_LT(seen["lead_ends"].get<double>(), kFirstScreen);
}

/// A planar tree, one with a quaternion, a closed loop.
class PageOf : public testing::TestWithParam<std::pair<std::string, std::vector<std::string>>> {};

TEST_P(PageOf, IsReadableInABrowser) {
  const auto& [name, options] = GetParam();
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  make_report(name, options, out);
  const json advice = json::parse(support::read_file(out + "/report.json"))["recommendation"];
  const Seen seen = look_at(out + "/report.html", folder.path());
  EXPECT_EQ(seen.console, "");
  ASSERT_FALSE(seen.at_400.is_null());
  expect_readable(seen.at_1400, 1400, advice);
  expect_readable(seen.at_400, 400, advice);
  const std::string page = support::read_file(out + "/report.html");
  EXPECT_LT(page.size(), 500'000u);
  const bool seen_from_the_front = page.find("\"planar\":true") != std::string::npos;
  EXPECT_EQ(seen_from_the_front, name != "lagrange_top");
}

INSTANTIATE_TEST_SUITE_P(
    Models, PageOf,
    testing::Values(
        std::pair{"cart_pole", std::vector<std::string>{}},
        std::pair{"lagrange_top", std::vector<std::string>{"--no-forms", "--methods", "heun,rk4,rodas4"}},
        std::pair{"four_bar", std::vector<std::string>{"--no-forms", "--methods", "heun,rk4,rk5"}}),
    [](const auto& one) { return one.param.first; });

constexpr const char* kAtRest = R"(
[model]
name = "rest"
gravity = [0, 0, 0]
[[body]]
name = "block"
mass = 1
shape = { kind = "box", size = [0.1, 0.2, 0.3] }
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "block"
)";

TEST(Page, DrawsNoPlotWithoutData) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out", model = folder.path() + "/rest.toml";
  support::write_file(model, kAtRest);
  const support::ProcessResult result =
      support::run_process({JOURDAIN_BINARY, "report", model, "--methods", "heun,rk4", "--effort", "0.2",
                            "--no-forms", "-o", out});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string page = support::read_file(out + "/report.html");
  EXPECT_EQ(page.find("id=\"work_precision\""), std::string::npos);
  EXPECT_NE(page.find("no values that its axes can show: Error against run time"), std::string::npos);
  EXPECT_EQ(result.output.find("work_precision.svg"), std::string::npos) << result.output;
  EXPECT_NE(page.find("No step is recommended"), std::string::npos);
}

void replace_once(std::string& text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  ASSERT_NE(at, std::string::npos) << part;
  text.replace(at, part.size(), by);
}

TEST(PageCheck, SeesWhatIsPlanted) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out", broken = folder.path() + "/broken.html";
  make_report("pendulum", {"--no-forms", "--methods", "heun,rk4"}, out);
  std::string page = support::read_file(out + "/report.html");
  replace_once(page, "slider.oninput", "slider.onnothing");
  replace_once(page, "</h1>", "</h1><p style=\"margin-top:-1.6em\">a line across the title</p>");
  replace_once(page, "[rulerName, [20, low - 12]]", "[rulerName, [width - 50, 27]]");
  replace_once(page, "<h2>", "<div style=\"width:3000px\">wide</div><h2>");
  replace_once(page, "requestAnimationFrame(tick);\n</script>", "throw new Error(\"planted\");\n</script>");
  support::write_file(broken, page);
  const Seen seen = look_at(broken, folder.path());
  EXPECT_NE(seen.console.find("planted"), std::string::npos) << seen.console;
  for (const json& at : {seen.at_1400, seen.at_400}) {
    ASSERT_FALSE(at.is_null());
    EXPECT_GT(at["scroll_width"].get<double>(), at["width"].get<double>());
    EXPECT_NE(at["overlaps"].dump().find("a line across the title"), std::string::npos) << at["overlaps"];
    EXPECT_NE(at["overlaps"].dump().find(": g | "), std::string::npos) << at["overlaps"];
    EXPECT_EQ(at["pictures"], 1);
    EXPECT_EQ(at["clocks"], 1);
  }
}

#endif

}  // namespace
}  // namespace jourdain::tests
