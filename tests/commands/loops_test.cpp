// Commands on mechanisms with closed loops, as their users meet them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "commands/first_row.hpp"
#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// The slider-crank with a tunable radius of its crank (m), in a file of `folder`.
std::string tunable_slider_crank(const std::string& folder, const std::string& parameter,
                                 const std::string& treatment) {
  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/slider_crank.toml");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("[parameters]\n", "[parameters]\n" + parameter + "\n");
  replace("position = [0.045, 0, 0]\ninitial", "position = [\"radius\", 0, 0]\ninitial");
  replace("treatment = \"explicit\"", "treatment = \"" + treatment + "\"");
  const std::string path = folder + "/slider_crank.toml";
  support::write_file(path, text);
  return path;
}

TEST(LoopCommands, InfoTellsDegreesOfFreedomAndHowLoopsAreClosed) {
  const support::ProcessResult multipliers = jourdain({"info", "models/n_four_bar.toml"});
  for (const char* part : {"loop ", "[planar pin]: ", "5 bodies, 1 degree of freedom\n", "loops: multipliers",
                           "one projection of positions and velocities"})
    expect(multipliers, 0, part);
  expect(jourdain({"info", "models/four_bar.toml"}), 0, "loops: independent: crank; the others");
  expect(jourdain({"check", "models/spring_four_bar.toml"}), 0, "Newton iteration");
}

TEST(LoopCommands, EquationsShowConstraintsAndTheirJacobian) {
  const support::ProcessResult text = jourdain({"equations", "models/four_bar.toml"});
  for (const char* part :
       {"M zdot = k_bar - q_bar - G^T lambda", "  g[0]: pin.", "  g[1] = ", "  G[0][0] = "})
    expect(text, 0, part);
  expect(jourdain({"equations", "models/four_bar.toml", "--latex"}), 0, "  G_{0,0} &= ");
}

TEST(LoopCommands, SimulationsTellHowFarLoopsOpen) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/four_bar.csv";
  const support::ProcessResult result = jourdain(
      {"simulate", "models/four_bar.toml", "--duration", "1", "--outputs", "rocker_angle", "--output", csv});
  expect(result, 0, "loops open by ");
  expect(result, 0, "rocker");
  const std::string text = support::read_file(csv);
  EXPECT_EQ(
      text.substr(0, text.find('\n')),
      "time,crank,coupler,rocker,crank_velocity,kinetic_energy,potential_energy,total_energy,motor_input,"
      "rocker_angle");
}

/// models/four_bar.toml with its crank turned at 6 rad/s: nothing is free.
std::string driven_four_bar(const std::string& folder) {
  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/four_bar.toml");
  const auto replace = [&text](const std::string& from, const std::string& to, const std::string& with) {
    const std::size_t begin = text.find(from), end = text.find(to, begin);
    text.replace(begin, end - begin, with);
  };
  replace("initial_position = \"60*deg\"", "\n\n", "motion = \"60*deg + 6*t\"");
  replace("initial_velocity = -7.45", "\n\n", "");
  replace("initial_velocity = 2.05", "\n\n", "");
  replace("[loops]", "[[output]]", "");
  text += "\n[[output]]\nname = \"torque\"\nkind = \"drive\"\njoint = \"crank\"\n";
  support::write_file(folder + "/driven.toml", text);
  return folder + "/driven.toml";
}

TEST(LoopCommands, AMechanismThatMotionsDetermineIsCheckedAndSimulated) {
  const support::TemporaryFolder folder;
  const std::string path = driven_four_bar(folder.path()), csv = folder.path() + "/driven.csv";
  expect(jourdain({"check", path}), 0, "all coordinates follow from time, in closed form");
  expect(jourdain({"info", path}), 0, "0 degrees of freedom");
  const double turn = 2 * std::acos(-1.0) / 6;
  expect(jourdain({"simulate", path, "--duration", fmt::format("{}", turn), "--step",
                   fmt::format("{}", turn / 100), "--outputs", "torque", "--output", csv}),
         0, "loops open by ");
  const std::string text = support::read_file(csv);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "time,coupler,rocker,kinetic_energy,potential_energy,total_energy,torque");
  const std::vector<double> start = first_row(text),
                            end = first_row(text.substr(text.rfind('\n', text.size() - 2) - 1));
  EXPECT_NEAR(end[2], start[2], 1e-12);  // the rocker is back after a turn
  EXPECT_NEAR(end[3], start[3], 1e-12);
}

