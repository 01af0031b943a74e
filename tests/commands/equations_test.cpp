// What `jourdain equations` prints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

TEST(Equations, PrintTheSameTextOnEveryRun) {
  const support::ProcessResult first = jourdain({"equations", "models/double_pendulum.toml", "--latex"});
  expect(first, 0, "2 l_{1} l_{2} m_{2} \\cos(y_{1})");
  EXPECT_EQ(jourdain({"equations", "models/double_pendulum.toml", "--latex"}).output, first.output);
  expect(jourdain({"equations", "models/panda.toml"}), 0, "M[0][6] = ");
}

TEST(Equations, HoldTheNumbersOfTables) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/cam.toml";
  support::write_file(
      model,
      "[model]\nname = \"cam\"\n[[table]]\nname = \"lift\"\nx = [0, 1, 2, 3, 4]\nvalues = [1, 3, 2, 5, 7]\n"
      "[[body]]\nname = \"b\"\nmass = 2\n[[joint]]\nname = \"x\"\ntype = \"prismatic\"\nparent = \"world\"\n"
      "child = \"b\"\n[[force]]\njoint = \"x\"\nvalue = \"lift(x)\"\n");
  const support::ProcessResult plain = jourdain({"equations", model});
  expect(plain, 0, "entry(y0, array1)");
  expect(plain, 0, " = (1, 3, 2, 5)\n");
  expect(plain, 0, " = (2, -1, 3, 2)\n");
  expect(plain, 0, "entry(x, array): that of number floor(x)");
  expect(jourdain({"equations", model, "--latex"}), 0, " &= (2, -1, 3, 2) \\\\\n");
}

/// Parameters called like coordinates and values on the way, and names that LaTeX prints alike.
TEST(Equations, PrintDifferentNamesDifferently) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/arm.toml";
  support::write_file(model,
                      "[model]\nname = \"arm\"\ngravity = [0, 0, -1e-7]\n[parameters]\nc0 = 0.4\ny0 = 2\nl1 "
                      "= 3\nl_1 = 0.5\n[[body]]\n"
                      "name = \"b\"\nmass = \"y0\"\ncenter_of_mass = [\"l1\", 0, 0]\ninertia = [1, 1, "
                      "1]\n[[joint]]\nname = \"x\"\n"
                      "type = \"revolute\"\nparent = \"world\"\nchild = \"b\"\naxis = [0, 1, 0]\ndamping = "
                      "\"c0\"\n[[force]]\n"
                      "joint = \"x\"\nvalue = \"l_1*min(x, l1)*if(x < 0, 1, 0)\"\n");
  const support::ProcessResult plain = jourdain({"equations", model});
  for (const char* line : {"  y0, z0: x\n", "  y0_p: parameter y0\n", "  c0_v = cos(y0)\n", " = c0*z0\n",
                           "y0_p*l1", "  where_negative(a, b): b where a < 0, else 0\n"})
    expect(plain, 0, line);
  EXPECT_EQ(plain.output.find("l_1_p"), std::string::npos);
  const support::ProcessResult latex = jourdain({"equations", model, "--latex"});
  for (const char* line : {"%  y_{0,p}: parameter y0\n", "%  l_{1,p}: parameter l_1\n",
                           "  c_{0,v} &= \\cos(y_{0}) \\\\\n", "10^{-7}"})
    expect(latex, 0, line);
  EXPECT_EQ(latex.output.find("e-07"), std::string::npos);
}

/// As LaTeX prints entries, and as another parameter is printed that makes room.
TEST(Equations, PrintNoParameterAsAnEntry) {
  const support::TemporaryFolder folder;
  const auto latex = [&](const std::string& names, const std::string& mass) {
    const std::string model = folder.path() + "/m.toml";
    support::write_file(
        model,
        "[model]\nname = \"m\"\n[parameters]\n" + names + "[[body]]\nname = \"b\"\nmass = \"" + mass +
            "\"\n[[joint]]\nname = \"x\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\n[[body]]\n"
            "name = \"c\"\nmass = 1\n[[joint]]\nname = \"w\"\ntype = \"prismatic\"\nparent = "
            "\"world\"\nchild = "
            "\"c\"\n[[coupler]]\nname = \"both\"\ncoordinate = \"x\"\nfollows = \"w\"\nratio = 1\n");
    return jourdain({"equations", model, "--latex"});
  };
  const support::ProcessResult entries = latex("g0 = 2\nM0_0 = 3\nG_0_1 = 1\n", "g0*M0_0*G_0_1");
  for (const char* line :
       {"%  g_{0,p}: parameter g0\n", "%  M_{0,0,p}: parameter M0_0\n", "%  G_{0,1,p}: parameter G_0_1\n"})
    expect(entries, 0, line);
  for (const char* names : {"y0 = 2\ny0_p = 3\n", "y0_p = 3\ny0 = 2\n"}) {
    const support::ProcessResult both = latex(names, "y0*y0_p");
    expect(both, 0, "%  y_{0,p2}: parameter y0\n");
    EXPECT_EQ(both.output.find("parameter y0_p"), std::string::npos);
  }
}

