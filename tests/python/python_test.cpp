// `jourdain python`: its modules, by Debian's Python with numpy, and the page about them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using support::ProcessResult;
using testing::HasSubstr;

const std::string kSource = JOURDAIN_SOURCE_DIR;
constexpr const char* kPython = "/usr/bin/python3";

ProcessResult make(const std::string& model, const std::string& folder,
                   const std::vector<std::string>& options = {}) {
  std::vector<std::string> command = {command_folder() + "/jourdain", "python", model, "-o", folder};
  command.insert(command.end(), options.begin(), options.end());
  return support::run_process(command);
}

/// A folder with the modules of some models, for all tests.
const std::string& modules() {
  static const support::TemporaryFolder folder;
  static const bool done = [] {
    const auto made_well = [](const std::string& model, const std::vector<std::string>& options) {
      const ProcessResult made =
          make(fmt::format("{}/models/{}.toml", kSource, model), folder.path(), options);
      EXPECT_EQ(made.status, 0) << made.output;
    };
    for (const char* model : {"panda", "quadrotor", "ur5"}) made_well(model, {});
    for (const char* model :
         {"cart_pole", "crane", "squeezer"}) {  // both ways: a batch, and one state by itself
      made_well(model, {"--packs"});
      made_well(model, {"--name", fmt::format("plain_{}", model)});
    }
    made_well("cart_pole", {"--packs", "--turned-sines", "--name", "turned_cart_pole"});
    return true;
  }();
  (void)done;
  return folder.path();
}

/// A script of tests/python, or `-c` and statements, with the modules on its path. Warnings are errors.
ProcessResult run_python(std::vector<std::string> arguments, const std::string& path) {
  std::vector<std::string> command = {
      "env", "PYTHONPATH=" + path, "PYTHONDONTWRITEBYTECODE=1", kPython, "-W", "error"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

/// Blocks of a language in the page, from the first.
std::vector<std::string> blocks(const std::string& language) {
  const std::string page = support::read_file(kSource + "/runtime/python.md"),
                    fence = "```" + language + "\n";
  std::vector<std::string> list;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    list.push_back(page.substr(at, page.find("\n```", at) + 1 - at));
  }
  return list;
}

/// The number behind a text.
double number_behind(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

TEST(PythonPage, ItsCommandsBalanceAPole) {
  const support::TemporaryFolder folder;
  const ProcessResult result = run_script(
      kSource, blocks("sh").at(0),
      {"BUILD=" + command_folder(), "PROJECT=" + folder.path() + "/balance", "PYTHONDONTWRITEBYTECODE=1"});
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_LT(number_behind(result.output, "closed loop:"), -0.5);
  EXPECT_LT(std::fabs(number_behind(result.output, "leans by")), 0.02);  // from 0.2 rad
}

TEST(PythonPage, ItsBatchIsRunInOneCall) {
  const ProcessResult result = run_python({"-c", blocks("python").at(1)}, modules());
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("10000 runs of 100 steps"));
  EXPECT_LT(std::fabs(number_behind(result.output, "at the end:")), 0.1);
}

TEST(PythonPage, ItsQuadrotorIsTrimmed) {
  const ProcessResult result = run_python({"-c", blocks("python").at(2)}, modules());
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_LT(number_behind(result.output, "accelerations left:"), 1e-9);
  // Drag against weight: tan = 0.02 * 3 / (0.028 * 9.81).
  EXPECT_NEAR(number_behind(result.output, "pitch:"), 12.32, 0.01);
}

TEST(Python, ModulesDoWhatTheyPromise) {
  const ProcessResult result = run_python({kSource + "/tests/python/checks.py"}, modules());
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, testing::ContainsRegex("Ran 2[0-9] tests"));
}