/// Alike for longer than is looked at when the model is read.
TEST(LoopCommands, ConstraintsThatContradictEachOtherLaterEndARun) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/twice.toml", csv = folder.path() + "/run.csv";
  support::write_file(path, R"toml([model]
name = "driven_twice"
[[body]]
name = "carriage"
mass = 1
[[body]]
name = "bob"
mass = 1
center_of_mass = [0.5, 0, 0]
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "carriage"
initial_position = 1
[[joint]]
name = "hinge"
type = "revolute"
parent = "carriage"
child = "bob"
axis = [0, 1, 0]
[[loop]]
type = "rod"
from = "world"
to = "carriage"
length = "1 + 0.1*t"
[[loop]]
type = "residual"
residual = "slide - 1 - 0.1*t + 1e-5*t^2"
)toml");
  expect(jourdain({"simulate", path, "--duration", "10", "--step", "0.01", "--output", csv}), 0,
         "loops open by 0.001 m");
  expect(jourdain({"simulate", path, "--duration", "30", "--step", "0.01", "--output", csv}), 1,
         "error: at t = 14.15 s constraints contradict each other");
  expect(jourdain({"report", path, "--duration", "16", "--halvings", "2", "--methods", "rk4", "--no-plots",
                   "--output", folder.path() + "/report"}),
         0, "NOT TO BE TRUSTED from t = 14.14");
}

TEST(LoopCommands, RodsThatShrinkToNothingEndARun) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/rod.toml", csv = folder.path() + "/run.csv";
  support::write_file(path, R"toml([model]
name = "rod"
[[body]]
name = "a"
mass = 1
[[body]]
name = "b"
mass = 1
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "a"
axis = [1, 0, 0]
[[joint]]
name = "y"
type = "prismatic"
parent = "world"
child = "b"
axis = [1, 0, 0]
initial_position = 0.32
[[loop]]
name = "bar"
type = "rod"
from = "a"
to = "b"
length = "0.32 - 0.4*t"
)toml");
  expect(jourdain({"simulate", path, "--duration", "0.7", "--step", "0.003", "--output", csv}), 0, "at t = ");
  expect(jourdain({"simulate", path, "--duration", "1.5", "--step", "0.003", "--output", csv}), 1,
         "the length of loop 'bar' is no longer positive");
  expect(jourdain({"report", path, "--duration", "1.5", "--halvings", "2", "--methods", "rk4", "--no-plots",
                   "--output", folder.path() + "/report"}),
         0, "NOT TO BE TRUSTED from t = 80");
}

/// What near singular positions float leaves of the energy is no motion of the linkage.
TEST(LoopCommands, RunsWhoseEnergyIsLostFail) {
  const support::TemporaryFolder folder;
  const std::vector<std::string> run = {"simulate", "models/double_pendulum.toml", "--method",  "euler",
                                        "--output", folder.path() + "/run.csv",    "--duration"};
  const auto over = [&](const char* duration, const char* step) {
    std::vector<std::string> arguments = run;
    arguments.insert(arguments.end(), {duration, "--step", step});
    return jourdain(arguments);
  };
  expect(over("10", "0.01"), 1, "error: the energy, which nothing changes, drifted by");
  expect(over("1", "1e-4"), 0, "drift");
}

TEST(LoopCommands, LoopsAreClosedAgainAtOtherParameters) {
  const support::TemporaryFolder folder;
  const std::string path = tunable_slider_crank(folder.path(), "radius = 0.045", "partitioned"),
                    csv = folder.path() + "/run.csv";
  constexpr double kRadius = 0.05, kRod = 0.145, kOffset = 0.006;
  expect(jourdain({"simulate", path, "--set", "radius=0.05", "--duration", "0.01", "--step", "1e-5",
                   "--output", csv}),
         0, "loops open by ");
  const std::vector<double> start = first_row(support::read_file(csv));
  const double crank = start[1], piston = start[3];
  const double along = kRadius * std::cos(crank), across = kRadius * std::sin(crank) - kOffset;
  EXPECT_NEAR(piston, along + std::sqrt(kRod * kRod - across * across), 1e-12);
}