/// Of LaTeX, where values on the way have names as entries have.
TEST(Equations, NameNoTwoValuesAlike) {
  for (const char* model :
       {"hoop_bead", "tumbling_body", "servo_arm", "spatial_slider_crank", "rolling_disc"})
    for (const char* form : {"", "--latex"}) {
      std::vector<std::string> command{"equations", fmt::format("models/{}.toml", model)};
      if (*form) command.emplace_back(form);
      const support::ProcessResult result = jourdain(command);
      EXPECT_EQ(result.status, 0);
      std::istringstream lines(result.output);
      std::set<std::string> names;
      std::size_t count = 0;
      for (std::string line; std::getline(lines, line);) {
        const std::size_t end = line.find(*form ? " &= " : " = ");
        if (!line.starts_with("  ") || end == std::string::npos) {
          names.clear();
          continue;
        }
        EXPECT_TRUE(names.insert(line.substr(0, end)).second) << model << form << ": " << line;
        ++count;
      }
      EXPECT_GT(count, 20u) << model;
    }
}

/// Of expanded equations and of values on the way.
TEST(Equations, SayWhatChoices) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/slider.toml";
  support::write_file(
      model,
      "[model]\nname = \"slider\"\n[parameters]\na = 2\nc = 3\n[[body]]\nname = \"b\"\nmass = \"1 + if(a < "
      "1, c, 2)\"\n[[joint]]\nname = \"s\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = "
      "\"b\"\nstiffness = \"max(a, c)*0.5\"\n");
  const support::ProcessResult plain = jourdain({"equations", model});
  const std::string meanings =
      "  where_negative(a, b): b where a < 0, else 0\n  where_not_negative(a, b): 0 where a < 0, else b\n";
  expect(plain, 0, "Expanded\n" + meanings);
  expect(plain, 0, "mass_matrix with named intermediates\n" + meanings);
  expect(plain, 0, " = 1 + where_negative(-1 + a, c) + where_not_negative(-1 + a, 2)\n");
  expect(plain, 0, "0.5*max(a, c)*y0");
  const support::ProcessResult latex = jourdain({"equations", model, "--latex"});
  for (const char* part :
       {"\\left(\\begin{cases} c & -1 + a < 0 \\\\ 0 & \\text{otherwise} \\end{cases}\\right)",
        " &= \\begin{cases} 0 & t_{4} < 0 \\\\ 2 & \\text{otherwise} \\end{cases} \\\\\n",
        "\\operatorname{max}(a, c)"})
    expect(latex, 0, part);
  for (const support::ProcessResult& result : {plain, latex})
    EXPECT_EQ(result.output.find("jourdain_"), std::string::npos) << result.output;
  EXPECT_EQ(latex.output.find("where"), std::string::npos) << latex.output;
}

/// "l 2" would be set as "l2".
TEST(Equations, PutADotBeforeANumberThatFollows) {
  const std::regex number("[A-Za-z0-9})] [0-9]");
  for (const char* model : {"bicycle", "crane", "rolling_ball", "hoop_bead"}) {
    const support::ProcessResult result =
        jourdain({"equations", fmt::format("models/{}.toml", model), "--latex"});
    expect(result, 0, "} \\cdot ");
    std::istringstream lines(result.output);
    for (std::string line; std::getline(lines, line);) {
      if (line.find(" &= ") == std::string::npos) continue;
      const std::string without = std::regex_replace(line, std::regex(R"( \\cdot )"), "*");
      EXPECT_FALSE(std::regex_search(without, number)) << model << ": " << line;
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