/// Bars of the four-bar become parameters; in closed form the crank stays where it is. Nor does a state that was
/// changed by more than any step changes it stay open. What has no range keeps the value at which loops are proven to
/// close.
TEST(Python, LoopsCloseAtOtherParametersAndStates) {
  for (const char* treatment : {"explicit", "multipliers"}) {
    const support::TemporaryFolder folder;
    std::string model = support::read_file(kSource + "/models/four_bar.toml");
    const auto replace = [&](const std::string& from, const std::string& to) {
      const std::size_t at = model.find(from);
      ASSERT_NE(at, std::string::npos) << from;
      model.replace(at, from.size(), to);
    };
    replace("[parameters]\n",
            "[parameters]\nbar = { value = 0.24, range = [0.23, 0.26] }\nbase = { value = 0.4 }\n");
    replace("position = [0.4, 0, 0]", "position = [\"base\", 0, 0]");
    replace("position = [0.24, 0, 0]", "position = [\"bar\", 0, 0]");
    if (std::string(treatment) == "multipliers")
      replace("treatment = \"explicit\"\nindependent = [\"crank\"]", "treatment = \"multipliers\"");
    support::write_file(folder.path() + "/four_bar.toml", model);
    const ProcessResult made = make(folder.path() + "/four_bar.toml", folder.path());
    ASSERT_EQ(made.status, 0) << made.output;
    const ProcessResult result = run_python({"-c", R"py(
import numpy as np
import four_bar
explicit = hasattr(four_bar.Model, "close_loops")
for bar in (0.24, 0.25, 0.258):
    model = four_bar.Model(bar=bar)
    close = model.close_loops if explicit else model.project
    state = model.initial_state(2)
    assert np.abs(model.constraint_residual(state).g).max() < 1e-10
    assert not explicit or state.y[0, 0] == four_bar.Model().initial_state().y[0]
    model.rk4_step(state, None, 1e-3)
    for change in (0.05, 0.5):
        state = model.initial_state()
        state.y[0] += change
        crank = state.y[0]
        close(state)
        assert np.abs(model.constraint_residual(state).g).max() < 1e-10
        assert not explicit or state.y[0] == crank
        model.rk4_step(state, None, 1e-3)
    state.y[:] = np.array([0, 1, 2])
    state.y[0] = np.nan
    try:
        close(state)
        assert False
    except four_bar.NotFinite:
        pass
try:
    assert np.abs(four_bar.Model(base=0.41).initial_state().y - four_bar.Model().initial_state().y).max() > 1e-3
    assert not explicit
except four_bar.LoopsOpen as problem:
    assert explicit and "not proven to close at these parameters" in str(problem), problem
)py"},
                                            folder.path());
    EXPECT_EQ(result.status, 0) << treatment << result.output;
  }
}

TEST(Python, BatchesInVectorsAreThoseOfScalarCode) {
  const ProcessResult result = run_python({kSource + "/tests/python/packs_checks.py"}, modules());
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, testing::ContainsRegex("Ran 6 tests"));
}

/// One process, two libraries with tables of ensembles of one name: each steps its own.
TEST(Python, ModelsOfOneNameHaveTheirOwnVectors) {
  const support::TemporaryFolder folder;
  std::string scene = support::read_file(kSource + "/models/pendulum.toml");
  const std::size_t gravity = scene.find("-9.81");
  ASSERT_NE(gravity, std::string::npos);
  for (const char* planet : {"earth", "moon"}) {
    const std::string model = fmt::format("{}/{}.toml", folder.path(), planet);
    support::write_file(model, scene);
    const ProcessResult made = make(model, fmt::format("{}/{}", folder.path(), planet), {"--packs"});
    EXPECT_EQ(made.status, 0) << made.output;
    scene.replace(gravity, 5, "-1.62");
  }
  const ProcessResult result = run_python({"-c", R"py(
from earth import pendulum as earth
from moon import pendulum as moon
ends = []
for module in (earth, moon):
    model = module.Model()
    one = model.simulate(model.initial_state(), 1, 1e-3)["pivot"][-1]
    many = model.simulate(model.initial_state(16), 1, 1e-3)["pivot"][0, -1]
    assert one == many, (module, one, many)
    ends.append(one)
assert abs(ends[0] - ends[1]) > 0.1, ends
)py"},
                                          folder.path());
  EXPECT_EQ(result.status, 0) << result.output;
}

