// `jourdain ensemble`: what is drawn, where it ends by closed forms, the same numbers however they are cut, misuse.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "commands/ensemble_text.hpp"
#include "commands/run_jourdain.hpp"
#include "jourdain/draws.hpp"
#include "jourdain/stepping.hpp"
#include "programs/steppers.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// A mass on a rail that a damper slows and a force pushes.
constexpr const char* kSlowing = R"(
[model]
name = "slowing"
[parameters]
mass = { value = 2.0, unit = "kg" }
damping = { value = 0.5, unit = "N s/m", range = [0.1, 1.0] }
[[body]]
name = "mass"
mass = "mass"
center_of_mass = [0, 0, 0]
inertia = [0, 0, 0]
[[joint]]
name = "rail"
type = "prismatic"
parent = "world"
child = "mass"
axis = [1, 0, 0]
damping = "damping"
initial_velocity = 3.0
[[actuator]]
joint = "rail"
name = "push"
)";

using Row = std::map<std::string, double>;

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, field;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream fields(line); std::getline(fields, field, ',');) names.push_back(field);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row;
    std::size_t i = 0;
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
      row[names.at(i++)] = std::stod(field);
    EXPECT_EQ(i, names.size()) << line;
    rows.push_back(row);
  }
  return rows;
}

class EnsembleCommand : public testing::Test {
 protected:
  EnsembleCommand() : model_(folder_.path() + "/slowing.toml") { support::write_file(model_, kSlowing); }

  support::ProcessResult run(const std::vector<std::string>& more, const char* step = "0.01") const {
    std::vector<std::string> words = {"ensemble", model_, "--duration", "1", "--step", step};
    words.insert(words.end(), more.begin(), more.end());
    return jourdain(words);
  }
  std::string csv(std::vector<std::string> more) const {
    const std::string file = folder_.path() + "/rows.csv";
    more.insert(more.end(), {"--output", file});
    expect(run(more), 0, "wrote");
    return support::read_file(file);
  }

  support::TemporaryFolder folder_;
  std::string model_;
};

const std::vector<std::string> kSpreads = {"--spread",         "mass=normal(5%)",
                                           "--spread",         "rail_velocity=uniform(2)",
                                           "--spread",         "push_input=normal(0.3)",
                                           "--seed",           "7",
                                           "--states",         "50",
                                           "--constant-input", "1.5"};

TEST_F(EnsembleCommand, StepsWhatItDraws) {
  const std::vector<Row> rows = rows_of(csv(kSpreads));
  ASSERT_EQ(rows.size(), 50u);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Row row = rows[k];
    EXPECT_EQ(row["state"], double(k));
    EXPECT_EQ(row["trusted"], 1);
    EXPECT_DOUBLE_EQ(row["mass"], 2 + 0.1 * normal(7, k, 0));
    EXPECT_DOUBLE_EQ(row["rail_velocity_at_start"], 3 + 2 * (2 * uniform(7, k, 2) - 1));
    EXPECT_DOUBLE_EQ(row["push_input"], 1.5 + 0.3 * normal(7, k, 2));
    const double rate = 0.5 / row["mass"], limit = row["push_input"] / 0.5;
    const double excess = row["rail_velocity_at_start"] - limit, left = std::exp(-rate);
    EXPECT_NEAR(row["rail_velocity"], limit + excess * left, 1e-9) << k;
    EXPECT_NEAR(row["rail"], limit + excess * (1 - left) / rate, 1e-9) << k;
  }
}

TEST_F(EnsembleCommand, GivesTheSameNumbersHoweverItIsCut) {
  const std::string whole = csv(kSpreads);
  std::vector<std::string> threads = kSpreads;
  threads.insert(threads.end(), {"--threads", "3"});
  EXPECT_EQ(csv(threads), whole);
  std::string parts;
  for (int part = 1; part <= 3; ++part) {
    std::vector<std::string> shard = kSpreads;
    shard.insert(shard.end(), {"--shard", fmt::format("{}/3", part)});
    const std::string text = csv(shard);
    const std::size_t header = text.find('\n') + 1;
    parts += part == 1 ? text : text.substr(header);
  }
  EXPECT_EQ(parts, whole);
}

TEST(EnsembleSteppers, HaveTheStagesOfTheirMethods) {
  const auto expect_stages = [](const char* method, int stages) {
    EXPECT_EQ(programs::find_stepper(method)->evaluations, stages) << method;
  };
  expect_stages("euler", euler_stepper::stages);
  expect_stages("semi_implicit_euler", semi_implicit_euler_stepper::stages);
  expect_stages("heun", heun_stepper::stages);
  expect_stages("rk4", rk4_stepper::stages);
  expect_stages("rk5", rk5_stepper::stages);
}