/// Initial values that are expressions of parameters, of states too, and what is told where loops move them.
TEST(LoopCommands, StartsFollowParameters) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/run.csv";
  const auto run = [&](const std::string& model, const std::string& setting) {
    return jourdain(
        {"simulate", model, "--set", setting, "--duration", "0.01", "--step", "1e-3", "--output", csv});
  };
  const support::ProcessResult bicycle = run("models/bicycle.toml", "speed=6");
  expect(bicycle, 0, "loops open by ");
  EXPECT_NEAR(at_start(support::read_file(csv), "root_vx_velocity"), 6, 1e-12);
  EXPECT_NEAR(at_start(support::read_file(csv), "rear_velocity"), -6 / 0.3, 1e-11);
  EXPECT_NEAR(at_start(support::read_file(csv), "front_velocity"), -6 / 0.35, 1e-11);

  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/tests/steppers/led_crank.toml");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("[[input]]", "[parameters]\nfirst = { value = 0.3, unit = \"rad\" }\n\n[[input]]");
  replace("initial = 0.3", "initial = \"first\"");
  const std::string path = folder.path() + "/crank.toml";
  support::write_file(path, text);
  expect(run(path, "first=1"), 0, "loops open by ");
  const double sine = std::sin(1.0);
  EXPECT_NEAR(at_start(support::read_file(csv), "bore"),
              0.1 * std::cos(1.0) + std::sqrt(0.36 - 0.01 * sine * sine) - 0.6, 1e-12);

  replace("motion = \"angle\"", "initial_position = \"first\"");
  text.resize(text.find("[[output]]"));  // of the motion's drive
  support::write_file(path, text + "[loops]\ntreatment = \"multipliers\"\n");
  expect(run(path, "first=1"), 0, "loops open by ");
  EXPECT_EQ(at_start(support::read_file(csv), "shaft"), 1);

  replace("child = \"rod\"", "child = \"rod\"\ninitial_position = \"-first\"");
  support::write_file(path, text + "[loops]\ntreatment = \"multipliers\"\n");
  expect(run(path, "first=1"), 0, "note: the loops close with big_end = ");
}

/// Initial values that are numbers stay where settings change what the loops are made of.
TEST(LoopCommands, GivenStartsStayWhereOtherParametersAreSet) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/run.csv";
  expect(jourdain({"simulate", "models/bicycle.toml", "--set", "front_radius=0.45", "--duration", "0.001",
                   "--output", csv}),
         0, "note: at these parameters the loops close with front's velocity = -11.11111111 instead of ");
  EXPECT_NEAR(at_start(support::read_file(csv), "root_vx_velocity"), 5, 1e-12);
  EXPECT_NEAR(at_start(support::read_file(csv), "rear_velocity"), -5 / 0.3, 1e-11);

  const auto slider_crank = [&](const std::string& radius) {
    const std::string path = tunable_slider_crank(folder.path(), "radius = " + radius, "multipliers");
    std::string text = support::read_file(path);
    for (const std::string given : {"independent = [\"crank\"]", "initial_velocity = -127.05236997436154",
                                    "initial_velocity = -2.6963641045771576"})
      text.replace(text.find(given), given.size(), "");
    support::write_file(path, text);
    return path;
  };
  const auto crank = [&](const std::vector<std::string>& command) {
    std::vector<std::string> words = command;
    for (const char* word : {"--duration", "1e-9", "--step", "1e-9", "--output"}) words.emplace_back(word);
    words.push_back(csv);
    expect(jourdain(words), 0, "");
    return at_start(support::read_file(csv), "crank");
  };
  const double written = crank({"simulate", slider_crank("0.1")});
  const std::string path = slider_crank("0.045");
  EXPECT_GT(std::fabs(crank({"simulate", path}) - written), 1e-3);
  EXPECT_EQ(crank({"simulate", path, "--set", "radius=0.1"}), written);
  EXPECT_NEAR(crank({"ensemble", path, "--set", "radius=0.1", "--states", "2"}), written, 1e-6);
  expect(jourdain({"simulate", tunable_slider_crank(folder.path(), "radius = 0.045", "explicit"), "--set",
                   "radius=0.1", "--duration", "1e-3", "--output", csv}),
         0, "note: at these parameters the loops close with rod's velocity = ");
  slider_crank("0.045");
  expect(jourdain({"ensemble", path, "--spread", "radius=normal(1%)", "--states", "2", "--duration", "1e-3"}),
         0, "note: drawn states close their loops by the least change, weighed by masses");
}

