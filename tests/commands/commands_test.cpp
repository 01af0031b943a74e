// The command line as its users meet it: exit statuses, messages, files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "commands/run_jourdain.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  return fs::exists(folder) ? std::size_t(std::distance(fs::directory_iterator(folder), {})) : 0;
}

TEST(CommandLine, NoLanesComputesLimbsOneAfterTheOther) {
  const support::TemporaryFolder folder;
  const auto text_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> command = {"compile", "models/quadruped.toml", "-o", folder.path()};
    command.insert(command.end(), options.begin(), options.end());
    expect(jourdain(command), 0, "read back");
    return support::read_file(folder.path() + "/quadruped_kernels.hpp");
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(text_of({}), "detail::Lanes<4, Real>"));
  EXPECT_FALSE(has(text_of({"--no-lanes"}), "detail::Lanes"));
  expect(jourdain({"compile", "models/quadruped.toml", "-o", folder.path(), "--explain"}), 0,
         "lanes (operations that go with those of limbs that are alike)");
}

TEST(CommandLine, ExitStatusSaysWhoIsWrong) {
  const support::TemporaryFolder folder;
  expect(jourdain({"compile", "models/nothing.toml", "-o", folder.path()}), 3, "models/nothing.toml");
  expect(jourdain({"compile", "models", "-o", folder.path()}), 3, "folder");
  expect(jourdain({"compile", "models/panda.toml", "-o", folder.path(), "--functions", "mass_matrx"}), 2,
         "did you mean 'mass_matrix'");
  expect(jourdain({"compile", "models/panda.toml", "-o", folder.path(), "--name", "namespace"}), 2,
         "reserved");
  expect(jourdain({"compile", "models/panda.toml", "-o", folder.path(), "--name", "get"}), 2,
         "try 'get_model'");
  expect(jourdain({"compile", "models/panda.toml", "-o", folder.path(), "--name", "a b"}), 2, "identifier");
  expect(jourdain({"frobnicate"}), 2, "frobnicate");
  expect(jourdain({}), 2, "subcommand");
  expect(jourdain({"--version"}), 0, "jourdain 0.1.0");
  expect(jourdain({"compile", "--help"}), 0, "--functions");
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(CommandLine, StepsThatRememberNothingAreEmitted) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/moved.toml", R"toml([model]
name = "moved"
[[body]]
name = "b"
mass = 2
[[joint]]
name = "j"
type = "prismatic"
parent = "world"
child = "b"
motion = "0.1*sin(20*t)"
)toml");
  for (const char* language : {"c++", "c"})
    expect(jourdain({"compile", folder.path() + "/moved.toml", "-o", folder.path(), "--language", language,
                     "--functions", "adams_bashforth2_step,adams_bashforth3_step"}),
           0, "read back");
  const support::ProcessResult compiled = support::run_process(
      {"g++", "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", folder.path() + "/moved.cpp"});
  EXPECT_EQ(compiled.status, 0) << compiled.output;
}

TEST(CommandLine, OptionsOfSeveralValuesLeaveTheModelAlone) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/arm.urdf", R"(<robot name="arm">
  <link name="base"/>
  <link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="c"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="j1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="j2" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
  <joint name="j3" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint>
</robot>)");
  const std::string arm = folder.path() + "/arm.urdf";
  expect(jourdain({"check", "--lock", "j1", "j2", arm}), 0, "1 degree of freedom");
  expect(jourdain({"check", "--lock", "j1,j2", arm}), 0, "1 degree of freedom");
  expect(jourdain({"check", arm, "--lock", "j1", "j2"}), 0, "1 degree of freedom");
  expect(jourdain({"compile", "--functions", "mass_matrix", "k_bar", arm, "-o", folder.path() + "/out"}), 0,
         "");
  EXPECT_EQ(files_in(folder.path() + "/out"), 4u);
  expect(jourdain({"simulate", "--constant-input", "0", "1", "-2", arm, "--duration", "0.01", "--output",
                   folder.path() + "/a.csv"}),
         0, "wrote");
}