/// Other last digits, the same ones however it is cut.
TEST_F(EnsembleCommand, TurnsSinesWhereAsked) {
  const std::string file = folder_.path() + "/pendulums.csv";
  const auto ends = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"ensemble",   "models/double_pendulum.toml",
                                      "--states",   "21",
                                      "--spread",   "shoulder=normal(0.3)",
                                      "--spread",   "elbow=normal(0.3)",
                                      "--duration", "0.3",
                                      "--step",     "0.002",
                                      "--output",   file};
    words.insert(words.end(), more.begin(), more.end());
    expect(jourdain(words), 0, "wrote");
    return support::read_file(file);
  };
  const std::string computed = ends({}), turned = ends({"--turned-sines"});
  EXPECT_EQ(ends({"--turned-sines", "--threads", "3"}), turned);
  EXPECT_TRUE(turned.ends_with(ends({"--turned-sines", "--shard", "3/3"}).substr(turned.find('\n') + 1)));
  std::vector<Row> left = rows_of(computed), right = rows_of(turned);
  ASSERT_EQ(left.size(), right.size());
  double apart = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    for (const char* column : {"shoulder", "elbow", "shoulder_velocity", "elbow_velocity"}) {
      ASSERT_TRUE(left[k].count(column)) << column;
      apart = std::fmax(apart, std::fabs(left[k][column] - right[k][column]));
    }
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, 1e-13);
  expect(run({"--turned-sines", "--method", "euler"}), 2, "--turned-sines: euler has one stage");
}

TEST_F(EnsembleCommand, PrintsStatisticsOfItsRows) {
  const std::vector<Row> rows = rows_of(csv(kSpreads));
  std::vector<double> ends;
  for (Row row : rows) ends.push_back(row["rail"]);
  const commands::Statistics s = commands::statistics_of(ends);
  expect(run(kSpreads), 0,
         fmt::format("    {:<27}{:>12.5g}{:>12.5g}{:>12.5g}", "rail, m", s.mean, s.deviation, s.least));
}

TEST(EnsembleStatistics, AreThoseOfSamples) {
  const commands::Statistics s = commands::statistics_of({5, 1, 4, 2, 3});
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(s.low, 1.2);
  EXPECT_DOUBLE_EQ(s.high, 4.8);
  EXPECT_EQ(s.least, 1);
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.greatest, 5);
  EXPECT_EQ(commands::statistics_of({0.1}).deviation, 0);
  EXPECT_EQ(commands::statistics_of({0.1, 0.1, 0.1}).deviation, 0);
}

TEST_F(EnsembleCommand, SaysWhatItsStepIsNotGoodFor) {
  expect(run({"--spread", "rail_velocity=normal(1e-9)"}, "1"), 1, "the step is too long");
  expect(run({"--spread", "rail_velocity=normal(1e-9)", "--accuracy", "1e9"}, "1"), 0, "of a deviation");
}

/// Another mass, which is slowed by so many N s/m and by no draw: a step is judged by the size of where it ends.
TEST_F(EnsembleCommand, JudgesWhatNothingSpreadsByItsSize) {
  const auto slowed_by = [this](const char* damping) {
    support::write_file(model_, kSlowing + fmt::format(R"(
[[body]]
name = "other"
mass = 1
[[joint]]
name = "other_rail"
type = "prismatic"
parent = "world"
child = "other"
axis = [1, 0, 0]
damping = {}
initial_velocity = 3.0
)",
                                                       damping));
    return run({"--spread", "rail_velocity=normal(0.3)"}, "0.1");
  };
  expect(slowed_by("2"), 0, "(other_rail_velocity)");
  expect(slowed_by("8"), 1, "the step is too long");
}

TEST_F(EnsembleCommand, SaysWhichStatesAreNotToBeTrusted) {
  std::string stiff = kSlowing;
  stiff.replace(stiff.find("range = [0.1, 1.0]"), 18, "range = [0.1, 1e9]");
  stiff.replace(stiff.find("value = 0.5"), 11, "value = 1e6");
  support::write_file(model_, stiff);
  const std::string file = folder_.path() + "/rows.csv";
  const support::ProcessResult result =
      run({"--spread", "mass=uniform(0.1)", "--states", "20", "--output", file});
  expect(result, 1, "20 of 20 states are not to be trusted: a number is not finite");
  expect(result, 1, "state 0: mass = ");
  for (Row row : rows_of(support::read_file(file))) EXPECT_EQ(row["trusted"], 0);
}

