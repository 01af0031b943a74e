#include <gtest/gtest.h>

#include <filesystem>

#include "model/coordinates.hpp"
#include "model/read/read.hpp"
#include "model/time_dependence.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

/// A mechanism whose file must be without any message.
Mechanism read_cleanly(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("model.toml", text);
  auto mechanism = read_mechanism(diagnostics, options);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

const std::string kBare = R"([model]
name = "chain"
[[body]]
name = "crank"
mass = 1
inertia = [1, 1, 1]
[[body]]
name = "rod"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "crank"
range = [-1, "30*deg"]
[[joint]]
name = "guide"
type = "cylindrical"
parent = "crank"
child = "rod"
slide = { range = [0, 1], initial_position = 1 }
[[frame]]
name = "tip"
body = "rod"
position = [1, 0, 0]
)";

const std::string kChain = "[parameters]\nl = 2.0\n" + kBare;

TEST(ReadLoops, TakesEveryType) {
  const auto type_of = [](const std::string& type, const std::string& lines = "") {
    const std::string ends = type == "residual" ? "" : "from = \"tip\"\nto = \"world\"\n";
    const Mechanism m = read_cleanly(kChain + "[[loop]]\ntype = \"" + type + "\"\n" + ends + lines);
    EXPECT_EQ(m.loops.size(), 1u) << type;
    return m.loops.empty() ? LoopType::kBall : m.loops[0].type;
  };
  EXPECT_EQ(type_of("ball"), LoopType::kBall);
  EXPECT_EQ(type_of("revolute"), LoopType::kRevolute);
  EXPECT_EQ(type_of("universal"), LoopType::kUniversal);
  EXPECT_EQ(type_of("prismatic"), LoopType::kPrismatic);
  EXPECT_EQ(type_of("cylindrical"), LoopType::kCylindrical);
  EXPECT_EQ(type_of("planar_pin"), LoopType::kPlanarPin);
  EXPECT_EQ(type_of("point_in_plane"), LoopType::kPointInPlane);
  EXPECT_EQ(type_of("point_on_line"), LoopType::kPointOnLine);
  EXPECT_EQ(type_of("rod", "length = 2\n"), LoopType::kRod);
  EXPECT_EQ(type_of("residual", "residual = \"hinge\"\n"), LoopType::kResidual);
}

TEST(ReadLoops, FindsTheEndsOfALoop) {
  const Mechanism m =
      read_cleanly(kChain +
                   "[[loop]]\ntype = \"ball\"\nfrom = \"rod\"\nto = \"world\"\n"
                   "[[loop]]\nname = \"link\"\ntype = \"ball\"\nfrom = \"crank\"\nto = \"tip\"\n");
  ASSERT_EQ(m.loops.size(), 2u);
  EXPECT_EQ(m.loops[0].name, "loop1");
  EXPECT_EQ(m.loops[0].where.line, 29);
  EXPECT_EQ(m.frames[m.loops[0].from.value].body, BodyIndex(1));
  EXPECT_FALSE(m.frames[m.loops[0].to.value].body.has_value());
  EXPECT_EQ(m.loops[1].name, "link");
  EXPECT_EQ(m.frames[m.loops[1].from.value].name, "crank");
  EXPECT_EQ(m.loops[1].to, FrameIndex(0));
  EXPECT_EQ(m.loops[1].to_where.line, 37);
}

TEST(ReadLoops, TakesTheSecondAxisFromTheFirst) {
  const auto axes = [](const std::string& lines) {
    return read_cleanly(kChain + "[[loop]]\ntype = \"revolute\"\nfrom = \"tip\"\nto = \"world\"\n" + lines)
        .loops.at(0);
  };
  using Axis = std::array<double, 3>;
  EXPECT_EQ(axes("").to_axis, (Axis{0, 0, 1}));
  EXPECT_EQ(axes("axis = [1, 2, \"2^0.5\"]\n").to_axis, (Axis{1, 2, std::sqrt(2.0)}));
  EXPECT_EQ(axes("to_axis = [0, 3, 0]\n").axis, (Axis{0, 0, 1}));
  EXPECT_EQ(axes("to_axis = [0, 3, 0]\n").to_axis, (Axis{0, 3, 0}));
}

TEST(ReadLoops, TakesARodWhoseLengthChanges) {
  const Mechanism m = read_cleanly(
      kChain + "[[loop]]\ntype = \"rod\"\nfrom = \"tip\"\nto = \"world\"\nlength = \"l + 0.1*sin(t)\"\n");
  const double value = m.loops.at(0).length.evaluate<double>(
      std::vector<double>{3.0}, [](double v) { return v; }, [](const Variable&) { return 1.0; });
  EXPECT_DOUBLE_EQ(value, 3 + 0.1 * std::sin(1.0));
  EXPECT_TRUE(time_dependence(m).dynamics);
}