TEST(Compile, WritesTheSameBytesFromWhereverItIsCalled) {
  const support::TemporaryFolder folder;
  const std::string models = JOURDAIN_SOURCE_DIR + std::string("/models");
  const auto from = [&](const std::string& where, const std::string& path, const std::string& out) {
    const auto result = support::run_process(
        {"env", "-C", where, JOURDAIN_BINARY, "compile", path, "-o", folder.path() + "/" + out});
    EXPECT_EQ(result.status, 0) << result.output;
    std::string text;
    for (const char* file : {"pendulum.hpp", "pendulum_kernels.hpp", "pendulum.cpp", "pendulum.json"})
      text += support::read_file(folder.path() + "/" + out + "/" + file);
    return text;
  };
  const std::string there = from(models, "pendulum.toml", "a");
  EXPECT_EQ(from(JOURDAIN_SOURCE_DIR, "models/pendulum.toml", "b"), there);
  EXPECT_EQ(from(folder.path(), models + "/pendulum.toml", "c"), there);
}

TEST(CommandLine, EveryMalformedModelEndsWithStatusOne) {
  int models = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(JOURDAIN_SOURCE_DIR) / "tests/diagnostics/cases")) {
    fs::path expected = entry.path();
    if (!entry.is_regular_file() || expected.extension() == ".expected") continue;
    expected.replace_extension(".expected");
    const bool wrong = support::read_file(expected.string()).find(" error: ") != std::string::npos;
    const bool options = support::read_file(entry.path().string()).find("options:") != std::string::npos;
    if (!wrong || options) continue;
    const support::ProcessResult result = jourdain({"check", entry.path().string()});
    EXPECT_EQ(result.status, 1) << entry.path().filename() << "\n" << result.output;
    EXPECT_NE(result.output.find(" error: "), std::string::npos) << entry.path().filename();
    ++models;
  }
  EXPECT_GT(models, 100);
}

TEST(CommandLine, AForceWithoutAValueAtTheStartIsTheModelsFault) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/start.toml";
  const auto check = [&](const std::string& value) {
    support::write_file(
        file,
        "[model]\nname = \"start\"\n[[body]]\nname = \"b\"\nmass = 1\ninertia = [1, 1, 1]\n"
        "[[joint]]\nname = \"hinge\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"b\"\n"
        "[[force]]\njoint = \"hinge\"\nvalue = \"" +
            value + "\"\n");
    return jourdain({"check", file});
  };
  for (const std::string value :
       {"1/hinge", "sqrt(-1 - hinge^2)", "min(1/hinge^2, 3)", "max(3, 1/hinge^2)", "if(1/hinge^2 > 3, 1, 2)",
        "exp(-1/hinge^2)", "1/(1 + 1/hinge)", "atan(1/hinge)", "sign(log(hinge^2))"})
    expect(check(value), 1, "force 'force1' has no finite value at the initial state");
  expect(check("if(hinge^2 > 0, min(1/hinge^2, 3), 0)"), 0, "ok: start");
}

TEST(CommandLine, AStartInAGimbalsLockIsTheModelsFault) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/gimbal.toml";
  const auto check = [&](const std::string& arm, const std::string& angle) {
    support::write_file(
        file, "[model]\nname = \"gimbal\"\n[[body]]\nname = \"b\"\nmass = 1\ncenter_of_mass = " + arm +
                  "\n[[joint]]\nname = \"cross\"\ntype = \"universal\"\nparent = \"world\"\n"
                  "child = \"b\"\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 0]\n"
                  "second = { initial_position = \"" +
                  angle + "\" }\n");
    return jourdain({"check", file});
  };
  const std::string message = "joint 'cross' moves no inertia at the initial state";
  expect(check("[0, 0, 1]", "0"), 1, message);
  expect(check("[0, 1, 0]", "90*deg"), 1, message);
  expect(check("[0, 0, 1]", "1e-9"), 0, "ok: gimbal");
  expect(check("[0, 1, 0]", "0"), 0, "ok: gimbal");
}

TEST(CommandLine, AMotionThatEndsIsValidatedWhereItIsDefined) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/motion.toml";
  support::write_file(
      file,
      "[model]\nname = \"motion\"\n[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"slide\"\n"
      "type = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\nmotion = \"sqrt(0.3 - t)\"\n"
      "[[output]]\nname = \"force\"\nkind = \"drive\"\njoint = \"slide\"\n");
  expect(jourdain({"check", file}), 0, "ok: motion");
}