TEST(LoopCommands, ParametersAtWhichLoopsAreNotProvenToCloseAreRefused) {
  const support::TemporaryFolder folder;
  for (const std::string treatment : {"partitioned", "explicit"}) {
    const std::string path = tunable_slider_crank(folder.path(), "radius = 0.045", treatment);
    // At 0.139 m it is as long as the rod, less the offset: the crank no longer turns round.
    for (const std::string command : {"simulate", "report"})
      expect(jourdain({command, path, "--set", "radius=0.14", "--duration", "0.01"}), 2,
             "error: --set: the loops are not proven to close at radius = 0.14: ");
    expect(jourdain({"simulate", path, "--set", "radius=0.1", "--duration", "0.01", "--output",
                     folder.path() + "/run.csv"}),
           0, "loops open by ");
  }
}

TEST(LoopCommands, ParametersOutsideTheirRangeAreRefused) {
  const support::TemporaryFolder folder;
  const std::string path =
      tunable_slider_crank(folder.path(), "radius = { value = 0.045, range = [0.03, 0.1] }", "explicit");
  expect(jourdain({"simulate", path, "--set", "radius=0.11", "--duration", "0.01"}), 2,
         "error: --set radius=0.11: 'radius' is outside its range from 0.03 to 0.1");
  expect(jourdain({"simulate", path, "--set", "radius=0.1", "--duration", "0.01", "--output",
                   folder.path() + "/run.csv"}),
         0, "loops open by ");
  expect(jourdain({"info", path}), 0, "    radius ");
  expect(jourdain({"info", path}), 0, "  0.03 to 0.1\n");
}

TEST(LoopCommands, AMotionCannotBeFollowed) {
  const support::TemporaryFolder folder;
  const std::string scenario = folder.path() + "/follow.toml";
  support::write_file(scenario, "[follow]\ncrank = \"t\"\n");
  expect(jourdain({"simulate", "models/four_bar.toml", "--inputs", scenario, "--output",
                   folder.path() + "/x.csv"}),
         1, "closed loops cannot follow a motion");
}

/// A model of models/ with pieces of its text replaced, in a file of `folder`.
std::string changed_model(const std::string& folder, const std::string& name,
                          const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/" + name);
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  const std::string path = folder + "/" + name;
  support::write_file(path, text);
  return path;
}

TEST(LoopCommands, ARunEndsWhereTheMechanismIsSingularUnlessMultipliersAreAskedFor) {
  const support::TemporaryFolder folder;
  const std::string left_to_the_tool =
      changed_model(folder.path(), "n_four_bar.toml", {{"[loops]\ntreatment = \"multipliers\"", ""}});
  for (const std::string step : {"1e-3", "1e-4"})
    expect(jourdain({"simulate", left_to_the_tool, "--duration", "2", "--step", step, "--output",
                     folder.path() + "/o.csv"}),
           1, "error: at t = 0.71");
  expect(jourdain(
             {"simulate", "models/n_four_bar.toml", "--duration", "2", "--output", folder.path() + "/o.csv"}),
         0, "loops open by ");
}

TEST(LoopCommands, ARunEndsWhereDependentCoordinatesTurnSingular) {
  const support::TemporaryFolder folder;
  const std::string rocker = changed_model(folder.path(), "four_bar.toml",
                                           {{"treatment = \"explicit\"", "treatment = \"partitioned\""},
                                            {"independent = [\"crank\"]", "independent = [\"rocker\"]"}});
  const auto result = jourdain({"simulate", rocker, "--duration", "5", "--output", folder.path() + "/o.csv"});
  expect(result, 1, "warning: it is not proven that the other coordinates follow");
  expect(result, 1, "the other coordinates no longer follow from rocker");
}

TEST(LoopCommands, ARunEndsWhereACoordinateLeavesTheRangeOfTheProof) {
  const support::TemporaryFolder folder;
  const std::string by_newton =
      changed_model(folder.path(), "spring_four_bar.toml", {{"range = [0.5, 2.95]", "range = [1.7, 1.8]"}});
  expect(jourdain({"simulate", by_newton, "--duration", "2", "--output", folder.path() + "/o.csv"}), 1,
         "leaves its range [1.7, 1.8]");
  const std::string in_closed_form =
      changed_model(folder.path(), "four_bar.toml",
                    {{"initial_velocity = \"2*pi\"", "initial_velocity = \"2*pi\"\nrange = [1, 1.2]"}});
  expect(jourdain({"simulate", in_closed_form, "--duration", "2", "--output", folder.path() + "/o.csv"}), 1,
         "leaves its range [1, 1.2]");
}