TEST_F(EnsembleCommand, RefusesWhatItCannotDraw) {
  expect(run({"--spread", "masses=normal(1)"}), 2, "did you mean 'mass'?");
  expect(run({"--spread", "mass=gauss(1)"}), 2, "NAME=normal(DEVIATION) or NAME=uniform(HALF) is expected");
  for (const char* word :
       {"mass", "mass=", "mass=normal", "mass=normal(", "mass=normal()", "mass=normal(1", "mass=normal(-1)",
        "mass=normal(nan)", "mass=normal(1)x", "mass=normal(1%", "=normal(1)"})
    EXPECT_EQ(run({"--spread", word}).status, 2) << word;
  expect(run({"--spread", "mass=normal(1)", "--spread", "mass=uniform(1)"}), 2, "it is spread twice");
  expect(run({"--spread", "push_input=normal(5%)"}), 2, "its value is zero, and so is a share of it");
  expect(run({"--spread", "rail=normal(5%)"}), 2, "a share is of a parameter or an input");
  expect(run({"--spread", "mass=normal(300%)"}), 1, "error: --spread draws mass = -");
  expect(run({"--spread", "damping=normal(0.4)"}), 1, "which is outside its range from 0.1 to 1");
  expect(run({"--shard", "3"}), 2, "as in 3/16");
  expect(run({"--shard", "4/3"}), 2, "as in 3/16");
  expect(run({"--shard", "1/2000"}), 2, "with a state for each of 1000 states");
  for (const char* file : {"rows.hdf5", "rows.H5", "rows.txt", "all.h5.old"})
    expect(run({"--output", file}), 2, ".csv or .h5 (HDF5) is expected, or no ending, for CSV");
  expect(run({"--output", "-"}), 2, "the name of a file is expected");
  expect(run({"--inputs", "no.csv"}), 2, "--constant-input and what is spread");
  expect(jourdain({"ensemble", "models/crane.toml", "--spread", "suspension_qw=normal(0.1)"}), 2,
         "it is an entry of a quaternion");
  expect(jourdain({"ensemble", "models/four_bar.toml", "--spread", "rocker=normal(0.1)"}), 2,
         "it follows from others");
}

/// Not of the value that the description has.
TEST_F(EnsembleCommand, NamesTheValueThatADescriptionIsWrongAt) {
  std::string rooted = kSlowing + std::string("[[force]]\njoint = \"rail\"\nvalue = \"rail*sqrt(c)\"\n");
  rooted.replace(rooted.find("[parameters]"), 12, "[parameters]\nc = 1");
  support::write_file(model_, rooted);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--spread", "c=uniform(3)"}, {"--set", "c=-1"}}) {
    const support::ProcessResult result = run(options);
    EXPECT_NE(result.status, 0);
    EXPECT_NE(result.output.find("has no finite value at the parameters' values"), std::string::npos)
        << result.output;
    EXPECT_EQ(result.output.find("default"), std::string::npos) << result.output;
  }
}

TEST_F(EnsembleCommand, NeedsSomethingThatMoves) {
  std::string driven = kSlowing;
  driven.replace(driven.find("initial_velocity = 3.0"), 22, "motion = \"0.1*sin(t)\"");
  driven.erase(driven.find("[[actuator]]"));
  support::write_file(model_, driven);
  expect(run({}), 1, "has no degree of freedom");
}

TEST_F(EnsembleCommand, TellsColumnsApart) {
  std::string named = kSlowing;
  named.replace(named.find("\"rail\""), 6, "\"trusted\"");
  named.replace(named.find("joint = \"rail\""), 14, "joint = \"trusted\"");
  support::write_file(model_, named);
  const std::string text = csv({"--spread", "trusted=normal(0.1)", "--states", "2"});
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "state,trusted_at_start,trusted_at_end,trusted_velocity,trusted");
}

TEST(EnsembleOfLoops, ClosesThem) {
  const support::ProcessResult result =
      jourdain({"ensemble", "models/four_bar.toml", "--real", "float", "--states", "20", "--duration", "0.1",
                "--spread", "crank=normal(0.05)"});
  expect(result, 0, "coupler, rad");
}

/// Projections need more than one from where draws open loops.
TEST(EnsembleOfLoops, ClosesThemWithMultipliers) {
  const support::ProcessResult result =
      jourdain({"ensemble", "models/n_four_bar.toml", "--states", "5", "--duration", "0.1", "--step", "0.01",
                "--spread", "upright0=normal(0.01)"});
  expect(result, 0, "upright0, rad");
}

}  // namespace
}  // namespace jourdain::tests