/// Header that `linearize` leaves of a description with an output added.
std::string linearised(const std::string& description, const std::string& output) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/scene.toml";
  support::write_file(
      file, description + "\n[[output]]\nname = \"h\"\nkind = \"expression\"\nvalue = \"" + output + "\"\n");
  expect(jourdain({"compile", file, "--name", "scene", "--functions",
                   "linearize,outputs,initial_state,rk4_step,rodas4_step", "-o", folder.path()}),
         0, "validated");
  return support::read_file(folder.path() + "/scene.hpp");
}

TEST(CommandLine, OutputsMayDependOnTimeWhereTheDynamicsDoNot) {
  const auto contains = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  for (const std::string model : {"pendulum", "four_bar", "spring_four_bar"}) {
    const std::string description =
        support::read_file(JOURDAIN_SOURCE_DIR + std::string("/models/") + model + ".toml");
    const std::string of_time = linearised(description, "t^2 + 3*t"), of_none = linearised(description, "2");
    EXPECT_TRUE(contains(of_time, "  Real output_t[") && contains(of_time, "+ output_t dt")) << model;
    EXPECT_FALSE(contains(of_time, "rate_t")) << model;
    EXPECT_FALSE(contains(of_none, "output_t")) << model;
  }
}

TEST(CommandLine, AFolderThatCannotBeMadeIsTheEnvironmentsFault) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/file";
  support::write_file(file, "in the way");
  expect(jourdain({"compile", "models/pendulum.toml", "-o", file + "/inside"}), 3, "inside");
}

TEST(CommandLine, ADenormalNumberIsANumber) {
  const support::TemporaryFolder folder;
  const std::string file = folder.path() + "/small.toml";
  support::write_file(file,
                      "[model]\nname = \"small\"\n[[body]]\nname = \"b\"\nmass = 1\n"
                      "[[joint]]\nname = \"slide\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\n"
                      "stiffness = 1e-310\n");
  expect(jourdain({"check", file}), 0, "ok: small");
}

TEST(Compile, WritesFourFiles) {
  const support::TemporaryFolder folder;
  expect(jourdain({"compile", "models/pendulum.toml", "-o", folder.path() + "/new/p", "--name", "swing"}), 0,
         "1 degree of freedom");
  for (const char* file : {"swing.hpp", "swing_kernels.hpp", "swing.cpp", "swing.json"})
    EXPECT_TRUE(fs::exists(fs::path(folder.path()) / "new/p" / file)) << file;
}

TEST(Compile, WritesCForTheNumberTypesThatAreAskedFor) {
  const auto names = [](const std::vector<std::string>& options) {
    const support::TemporaryFolder folder;
    std::vector<std::string> command = {"compile", "models/pendulum.toml", "-o", folder.path()};
    command.insert(command.end(), options.begin(), options.end());
    expect(jourdain(command), 0, "the same as validated");
    std::string text;
    for (const char* name : {"pendulum.h", "pendulum.c", "pendulum_f.h", "pendulum_f.c", "pendulum.json"})
      if (fs::exists(folder.path() + "/" + name)) text += std::string(name) + " ";
    EXPECT_EQ(files_in(folder.path()), static_cast<std::size_t>(std::count(text.begin(), text.end(), ' ')));
    return text;
  };
  EXPECT_EQ(names({"--language", "c"}), "pendulum.h pendulum.c pendulum_f.h pendulum_f.c pendulum.json ");
  EXPECT_EQ(names({"--language", "c", "--real", "double"}), "pendulum.h pendulum.c pendulum.json ");
  EXPECT_EQ(names({"--language", "c", "--real", "float"}), "pendulum_f.h pendulum_f.c pendulum.json ");
}

TEST(Compile, NamesTheLanguagesThatThereAre) {
  const support::TemporaryFolder folder;
  const auto compile = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"compile", "models/pendulum.toml", "-o", folder.path()});
    return jourdain(options);
  };
  expect(compile({"--language", "pascal"}), 2, "{c++,c}");
  expect(compile({"--real", "half"}), 2, "{float,double,both}");
  expect(compile({"--language", "c", "--packs"}), 2, "--packs is of C++");
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(Compile, RefusesFloatsInCThatAConstantIsBeyond) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/heavy.toml";
  support::write_file(
      model,
      "[model]\nname = \"heavy\"\n[[body]]\nname = \"b\"\nmass = 1e39\n[[joint]]\nname = \"j\"\n"
      "type = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\n");
  expect(jourdain({"compile", model, "-o", folder.path() + "/c", "--language", "c"}), 1,
         "the range of float");
  expect(jourdain({"compile", model, "-o", folder.path() + "/c", "--language", "c", "--real", "double"}), 0,
         "wrote");
}