TEST(LoopCommands, ARunEndsWhereAStepIsLongerThanWhatIsProven) {
  const support::TemporaryFolder folder;
  const std::string path = changed_model(folder.path(), "double_wishbone.toml",
                                         {{", range = [0, 0.05]", ""}, {", range = [0, 30]", ""}});
  support::write_file(path, support::read_file(path) + "\n[loops]\ntreatment = \"partitioned\"\n");
  const auto run = [&](const std::string& step) {
    return jourdain({"simulate", path, "--method", "euler", "--step", step, "--duration", "1", "--output",
                     folder.path() + "/o.csv"});
  };
  expect(run("0.02"), 1,
         "error: at t = 0.02 s a step of 0.02 s is too long: closing the loops moved positions");
  expect(run("1e-3"), 0, "loops open by ");
}

TEST(LoopCommands, ARunEndsWhereAStepAcrossASingularConfigurationOpensTheLoops) {
  const support::TemporaryFolder folder;
  std::string text =
      support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/tests/steppers/rocking_four_bar.toml");
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("initial_velocity = 3", "");
  replace("\"60*deg\"", "1.2094575703763197");  // closed where the coupler is 0.9 m long
  replace("\"-67.3*deg\"", "-1.2910015745463281");
  replace("\"114*deg\"", "1.3507743610537664");
  support::write_file(folder.path() + "/rocking.toml", text);
  const auto run = [&](const std::string& step) {
    return jourdain({"simulate", folder.path() + "/rocking.toml", "--set", "length=0.9", "--duration", "2",
                     "--step", step, "--output", folder.path() + "/o.csv"});
  };
  const support::ProcessResult too_long = run("1e-3");
  expect(too_long, 1, "closing the loops leaves them open by ");
  expect(too_long, 1, "a step of 0.001 s is too long (take a shorter one)");
  expect(run("5e-5"), 0, "loops open by ");
}

/// A heavy body that a rod locks stays where it is, though what hangs on it weighs a four millionth.
TEST(LoopCommands, MultipliersHoldHeavyBodiesBesideLightOnes) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/run.csv";
  expect(jourdain({"simulate", "tests/loops/scenes/far_apart.toml", "--duration", "0.1", "--output", csv}), 0,
         "loops open by ");
  const std::string text = support::read_file(csv);
  EXPECT_LT(std::fabs(at_start(text, "turning.omega_dot[2]")), 1e-12);
  const std::string last =
      text.substr(0, text.find('\n') + 1) + text.substr(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_LT(std::fabs(at_start(last, "turning.omega_dot[2]")), 1e-12);
  EXPECT_NEAR(at_start(last, "crank"), at_start(text, "crank"), 1e-12);
}

/// Light couplers hold a crank and a rocker together: by how much less than they are held at all.
TEST(LoopCommands, MultipliersGoAsIndependentCoordinatesDoOrRefuse) {
  const support::TemporaryFolder folder;
  const std::string text = support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/four_bar.toml");
  const auto run = [&](const std::string& mass, const std::string& treatment) {
    std::string model = text;
    const auto replace = [&model](const std::string& from, const std::string& to) {
      model.replace(model.find(from), from.size(), to);
    };
    replace("mass = 0.72", "mass = " + mass);
    replace("treatment = \"explicit\"\nindependent = [\"crank\"]", "treatment = \"" + treatment + "\"");
    support::write_file(folder.path() + "/four_bar.toml", model);
    return jourdain({"simulate", folder.path() + "/four_bar.toml", "--duration", "1", "--output",
                     folder.path() + "/" + treatment + ".csv"});
  };
  for (const std::string mass : {"1e-5", "1e-9"}) {
    std::vector<double> last;
    for (const std::string treatment : {"explicit", "multipliers"}) {
      expect(run(mass, treatment), 0, "");
      const std::string csv = support::read_file(folder.path() + "/" + treatment + ".csv");
      last.push_back(std::stod(csv.substr(csv.find(',', csv.rfind('\n', csv.size() - 2)) + 1)));
    }
    EXPECT_NEAR(last[0], last[1], 1e-8) << mass;
  }
  expect(run("1e-13", "explicit"), 0, "");
  expect(run("1e-13", "multipliers"), 1, "error: multipliers cannot hold these constraints");
}