struct Run {
  const char* model;
  const char* duration;
  const char* step;
  const char* every;
  const char* method;
  int columns;
};

class Runs : public testing::TestWithParam<Run> {};

TEST_P(Runs, HaveTheNumbersOfTheCommand) {
  const auto& [model, duration, step, every, method, columns] = GetParam();
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/run.csv";
  const ProcessResult simulated = support::run_process(
      {command_folder() + "/jourdain", "simulate", fmt::format("{}/models/{}.toml", kSource, model),
       "--duration", duration, "--step", step, "--every", every, "--method", method, "--output", csv});
  ASSERT_EQ(simulated.status, 0) << simulated.output;
  const ProcessResult compared = run_python(
      {kSource + "/tests/python/compare.py", model, csv, duration, step, every, method}, modules());
  EXPECT_EQ(compared.status, 0) << compared.output;
  EXPECT_THAT(compared.output, HasSubstr(fmt::format("{} columns of 101 rows", columns)));
}

INSTANTIATE_TEST_SUITE_P(Models, Runs,
                         testing::Values(Run{"panda", "1", "0.001", "10", "rk4", 14},
                                         Run{"quadrotor", "1", "0.001", "10", "rk5", 25},
                                         Run{"squeezer", "0.01", "0.00001", "10", "rk4", 20},
                                         Run{"crane", "5", "0.01", "5", "adams_bashforth3", 32}),
                         [](const auto& run) { return run.param.model; });

TEST(Python, TextsOfADescriptionAreNoStatements) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/odd.toml", R"toml(
[model]
name = "odd \"\"\"\nimport sys; sys.exit(3) # \\"
[parameters]
lambda = { value = 2, unit = "kg", description = "a \"quoted\" \\ mass" }
self = 1
[[body]]
name = "b"
mass = "lambda"
center_of_mass = ["self", 0, 0]
inertia = [1, 1, 1]
[[joint]]
name = "j"
type = "revolute"
parent = "world"
child = "b"
axis = [0, 0, 1]
motion = "sin(t)"
[[output]]
name = "needed"
kind = "drive"
joint = "j"
)toml");
  const ProcessResult made = make(folder.path() + "/odd.toml", folder.path(), {"--name", "odd"});
  ASSERT_EQ(made.status, 0) << made.output;
  const ProcessResult result =
      run_python({"-c",
                  "import ast, odd\nast.parse(open(odd.__file__ + 'i').read())\nmodel = "
                  "odd.Model(**{'lambda': 4, 'self': 1.5})\n"
                  "state = model.initial_state()\nmodel.rk4_step(state, None, 0.5)\n"
                  "print(state.y.size, state.t, model.outputs(state)['needed'], model.parameters)"},
                 folder.path());
  EXPECT_THAT(result.output, HasSubstr("0 0.5 -")) << result.output;
  EXPECT_THAT(result.output, HasSubstr("Parameters(lambda=4.0, self=1.5)"));
}