/// C++'s floats are beside doubles, unless they are what is asked for.
TEST(Compile, TellsNumbersThatFloatHasNoRoomFor) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/scene.toml";
  const auto run = [&](const std::string& mass, std::vector<std::string> options) {
    support::write_file(
        model, "[model]\nname = \"scene\"\n[parameters]\nm = " + mass +
                   "\n[[body]]\nname = \"b\"\nmass = " + (options.back() == "tunable" ? "\"m\"" : mass) +
                   "\n[[joint]]\nname = \"j\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"b\"\n");
    options.pop_back();
    options.insert(options.begin() + 1, model);
    return jourdain(options);
  };
  for (const auto& [mass, what] :
       {std::pair("1e39", "is beyond the range of float"), std::pair("1e-60", "is zero in float"),
        std::pair("1e-39", "has few digits in float")}) {
    const std::string constant = std::string(", ") + what, error = ": error: a constant of the equations, ";
    const support::ProcessResult both = run(mass, {"check", "fixed"});
    expect(both, 0, "note: a constant of the equations, ");
    expect(both, 0, constant);
    EXPECT_EQ(run(mass, {"check", "--real", "double", "fixed"}).output.find("note:"), std::string::npos);
    expect(run(mass, {"check", "--real", "float", "fixed"}), 1, error);
  }
  expect(run("1e39", {"check", "--real", "float", "tunable"}), 1,
         "error: parameter 'm', 1e+39, is beyond the range");
  for (const char* command : {"simulate", "ensemble", "cost"})
    expect(run("1e-60", {command, "--real", "float", "fixed"}), 1, "is zero in float");
  expect(run("1e-60", {"report", "-o", folder.path() + "/out", "--real", "float", "fixed"}), 1,
         "is zero in float");
}

TEST(Options, OfRunsInFloatAreNumbersThatFloatHasRoomFor) {
  const auto run = [](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"simulate", "models/cart_pole.toml", "--duration", "0.1", "--step", "0.01"});
    return jourdain(options);
  };
  expect(run({"--real", "float", "--set", "pole_mass=1e-42"}), 2,
         "error: --set pole_mass=1e-42: 1e-42 has few digits in float");
  expect(run({"--real", "float", "--set", "cart_mass=1e39"}), 2, "1e+39 is beyond the range of float");
  expect(run({"--real", "float", "--constant-input", "1e39"}), 2,
         "error: --constant-input: 1e+39 is beyond the range of float");
  expect(run({"--set", "pole_mass=1e-42"}), 0, "hinge");
}

TEST(Compile, EmitsOnlyWhatWasAskedFor) {
  const support::TemporaryFolder folder;
  expect(jourdain({"compile", "models/pendulum.toml", "-o", folder.path(), "--functions", "rk4_step",
                   "--explain"}),
         0, "hoist");
  const std::string header = support::read_file(folder.path() + "/pendulum.hpp");
  EXPECT_NE(header.find("void forward_dynamics"), std::string::npos);
  EXPECT_NE(header.find("void rk4_step"), std::string::npos);
  EXPECT_EQ(header.find("void mass_matrix"), std::string::npos);
  EXPECT_EQ(header.find("initial_state("), std::string::npos);
}

TEST(Compile, ShowsTheProgramsAfterAPass) {
  const support::TemporaryFolder folder;
  const auto dump = [&](const std::string& option) {
    return jourdain(
        {"compile", option, "models/pendulum.toml", "-o", folder.path(), "--functions", "k_bar,q_bar"});
  };
  const support::ProcessResult one = dump("--dump-ir=hoist"), all = dump("--dump-ir");
  expect(one, 0, "# hoist, round 1: ");
  expect(one, 0, "program k_bar\n%0 = 0\nk[0] := %0\n");
  EXPECT_EQ(one.output.find("# factor"), std::string::npos);
  for (const char* pass : {"# lower\n", "# factor, round 1", "# hoist, round 2"}) expect(all, 0, pass);
  expect(dump("--dump-ir=fator"), 2, "no pass 'fator'; there are all, lower, split_angles");
}

