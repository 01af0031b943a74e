// Options that would have no effect, and numbers that are none, are refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

const std::string kHinge = "models/pendulum.toml";

TEST(Options, OfRobotFilesAreRefusedWhereThereAreNone) {
  expect(jourdain({"check", kHinge, "--no-damping"}), 1,
         "pendulum.toml: error: joint damping can be left out of URDF, SDF and MJCF files only");
  expect(jourdain({"check", kHinge, "--friction"}), 1,
         "joint friction can be asked for with URDF, SDF and MJCF files only");
  expect(jourdain({"check", kHinge, "--no-mimic"}), 1,
         "joints that mimic others can be let free in URDF and SDF files only");
  expect(jourdain({"check", kHinge, "--no-snap"}), 0, "ok: pendulum");
}

TEST(Options, OfRobotFilesAreTakenWhereOneIsImported) {
  const support::TemporaryFolder folder;
  const std::string arm = JOURDAIN_SOURCE_DIR "/tests/data/robots/rail_arm.urdf",
                    cell = folder.path() + "/cell.toml", outer = folder.path() + "/outer.toml";
  support::write_file(cell, "[model]\nname = \"cell\"\n[[import]]\nfile = \"" + arm + "\"\n");
  support::write_file(outer, "[model]\nname = \"outer\"\n[[import]]\nfile = \"cell.toml\"\n");
  for (const std::string& model : {arm, cell, outer})
    EXPECT_EQ(jourdain({"check", model, "--no-damping", "--friction", "--no-mimic"}).status, 0) << model;
}

TEST(Options, OfMimickingJointsAreNotOfMjcf) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/swing.xml";
  support::write_file(model,
                      "<mujoco><worldbody><body name=\"bob\"><joint name=\"hinge\" axis=\"0 1 0\"/>"
                      "<inertial pos=\"0 0 -1\" mass=\"1\" diaginertia=\"1 1 1\"/>"
                      "</body></worldbody></mujoco>\n");
  expect(jourdain({"check", model, "--no-mimic"}), 1, "in URDF and SDF files only");
  EXPECT_EQ(jourdain({"check", model, "--no-damping", "--friction"}).status, 0);
}

TEST(Options, NumbersArePositiveAndFinite) {
  for (const std::string wrong : {"0", "-1", "inf", "nan", "1e999", "fast"}) {
    const std::string message = ": must be positive and finite, not " + wrong;
    expect(jourdain({"fmu", kHinge, "--step", wrong}), 2, "--step" + message);
    expect(jourdain({"simulate", kHinge, "--duration", wrong}), 2, "--duration" + message);
    expect(jourdain({"ensemble", kHinge, "--accuracy", wrong}), 2, "--accuracy" + message);
  }
}

TEST(Options, NamesOfFilesAreNotTooLong) {
  expect(jourdain({"check", kHinge, "--name", std::string(201, 'a')}), 2,
         "--name: a name of 201 characters is too long; there may be 200");
  expect(jourdain({"check", kHinge, "--name", std::string(200, 'a')}), 0, "ok: aaa");
}

TEST(Options, NumbersInARangeAreNumbers) {
  for (const std::string wrong : {"nan", "-1", "1"})
    expect(jourdain({"check", kHinge, "--snap", wrong}), 2,
           "--snap: must be a number from 0 to 0.01, not " + wrong);
  expect(jourdain({"check", kHinge, "--snap", "0"}), 0, "ok");
}

TEST(Options, SeedsAreTakenAsTheyAreOrNotAtAll) {
  for (const std::string wrong : {"-1", "18446744073709551616", "1.5", "x"})
    for (const std::string command : {"ensemble", "bench"})
      expect(jourdain({command, kHinge, "--seed", wrong}), 2,
             "--seed: must be a whole number from 0 to 18446744073709551615, not " + wrong);
}

TEST(Options, MethodsAreOfToolsThatStep) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  expect(jourdain({"wrap", kHinge, "--for", "casadi", "--method", "rk5", "-o", out}), 2,
         "--method is of tools that step, and casadi is given rates");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Options, FunctionsThatASceneHasNotAreTold) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  const auto compile = [&](const std::string& functions, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"compile", kHinge, "-o", out, "--functions", functions});
    return jourdain(more);
  };
  expect(compile("close_loops,project"), 2,
         "error: --functions: 'pendulum' has no close_loops, project, and nothing else is asked for");
  EXPECT_FALSE(std::filesystem::exists(out));
  expect(jourdain({"check", kHinge, "--functions", "project"}), 2, "'pendulum' has no project");
  expect(compile("mass_matrix,project"), 0, "note: --functions: 'pendulum' has no project\n");
  expect(compile("project", {"--frame", "tip=bob:pose"}), 0, "note: --functions: 'pendulum' has no project");
  EXPECT_EQ(compile("mass_matrix").output.find("note:"), std::string::npos);
  const std::string note = "note: --functions: 'pendulum' has no project";
  expect(jourdain({"bench", kHinge, "--blocks", "1", "--states", "1", "--functions", "mass_matrix,project"}),
         0, note);
  expect(jourdain({"python", kHinge, "-o", out, "--functions", "mass_matrix,project"}), 0, note);
  EXPECT_EQ(jourdain({"python", kHinge, "-o", out, "--functions", "mass_matrix"}).output.find("note:"),
            std::string::npos);
}

TEST(Options, DurationsAreWholeStepsOrToldSo) {
  const auto simulate = [](const std::string& duration, const std::string& step) {
    return jourdain({"simulate", kHinge, "--output", "-", "--duration", duration, "--step", step});
  };
  const std::string note =
      "note: --duration 1 is 333.3333333 steps of --step 0.003: 333 are made, up to t = 0.999 s\n";
  expect(simulate("1", "0.003"), 0, note);
  expect(jourdain({"ensemble", kHinge, "--states", "2", "--duration", "1", "--step", "0.003", "--spread",
                   "m=uniform(50%)"}),
         0, note);
  for (const std::string whole : {"0.01", "0.001", "0.0033333333", "0.3333333"})
    EXPECT_EQ(simulate("1", whole).output.find("note:"), std::string::npos) << whole;
  expect(simulate("1", "3"), 2, "is 0.333 steps; between 1 and 1e+09 are possible");
}

TEST(Options, OfParametersSayTheirUnits) {
  for (const std::string command : {"simulate", "ensemble", "report"})
    expect(jourdain({command, "--help"}), 0, "NAME=VALUE, in SI units whatever unit it declares");
  for (const std::string part :
       {"about its value, in SI units whatever unit it declares", "an input (NAME_input)",
        "a share of the value, of parameters and inputs alone that are not zero"})
    expect(jourdain({"ensemble", "--help"}), 0, part);
  expect(jourdain({"report", "--help"}), 0,
         "Longer ones are tried and recommended only where this is not given");
}

}  // namespace
}  // namespace jourdain::tests