TEST(ReadLoops, AParameterMayHaveTheNameOfWhatALengthRefuses) {
  const Mechanism m =
      read_cleanly("[parameters]\nhinge = 3\n" + kBare +
                   "[[loop]]\ntype = \"rod\"\nfrom = \"tip\"\nto = \"world\"\nlength = \"hinge\"\n");
  EXPECT_EQ(m.loops.at(0).length.evaluate<double>(std::vector<double>{3.0}), 3);
}

TEST(ReadLoops, TakesAResidualOfPositions) {
  const Mechanism m = read_cleanly(
      kChain + "[[loop]]\ntype = \"residual\"\nresidual = \"tip.x - l*guide_slide + rod.z*sin(t)\"\n");
  std::vector<Variable> variables;
  for (const Expression::Node& node : m.loops.at(0).residual.nodes())
    if (node.op == Expression::Op::kVariable) variables.push_back(node.variable);
  using Kind = Variable::Kind;
  const std::vector<Variable> expected{{Kind::kFramePosition, 0, 0},
                                       {Kind::kPosition, 1, 1},
                                       {Kind::kFramePosition, 1, 2},
                                       {Kind::kTime, 0, 0}};
  EXPECT_EQ(variables, expected);
  EXPECT_EQ(m.frames.at(1).name, "rod");
}

const std::string kBall = "[[loop]]\ntype = \"ball\"\nfrom = \"tip\"\nto = \"world\"\n";

TEST(ReadLoops, HasDefaultOptions) {
  const LoopOptions options = read_cleanly(kChain + kBall).loop_options;
  EXPECT_FALSE(options.treatment.has_value());
  EXPECT_TRUE(options.independent.empty());
  EXPECT_EQ(options.iterations, 2);
  EXPECT_EQ(options.stabilisation, 0);
}

TEST(ReadLoops, TakesOptions) {
  const LoopOptions options = read_cleanly(kChain + kBall +
                                           "[loops]\ntreatment = \"partitioned\"\nindependent = "
                                           "[\"guide_slide\", \"hinge\"]\niterations = 4\n")
                                  .loop_options;
  EXPECT_EQ(options.treatment, LoopTreatment::kPartitioned);
  ASSERT_EQ(options.independent.size(), 2u);
  EXPECT_EQ(options.independent[0].joint, JointIndex(1));
  EXPECT_EQ(options.independent[0].coordinate, 1u);
  EXPECT_EQ(options.independent[1].joint, JointIndex(0));
  EXPECT_EQ(options.iterations, 4);
  EXPECT_EQ(options.where.line, 33);
  EXPECT_EQ(read_cleanly(kChain + kBall + "[loops]\nstabilisation = \"2*pi\"\n").loop_options.stabilisation,
            2 * std::acos(-1.0));
}

TEST(ReadLoops, TakesRangesOfCoordinates) {
  const Mechanism m = read_cleanly(kChain);
  const std::array<double, 2> hinge = m.joints[0].coordinates[0].range.value();
  EXPECT_EQ(hinge[0], -1);
  EXPECT_DOUBLE_EQ(hinge[1], 0.52359877559829882);
  EXPECT_FALSE(m.joints[1].coordinates[0].range.has_value());
  EXPECT_EQ(m.joints[1].coordinates[1].range.value()[1], 1);
}

TEST(ReadLoops, LockedCoordinatesLeaveThem) {
  const std::string text = kChain + kBall +
                           "[[loop]]\ntype = \"residual\"\nresidual = \"hinge - 2*guide_angle\"\n"
                           "[loops]\nindependent = [\"guide_slide\", \"hinge\"]\n";
  const Mechanism m = read_cleanly(text, {.locked_joints = {"guide"}});
  EXPECT_EQ(m.loops.size(), 2u);
  EXPECT_EQ(m.loops[1].residual.nodes().size(), 1u);
  ASSERT_EQ(m.loop_options.independent.size(), 1u);
  EXPECT_EQ(m.loop_options.independent[0].joint, JointIndex(0));
}

TEST(ReadLoops, EveryModelIsReadWithoutAMessage) {
  for (const auto& entry : std::filesystem::directory_iterator(std::string(JOURDAIN_SOURCE_DIR) + "/models"))
    if (entry.path().extension() == ".toml") {
      SCOPED_TRACE(entry.path().filename().string());
      const std::string path = entry.path().string();
      support::Diagnostics diagnostics(path, support::read_file(path));
      const std::optional<Mechanism> mechanism = read_mechanism(diagnostics, {.external = true});
      EXPECT_EQ(diagnostics.format(), "");
      EXPECT_TRUE(mechanism && !mechanism->bodies.empty());
    }
}

}  // namespace
}  // namespace jourdain::model