TEST(Compile, AWrongModelWritesNothing) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/wrong.toml", out = folder.path() + "/out";
  support::write_file(
      model,
      "[model]\nname = \"wrong\"\n[[body]]\nname = \"a\"\nmass = -1\n[[joint]]\nname = \"j\"\n"
      "type = \"revolute\"\nparent = \"world\"\nchild = \"a\"\n");
  expect(jourdain({"compile", model, "-o", out}), 1, "wrong.toml:5:8: error");
  EXPECT_EQ(files_in(out), 0u);
}

TEST(Compile, AJointThatMovesNoInertiaIsNamed) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/light.toml";
  support::write_file(
      model,
      "[model]\nname = \"light\"\n[[body]]\nname = \"a\"\nmass = 0\n[[joint]]\nname = \"idle\"\n"
      "type = \"revolute\"\nparent = \"world\"\nchild = \"a\"\n");
  const support::ProcessResult result = jourdain({"check", model});
  expect(result, 1, "joint 'idle' moves no inertia");
  expect(result, 1, "not lost in rounding beside the others");
}

/// Of a wheel that lies flat the depth is zero, but for the last digits, wherever it goes.
TEST(Compile, WhatIsNearAKinkWhereverItGoesIsNoFaultOfTheCompiler) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/flat.toml";
  support::write_file(
      model,
      "[model]\nname = \"flat\"\n[[body]]\nname = \"b\"\nmass = 0.5\n[[joint]]\nname = \"j\"\ntype = "
      "\"prismatic\"\nparent = \"world\"\nchild = \"b\"\nposition = [0, 0.5, 0.3]\naxis = [1, 2, 0]\n"
      "[[tyre]]\nname = \"ty\"\nframe = \"b\"\nradius = 0.4\npoint = [0, 0, -0.1]\nstiffness = 200\n"
      "friction = 1\nrelaxation_length = 0.3\nstiffness_factor = [3, 4]\nshape_factor = [1.6, 1.3]\n");
  const auto result = jourdain({"compile", model, "-o", folder.path() + "/out"});
  expect(result, 1, "flat.toml:1:1: error: refused to emit: ");
  expect(result, 1, "is within rounding of zero at all states that were drawn, ");
  EXPECT_EQ(files_in(folder.path() + "/out"), 0u);
}

TEST(Check, WhatHasNoFiniteValuesIsPlaced) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/huge.toml";
  const auto place = [&](const std::string& gravity, const std::string& mass, const std::string& joint) {
    support::write_file(model, "[model]\nname = \"huge\"\ngravity = [0, 0, " + gravity +
                                   "]\n[[body]]\nname = \"a\"\nmass = " + mass +
                                   "\n[[joint]]\nname = \"j\"\nparent = \"world\"\nchild = \"a\"\n" + joint);
    return jourdain({"check", model});
  };
  const std::string slide = "type = \"prismatic\"\n",
                    pushed = "[[force]]\nframe = \"a\"\nforce = [0, 0, 1e308]\n";
  const std::string message = ": error: the mechanism's equations have no finite values at the initial state";
  expect(place("-9.81", "1e308", slide), 1, "huge.toml:6:8" + message);
  expect(place("1.7976931348623157e308", "8", slide), 1, "huge.toml:6:8" + message);
  expect(place("0", "0.01", slide + pushed), 1, "huge.toml:13:9: error: force");
  expect(place("0", "10", slide + pushed), 0, "ok");
}

/// 1/m is a double, whose further digits are none.
TEST(Check, ConstantsWithoutDigitsAreNoFaultOfTheCompiler) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/slide.toml";
  const auto check = [&](const std::string& mass) {
    support::write_file(model, "[model]\nname = \"slide\"\n[[body]]\nname = \"a\"\nmass = " + mass +
                                   "\n[[joint]]\nname = \"j\"\nparent = \"world\"\nchild = \"a\"\n"
                                   "type = \"prismatic\"\nstiffness = 100\ndamping = 1000\n");
    return jourdain({"check", model});
  };
  for (const char* mass : {"1e285", "1e290", "1e306"})
    expect(check(mass), 1,
           "so near to the end of the range of double that too few digits are left to validate it");
  for (const char* mass : {"1e280", "1e-308"}) expect(check(mass), 0, "ok: slide");
}