TEST(LoopCommands, HeadersSayForWhichParametersLoopsAreProven) {
  const support::TemporaryFolder folder;
  const auto header = [&](const std::string& parameter, const std::string& treatment) {
    expect(jourdain({"compile", tunable_slider_crank(folder.path(), parameter, treatment), "-o",
                     folder.path(), "--name", "model"}),
           0, "");
    return support::read_file(folder.path() + "/model.hpp") +
           support::read_file(folder.path() + "/model.json");
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in\n" << text;
  };
  const std::string ranged = "radius = { value = 0.045, range = [0.03, 0.1] }";
  for (const std::string treatment : {"partitioned", "explicit"}) {
    has(header(ranged, treatment), "parameters.radius >= Real(0.03) && parameters.radius <= Real(0.1)");
    has(header(ranged, treatment), "\"proven_parameters\": {\"radius\": [0.03, 0.1]}");
    has(header("radius = 0.045", treatment),
        "parameters.radius >= Real(0.045) && parameters.radius <= Real(0.045)");
  }
  const std::string multipliers =
      support::read_file(std::string(JOURDAIN_EMITTED) + "/n_four_bar/n_four_bar.hpp");
  EXPECT_EQ(multipliers.find("loops_proven"), std::string::npos);
}

#ifndef JOURDAIN_SANITIZED  // a report takes minutes there; report_tests make others
TEST(LoopCommands, ReportsSayWhereLoopsTurnSingularAndRecommendNothing) {
  const support::TemporaryFolder folder;
  const std::string left_to_the_tool =
      changed_model(folder.path(), "n_four_bar.toml", {{"[loops]\ntreatment = \"multipliers\"", ""}});
  const auto result =
      jourdain({"report", left_to_the_tool, "--duration", "1s", "--methods", "rk4", "--longest-step", "4ms",
                "--halvings", "2", "--tolerance", "1e-6", "-o", folder.path()});
  expect(result, 0, "NOT TO BE TRUSTED from t = 7");
  expect(result, 0, "no recommendation, the loops' closing turns singular");
}
#endif

constexpr const char* kExplicit = "treatment = \"explicit\"\nindependent = [\"crank\"]\n";

/// A crank that has gone round 50 times: float rounds its angle by more than what is open at an angle of 1.
TEST(LoopCommands, FloatsOfLargeAnglesAreNotTakenForOpenLoops) {
  const support::TemporaryFolder folder;
  const std::string model =
      changed_model(folder.path(), "four_bar.toml",
                    {{kExplicit, "treatment = \"multipliers\"\n"}, {"60*deg", "60*deg + 100*pi"}});
  for (const char* real : {"float", "double"})
    expect(jourdain(
               {"simulate", model, "--real", real, "--duration", "5", "--output", folder.path() + "/x.csv"}),
           0, "rocker");
}

/// A coupler that weighs 10^7 times the other bars: accelerations in float were 7 % off.
TEST(LoopCommands, ConstraintsThatFloatDoesNotDiscernAreRefused) {
  const support::TemporaryFolder folder;
  const std::string output = folder.path() + "/out";
  const auto describe = [&](const std::string& bars, const std::string& treatment) {
    return changed_model(folder.path(), "four_bar.toml",
                         {{kExplicit, treatment},
                          {"mass = 0.24", "mass = " + bars},
                          {"mass = 0.48", "mass = " + bars},
                          {"mass = 0.72", "mass = 1000.0"}});
  };
  const std::string hardly = "in float multipliers hardly tell the weakest constraint from rounding (",
                    multipliers = "treatment = \"multipliers\"\n", told = "warning: " + hardly;
  std::string model = describe("0.0001", multipliers);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check"}, {"compile", "-o", output}, {"simulate"}, {"ensemble"}}) {
    std::vector<std::string> words = command;
    words.insert(words.begin() + 1, {model, "--real", "float"});
    expect(jourdain(words), 1, "four_bar.toml:");
    expect(jourdain(words), 1, ": error: " + hardly);
    EXPECT_FALSE(std::filesystem::exists(output));
  }
  expect(jourdain({"compile", model, "-o", output}), 0, told);
  EXPECT_EQ(jourdain({"check", model, "--real", "double"}).output.find(hardly), std::string::npos);
  model = describe("0.0001", kExplicit);
  EXPECT_EQ(jourdain({"check", model, "--real", "float"}).output.find(hardly), std::string::npos);
  model = describe("100.0", multipliers);
  expect(jourdain({"check", model, "--real", "float"}), 0, "ok: ");
}

TEST(LoopCommands, FloatIsNamedWhereItIsTooCoarse) {
  expect(
      jourdain({"simulate", "models/n_four_bar.toml", "--real", "float", "--duration", "1", "--step", "0.001",
                "--output", "-"}),
      1,
      "a step of 0.001 s is too long (take a shorter one), float is too coarse there (run it in double), or");
}

}  // namespace
}  // namespace jourdain::tests