TEST(Python, TheSameFilesAreMadeEveryTime) {
  const support::TemporaryFolder folder;
  std::vector<std::string> texts;
  for (const char* name : {"/a", "/b"}) {
    const ProcessResult made = make(kSource + "/models/pendulum.toml", folder.path() + name);
    ASSERT_EQ(made.status, 0) << made.output;
    for (const char* file : {"/pendulum.py", "/pendulum.pyi", "/libpendulum.so"})
      texts.push_back(support::read_file(folder.path() + name + file));
  }
  ASSERT_EQ(texts.size(), 6u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(texts[k], texts[k + 3]) << k;
}

TEST(Python, WhatCannotBeMadeIsSaidAndNothingIsWritten) {
  const support::TemporaryFolder folder;
  const std::string pendulum = kSource + "/models/pendulum.toml";
  const struct {
    std::vector<std::string> options;
    int status;
    const char* words;
  } cases[] = {
      {{"--name", "lambda"},
       2,
       "'lambda' is a word of Python and no name of a module; choose another with --name"},
      {{"--name", "json"}, 2, "a module 'json' would hide Python's own module"},
      {{"--name", "numpy"}, 2, "a module 'numpy' would hide"},
      {{"--functions", "forwrd"}, 2, "no function 'forwrd'"},
      {{"--packs", "--functions", "forward_dynamics"}, 2, "--packs: none of the functions is a step"},
      {{"--cxx-flags", "-O3"}, 2, "--cxx-flags requires --packs"},
      {{"--turned-sines"}, 2, "--turned-sines requires --packs"},
      {{"--packs", "--cxx-compiler", "no-such-compiler"}, 3, "cannot run 'no-such-compiler'"},
      {{"--compiler", "no-such-compiler"}, 3, "cannot run 'no-such-compiler'"},
      {{"--flags", "--no-such-flag"}, 3, "'cc' fails"}};
  for (const auto& [options, status, words] : cases) {
    const ProcessResult made = make(pendulum, folder.path() + "/module", options);
    EXPECT_EQ(made.status, status) << made.output;
    EXPECT_THAT(made.output, HasSubstr(words));
    EXPECT_FALSE(fs::exists(folder.path() + "/module")) << words;
  }
}

TEST(Python, LibrariesCompileWithoutAWarning) {
  const support::TemporaryFolder folder;
  const std::string warnings = "-O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror";
  for (const char* model : {"pendulum", "squeezer"})
    for (const std::vector<std::string>& compilers :
         {std::vector<std::string>{"gcc", "g++"}, std::vector<std::string>{"clang", "clang++"}}) {
      const ProcessResult made =
          make(fmt::format("{}/models/{}.toml", kSource, model), folder.path(),
               {"--compiler", compilers[0], "--flags", warnings, "--packs", "--cxx-compiler", compilers[1],
                "--cxx-flags", warnings + " -Wno-psabi -march=native"});
      EXPECT_EQ(made.status, 0) << made.output;
    }
}

TEST(Python, FunctionsAndFramesAreThoseAskedFor) {
  const support::TemporaryFolder folder;
  const ProcessResult made =
      make(kSource + "/tests/data/robots/rail_arm.urdf", folder.path(),
           {"--functions", "forward_dynamics", "--frame", "tool=tool:pose,jacobian,velocity"});
  ASSERT_EQ(made.status, 0) << made.output;
  const ProcessResult result =
      run_python({"-c",
                  "import numpy as np, rail_arm\nmodel = rail_arm.Model()\nstate = model.initial_state()\n"
                  "state.z = np.arange(1.0, 1 + state.z.size)\nposition, rotation = model.tool_pose(state)\n"
                  "assert position.shape == (3,) and np.allclose(rotation @ rotation.T, np.eye(3))\n"
                  "assert np.allclose(model.tool_jacobian(state) @ state.z, model.tool_velocity(state))\n"
                  "print([name for name in dir(model) if name[0] != '_'])"},
                 folder.path());
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output,
              HasSubstr("['forward_dynamics', 'initial_state', 'parameters', 'simulate', 'tool_jacobian', "
                        "'tool_pose', 'tool_velocity']"));
}

TEST(Python, KinematicsOfTheDescriptionAreThere) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/swing.toml";
  support::write_file(model, support::read_file(kSource + "/models/pendulum.toml") +
                                 "\n[[kinematics]]\nname = \"tip\"\nframe = \"bob\"\nquantities = "
                                 "[\"pose\"]\n\n[[kinematics]]\nquantities = [\"gravity_compensation\"]\n");
  const ProcessResult made = make(model, folder.path());
  ASSERT_EQ(made.status, 0) << made.output;
  const ProcessResult result = run_python({"-c",
                                           "import pendulum\nmodel = pendulum.Model()\n"
                                           "state = model.initial_state()\n"
                                           "assert abs(model.gravity_compensation(state)[0] - 9.81*"
                                           "__import__('math').sin(state.y[0])) < 1e-12\n"
                                           "position, rotation = model.tip_pose(state)\nprint(position)"},
                                          folder.path());
  EXPECT_EQ(result.status, 0) << result.output;
}

}  // namespace
}  // namespace jourdain::tests