TEST(CommandLine, MessagesShowNoControlCharacters) {
  expect(jourdain({"compile", "m.toml", "-o", "out", "--name", "a\x1b[31m"}), 2, "'a?[31m' is not");
  expect(jourdain({"\x1b[31m"}), 2, "no command '?[31m'");
  expect(jourdain({"check", "\x1b[31m.toml"}), 3, "?[31m.toml");
}

TEST(Check, SaysOkInOneLine) {
  const support::ProcessResult result = jourdain({"check", "models/panda.toml"});
  expect(result, 0, "ok: panda: ");
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1);
}

TEST(Simulate, WritesAHeaderAndARowForEachInterval) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/p.csv";
  expect(jourdain({"simulate", "models/pendulum.toml", "--duration", "1", "--step", "0.001", "--every", "100",
                   "--output", csv}),
         0, "1000 steps");
  std::istringstream lines(support::read_file(csv));
  std::string header, row, last;
  std::getline(lines, header);
  EXPECT_EQ(header, "time,pivot,pivot_velocity,kinetic_energy,potential_energy,total_energy");
  int rows = 0;
  for (; std::getline(lines, row); ++rows) last = row;
  EXPECT_EQ(rows, 11);
  EXPECT_EQ(last.substr(0, 2), "1,");
  EXPECT_NEAR(std::stod(last.substr(last.rfind(',') + 1)), 0, 1e-9);  // released level with the pivot
}

TEST(Simulate, WritesInputsAndOutputs) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/f.csv";
  const auto written = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"simulate", "models/four_bar.toml", "--duration", "0.5", "--output",
                                          csv,        "--constant-input",     "0.25"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect(jourdain(arguments), 0, "wrote");
    std::istringstream lines(support::read_file(csv));
    std::vector<std::map<std::string, double>> rows;
    std::vector<std::string> names;
    for (std::string line, entry; std::getline(lines, line);) {
      std::istringstream entries(line);
      if (names.empty()) {
        while (std::getline(entries, entry, ',')) names.push_back(entry);
        continue;
      }
      std::map<std::string, double>& row = rows.emplace_back();
      for (std::size_t i = 0; std::getline(entries, entry, ','); ++i) row[names.at(i)] = std::stod(entry);
      EXPECT_EQ(row.size(), names.size());
    }
    return rows;
  };
  const auto rows = written({});
  ASSERT_EQ(rows.size(), 51u);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("motor_input"), 0.25);
    EXPECT_NEAR(row.at("rocker_angle"), row.at("rocker"), 1e-12);
    const double xx = row.at("coupler_curve.rotation[0][0]"), yx = row.at("coupler_curve.rotation[1][0]"),
                 zx = row.at("coupler_curve.rotation[2][0]");
    EXPECT_NEAR(xx * xx + yx * yx + zx * zx, 1, 1e-12);
    EXPECT_TRUE(row.count("coupler_curve.position[2]"));
  }
  const auto chosen = written({"--outputs", "rocker_angle"});
  EXPECT_EQ(chosen.front().count("coupler_curve.position[0]"), 0u);
  EXPECT_EQ(chosen.back().at("rocker_angle"), rows.back().at("rocker_angle"));
  expect(jourdain({"simulate", "models/four_bar.toml", "--output", csv, "--outputs", "rocker_angel"}), 2,
         "did you mean 'rocker_angle'?");
}

/// A fast mode that comes round between rows.
TEST(Simulate, DriftIsThatOfEveryStep) {
  const support::TemporaryFolder folder;
  const auto drift = [&](const char* every) {
    const std::string text =
        jourdain({"simulate", "models/double_pendulum.toml", "--duration", "2", "--step", "0.01", "--method",
                  "semi_implicit_euler", "--every", every, "--output", folder.path() + "/p.csv"})
            .output;
    const std::size_t at = text.find("drift ");
    EXPECT_NE(at, std::string::npos) << text;
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(drift("1"), drift("200"));
}

TEST(Simulate, StopsWhereARunLeavesAllBounds) {
  const support::TemporaryFolder folder;
  const std::string csv = folder.path() + "/p.csv";
  expect(jourdain({"simulate", "models/panda.toml", "--duration", "1000", "--step", "5", "--output", csv}), 1,
         "leaves all bounds");
  EXPECT_FALSE(fs::exists(csv));
  const support::ProcessResult stiff =
      jourdain({"simulate", "models/flyball_governor.toml", "--step", "0.001", "--output", csv});
  expect(stiff, 1, "the run leaves all bounds at t = 0.0");
  expect(stiff, 1, "rk4 is stable up to steps of 0.000343 s");
  expect(jourdain({"simulate", "models/panda.toml", "--duration", "1", "--step", "2", "--output", csv}), 2,
         "steps");
  expect(jourdain({"simulate", "models/panda.toml", "--constant-input", "1,2", "--output", csv}), 2,
         "7 inputs");
}

TEST(Simulate, TellsEquationsWithoutValuesFromStepsThatAreTooLong) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/root.toml";
  support::write_file(
      path,
      "[model]\nname = \"root\"\n[[body]]\nname = \"bead\"\nmass = 1\n[[joint]]\nname = \"slide\"\n"
      "type = \"prismatic\"\nparent = \"world\"\nchild = \"bead\"\n"
      "[[force]]\nname = \"pull\"\njoint = \"slide\"\nvalue = \"sqrt(0.5 - t)\"\n");
  expect(jourdain({"simulate", path, "--duration", "1", "--output", folder.path() + "/r.csv"}), 1,
         "no finite rates from t = 0.");
}

TEST(Simulate, InputsAreNumbers) {
  for (const char* command : {"simulate", "ensemble", "report", "cost"})
    for (const char* input : {"nan", "inf", "1e400"})
      expect(jourdain({command, "models/cart_pole.toml", "--constant-input", input}), 2,
             "error: --constant-input has ");
  const support::TemporaryFolder folder;
  const std::string inputs = folder.path() + "/inputs.toml";
  support::write_file(inputs, "[input]\npush = \"sqrt(-1 - t)\"\n");
  for (const char* command : {"report", "cost"})
    expect(jourdain({command, "models/cart_pole.toml", "--inputs", inputs}), 1,
           "error: the equations of motion have no finite rates at the start: ");
}

/// An arm of 13 links with no direction in common, whose values go through windows of memory.
TEST(Simulate, LongFunctionsKeepTheEnergy) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/arm.toml", csv = folder.path() + "/run.csv";
  std::string text = "[model]\nname = \"arm\"\n";
  for (int i = 0; i < 13; ++i)
    text += fmt::format(
        "[[body]]\nname = \"link{0}\"\nmass = 1\ncenter_of_mass = [0.05, 0.02, 0.01]\n"
        "inertia = [0.01, 0.02, 0.015]\n[[joint]]\nname = \"joint{0}\"\ntype = \"revolute\"\n"
        "parent = \"{1}\"\nchild = \"link{0}\"\nposition = [0.1, 0.03, 0.02]\nrpy = [0.4, 0.5, 0.6]\n"
        "axis = [0, 0, 1]\ninitial_position = 0.3\n",
        i, i == 0 ? "world" : fmt::format("link{}", i - 1));
  support::write_file(path, text);
  expect(
      jourdain({"compile", path, "-o", folder.path(), "--functions", "forward_dynamics", "--real", "double"}),
      0, "read back from the files");
  EXPECT_NE(support::read_file(folder.path() + "/arm_kernels.hpp").find("= detail::nearby("),
            std::string::npos);
  const support::ProcessResult run =
      jourdain({"simulate", path, "--duration", "0.05", "--step", "5e-4", "--output", csv});
  expect(run, 0, " J, drift ");
  const std::string opening = " J, drift ";
  EXPECT_LT(std::stod(run.output.substr(run.output.find(opening) + opening.size())), 1e-8) << run.output;
}

TEST(Simulate, BodiesMayBeThrownFarAway) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/thrown.toml";
  support::write_file(
      path,
      "[model]\nname = \"thrown\"\ngravity = [0, 0, -9.81]\n[[body]]\nname = \"stone\"\nmass = 1\n"
      "[[joint]]\nname = \"fall\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"stone\"\n");
  expect(
      jourdain({"simulate", path, "--duration", "1e6", "--step", "10", "--output", folder.path() + "/t.csv"}),
      0, "-4.905e+12 ");
}

TEST(Simulate, NeedsACompiler) {
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      support::run_process({"env", "-C", JOURDAIN_SOURCE_DIR, "CXX=no-such-compiler", JOURDAIN_BINARY,
                            "simulate", "models/pendulum.toml", "--output", folder.path() + "/p.csv"});
  expect(result, 3, "no-such-compiler");
}

}  // namespace
}  // namespace jourdain::tests
