// <actuator> and <equality> of MJCF files, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/matrix3.hpp"
#include "model/read/read.hpp"
#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"

namespace jourdain::model {
namespace {

constexpr double kRounding = 1e-13;
using Vector = Eigen::VectorXd;

struct Read {
  Mechanism mechanism;
  std::string messages;
};

Read read(const std::string& text) {
  support::Diagnostics diagnostics("m.mjcf", text);
  auto mechanism = read_mechanism(diagnostics, {.snap = 0});
  return {mechanism.value_or(Mechanism()), diagnostics.format()};
}

Mechanism read_cleanly(const std::string& text) {
  Read result = read(text);
  EXPECT_EQ(result.messages, "");
  return std::move(result.mechanism);
}

const std::string kInertial = R"(<inertial pos="0 0 0" mass="2" diaginertia="0.3 0.4 0.5"/>)";

/// A hinge "j" about z with these attributes, without gravity.
std::string hinge(const std::string& attributes, const std::string& sections) {
  return "<mujoco><option gravity=\"0 0 0\"/><worldbody><body name=\"b\"><joint name=\"j\" " + attributes +
         "/>" + kInertial + "</body></worldbody>" + sections + "</mujoco>";
}

reference::Terms<double> terms(const Mechanism& mechanism, double y, double z, double u) {
  const reference::Reference<double> numbers(mechanism);
  return numbers.evaluate({.t = 0, .y = Vector::Constant(1, y), .z = Vector::Constant(1, z)},
                          Vector::Constant(Eigen::Index(numbers.input_count()), u));
}

TEST(MjcfActuators, MotorsPushByTheirGearAndArmaturesAreNotMultiplied) {
  const Mechanism m = read_cleanly(hinge(
      R"(armature="0.25")", R"(<actuator><motor name="drive" joint="j" gear="16 1 0 0 0 0"/></actuator>)"));
  ASSERT_EQ(m.actuators.size(), 1u);
  EXPECT_EQ(m.actuators[0].name, "drive");
  EXPECT_EQ(terms(m, 0, 0, 0).M(0, 0), 0.5 + 0.25);
  EXPECT_EQ(terms(m, 0, 0, 2).q_bar[0], -32);
}

TEST(MjcfActuators, ArmaturesWithoutActuatorGetOne) {
  const Read result = read(hinge(R"(armature="0.25")", ""));
  EXPECT_NE(result.messages.find("note: joint 'j' with an armature and no actuator"), std::string::npos);
  ASSERT_EQ(result.mechanism.actuators.size(), 1u);
  EXPECT_TRUE(result.mechanism.actuators[0].implied);
  EXPECT_EQ(terms(result.mechanism, 0, 0, 0).M(0, 0), 0.75);
}

TEST(MjcfActuators, ServosPullToTheirInput) {
  // gear (kp (u - gear q) - kv gear q'), with q = 0.1, q' = 0.2, u = 0.7.
  const auto force = [](const std::string& element) {
    return -terms(read_cleanly(hinge("", "<actuator>" + element + "</actuator>")), 0.1, 0.2, 0.7).q_bar[0];
  };
  EXPECT_NEAR(force(R"(<position joint="j" kp="30" gear="2"/>)"), 2 * 30 * (0.7 - 0.2), kRounding);
  EXPECT_NEAR(force(R"(<position joint="j" kp="30" kv="4" gear="2"/>)"), 2 * (30 * (0.7 - 0.2) - 4 * 0.4),
              kRounding);
  EXPECT_NEAR(force(R"(<velocity joint="j" kv="5" gear="3"/>)"), 3 * 5 * (0.7 - 0.6), kRounding);
  EXPECT_NEAR(force(R"(<general joint="j" gainprm="8" biasprm="1 -2 -3" biastype="affine"/>)"),
              8 * 0.7 + 1 - 2 * 0.1 - 3 * 0.2, kRounding);
  EXPECT_NEAR(force(R"(<general joint="j" gainprm="8" biasprm="1 -2 -3"/>)"), 8 * 0.7, kRounding);
}

// As MuJoCo 3 does; 2.2 drops what a class says of the bias in position servos.
TEST(MjcfActuators, PassOnWhatAClassSaysOfAnotherKind) {
  const auto force = [](const std::string& element) {
    const std::string classes =
        R"(<default><general gainprm="8" biasprm="1 -2 -3" biastype="affine"/></default><actuator>)";
    return -terms(read_cleanly(hinge("", classes + element + "</actuator>")), 0.1, 0.2, 0.7).q_bar[0];
  };
  EXPECT_NEAR(force(R"(<position joint="j"/>)"), 8 * 0.7 + 1 - 8 * 0.1 - 3 * 0.2, kRounding);
  EXPECT_NEAR(force(R"(<position joint="j" kp="5" kv="4"/>)"), 5 * 0.7 + 1 - 5 * 0.1 - 4 * 0.2, kRounding);
  EXPECT_NEAR(force(R"(<velocity joint="j"/>)"), 8 * 0.7 - 8 * 0.2, kRounding);
  EXPECT_NEAR(force(R"(<motor joint="j"/>)"), 0.7, kRounding);
}

// Gains of MuJoCo 2.2.2 (libmujoco-dev of Debian 12), which <motor> and <velocity> share with 3.
TEST(MjcfActuators, TakeGainsOfClassesOfOtherKinds) {
  const auto of = [](const std::string& level, const std::string& element) {
    return read(hinge("", "<default>" + level + "</default><actuator>" + element + "</actuator>"));
  };
  const auto gain = [&](const std::string& level, const std::string& element) {
    const Read result = of(level, element);
    EXPECT_EQ(result.messages, "") << level;
    return terms(result.mechanism, 0, 0, 0).q_bar[0] - terms(result.mechanism, 0, 0, 1).q_bar[0];
  };
  const std::string velocity = R"(<velocity joint="j"/>)", motor = R"(<motor joint="j"/>)";
  EXPECT_NEAR(gain(R"(<cylinder diameter="2"/>)", velocity), std::numbers::pi, kRounding);
  EXPECT_NEAR(gain(R"(<cylinder area="5" timeconst="1"/>)", velocity), 5, kRounding);
  EXPECT_NEAR(gain(R"(<muscle timeconst="0.01 0.04"/>)", velocity), 0.75, kRounding);
  EXPECT_NEAR(gain(R"(<muscle range="0.6 1"/>)", velocity), 0.6, kRounding);
  EXPECT_NEAR(gain(R"(<muscle timeconst="0.01 0.04"/>)", motor), 1, kRounding);
  EXPECT_NEAR(gain(R"(<adhesion gain="4"/>)", velocity), 4, kRounding);
  EXPECT_NEAR(gain(R"(<intvelocity kp="7"/>)", velocity), 7, kRounding);
  EXPECT_NEAR(gain(R"(<dcmotor/>)", motor), 1, kRounding);
  EXPECT_NE(of(R"(<damper kv="3"/>)", velocity).messages.find("has no effect"), std::string::npos);
  EXPECT_NE(of(R"(<dcmotor/>)", velocity).messages.find("is read as a motor"), std::string::npos);
  EXPECT_NEAR(gain(R"(<dcmotor/>)", R"(<velocity joint="j" kv="2"/>)"), 2, kRounding);
  // An input that is integrated is no position.
  EXPECT_NE(of(R"(<intvelocity kp="7"/>)", R"(<position joint="j"/>)").messages.find("is read as a motor"),
            std::string::npos);
  // What <position> takes over, and not in all versions.
  const Read servo = of(R"(<cylinder area="5" bias="1 2 -3"/>)", R"(<position joint="j"/>)");
  EXPECT_NEAR(-terms(servo.mechanism, 0.1, 0.2, 0.7).q_bar[0], 5 * (0.7 - 0.1) + 1 - 3 * 0.2, kRounding);
  EXPECT_NE(servo.messages.find("takes over numbers of a default class of <cylinder>"), std::string::npos);
  EXPECT_NE(servo.messages.find("the activation dynamics that <position> takes over are ignored"),
            std::string::npos);
  const Read lagging = of(R"(<general dyntype="filter" dynprm="1"/>)", R"(<position joint="j" kp="2"/>)");
  EXPECT_NE(lagging.messages.find("activation dynamics"), std::string::npos) << lagging.messages;
}

TEST(MjcfActuators, DampingRatiosAreNoDampings) {
  const auto of = [](const std::string& sections) {
    const Read result = read(hinge("", sections));
    EXPECT_NEAR(-terms(result.mechanism, 0.1, 0.2, 0.7).q_bar[0], 4 * (0.7 - 0.1), kRounding);
    return result.messages;
  };
  const std::string element = R"(<actuator><general joint="j" dyntype="none"/></actuator>)";
  EXPECT_NE(of(R"(<default><position kp="4" dampratio="1"/></default>)" + element)
                .find("warning: dampratio of <general> is ignored"),
            std::string::npos);
  EXPECT_NE(of(R"(<default><general gainprm="4" biastype="affine" biasprm="0 -4 1"/></default>)" + element)
                .find("warning: the damping ratio of <general> is ignored"),
            std::string::npos);
}

TEST(MjcfActuators, ReadLawsThatTheElementMakesReadable) {
  const auto force = [](const std::string& level, const std::string& element) {
    const std::string text = "<default>" + level + "</default><actuator>" + element + "</actuator>";
    return -terms(read_cleanly(hinge("", text)), 0.1, 0.2, 0.7).q_bar[0];
  };
  EXPECT_NEAR(
      force(R"(<general gaintype="affine" gainprm="3 2 0"/>)", R"(<general joint="j" gaintype="fixed"/>)"),
      3 * 0.7, kRounding);
  EXPECT_NEAR(force(R"(<general dyntype="filter" gainprm="3" biastype="affine" biasprm="0 -3 -1"/>)",
                    R"(<general joint="j" dyntype="none"/>)"),
              3 * 0.7 - 3 * 0.1 - 0.2, kRounding);
  EXPECT_NEAR(force(R"(<position kp="4" timeconst="0.1"/>)", R"(<general joint="j" dyntype="none"/>)"),
              4 * (0.7 - 0.1), kRounding);
}

TEST(MjcfActuators, WithoutAGainHaveTheirBias) {
  const auto read_one = [](const std::string& element) {
    return read(hinge("", "<actuator>" + element + "</actuator>"));
  };
  const Read spring =
      read_one(R"(<general name="g" joint="j" gear="2" gainprm="0" biastype="affine" biasprm="0 -50 -3"/>)");
  EXPECT_NE(spring.messages.find("note: <general> 'g' has a gain of zero: its bias acts, it is no input"),
            std::string::npos);
  EXPECT_TRUE(spring.mechanism.actuators.empty());
  EXPECT_NEAR(terms(spring.mechanism, 0.3, 0.2, 0).q_bar[0], 4 * (50 * 0.3 + 3 * 0.2), kRounding);
  const Read damper = read_one(R"(<position joint="j" kp="0" kv="5"/>)");
  EXPECT_NEAR(terms(damper.mechanism, 0.3, 0.2, 0).q_bar[0], 5 * 0.2, kRounding);
  for (const char* nothing :
       {R"(<general name="g" joint="j" gainprm="0" biastype="affine"/>)",
        R"(<general name="g" joint="j" gear="0" biastype="affine" biasprm="0 -50 -3"/>)"}) {
    const Read none = read_one(nothing);
    EXPECT_NE(none.messages.find("<general> 'g' has no effect"), std::string::npos);
    EXPECT_EQ(terms(none.mechanism, 0.3, 0.2, 0).q_bar[0], 0);
  }
}

TEST(MjcfActuators, SayWhatIsNotRead) {
  const auto messages = [](const std::string& element) {
    return read(hinge("", "<actuator>" + element + "</actuator>")).messages;
  };
  EXPECT_NE(messages(R"(<motor name="m" tendon="t"/>)").find("<motor> 'm' acts on no joint: not read"),
            std::string::npos);
  EXPECT_NE(messages(R"(<motor joint="k"/>)").find("names unknown joint 'k'"), std::string::npos);
  EXPECT_NE(messages(R"(<muscle name="m" joint="j"/>)").find("<muscle> 'm' is read as a motor"),
            std::string::npos);
  EXPECT_NE(messages(R"(<general joint="j" dyntype="filter"/>)").find("is read as a motor"),
            std::string::npos);
  EXPECT_NE(messages(R"(<position joint="j" dampratio="1"/>)").find("dampratio of <position> is ignored"),
            std::string::npos);
  EXPECT_NE(messages(R"(<motor name="m" joint="j" forcerange="-1 1"/>)")
                .find("forcerange of actuator 'm' is ignored"),
            std::string::npos);
}

TEST(MjcfActuators, OfDisabledGroupsAreLeftOut) {
  const std::string text = R"(<default><motor group="3"/></default><option actuatorgroupdisable="1 3"/>
    <actuator><position joint="j" kp="20" group="1"/><motor joint="j"/><motor joint="j" group="2"/></actuator>)";
  const Read result = read(hinge("", text));
  EXPECT_NE(result.messages.find("note: <position> is of disabled group 1: left out"), std::string::npos);
  EXPECT_NE(result.messages.find("note: <motor> is of disabled group 3: left out"), std::string::npos);
  EXPECT_EQ(result.mechanism.actuators.size(), 1u);
  EXPECT_TRUE(result.mechanism.coordinate_forces.empty());
}

TEST(MjcfActuators, SayThatWhatTheyAddToJointsIsIgnored) {
  for (const std::string name : {"damping", "armature", "delay"}) {
    const auto messages = [&](const std::string& value) {
      const std::string motor = "<motor joint=\"j\" " + name + "=\"" + value + "\"/>";
      return read(hinge("", "<actuator>" + motor + "</actuator>")).messages;
    };
    EXPECT_NE(messages("0.5").find("warning: " + name + " of <motor> is ignored"), std::string::npos);
    EXPECT_EQ(messages("0"), "");
  }
}

/// Hinges "p" and "q" about z, 1 m apart along x, and sites; sections behind.
std::string two(const std::string& sections, const std::string& of_q = "") {
  return "<mujoco><worldbody><body name=\"a\"><joint name=\"p\" ref=\"90\"/>" + kInertial +
         "<site name=\"tip\" pos=\"0 2 0\"/></body><body name=\"b\" pos=\"1 0 0\" " + of_q +
         "><joint name=\"q\"/>" + kInertial + "<site name=\"end\" pos=\"-1 2 0\"/></body></worldbody>" +
         sections + "</mujoco>";
}

Vector rows(const Mechanism& mechanism, double p, double q) {
  const reference::DescriptorReference<double> descriptor(mechanism);
  return descriptor.loop_constraints(0, Vector{{p, q}}, Vector::Zero(2)).g;
}

constexpr double kQuarter = std::numbers::pi / 2;

TEST(MjcfEqualities, ConnectHoldsWhatIsTogetherAsDrawn) {
  for (const char* ends : {R"(body1="a" body2="b" anchor="0 2 0")", R"(site1="tip" site2="end")"}) {
    const Mechanism m =
        read_cleanly(two(std::string("<equality><connect name=\"pin\" ") + ends + "/></equality>"));
    ASSERT_EQ(m.loops.size(), 1u);
    EXPECT_EQ(m.loops[0].name, "pin");
    EXPECT_EQ(m.loops[0].type, LoopType::kBall);
    EXPECT_LE(rows(m, kQuarter, 0).norm(), kRounding);
    // The first turned by a quarter: its point at (-2, 0), the other one stays at (0, 2).
    const Vector open = rows(m, 2 * kQuarter, 0);
    EXPECT_NEAR(open[0], 2, kRounding);
    EXPECT_NEAR(open[1], 2, kRounding);
  }
  EXPECT_FALSE(read_cleanly(two("<equality><connect body1=\"a\" anchor=\"1 0 0\"/></equality>"))
                   .frames[3]
                   .body.has_value());
}

TEST(MjcfEqualities, WeldTakesAllSixFreedoms) {
  const Mechanism drawn = read_cleanly(two(R"(<equality><weld body1="a" body2="b"/></equality>)"));
  EXPECT_EQ(rows(drawn, kQuarter, 0).size(), 6);
  EXPECT_LE(rows(drawn, kQuarter, 0).norm(), kRounding);
  EXPECT_GT(rows(drawn, kQuarter, 0.1).norm(), 0.05);
  // As relpose says: the second body a quarter turned, its anchor at (0.7, 0.2) in the first; with p at its reference
  // it is 1 m along x.
  const Mechanism given = read_cleanly(two(
      R"(<equality><weld body1="a" body2="b" anchor="0.2 0.3 0" relpose="0.7 0.2 0 1 0 0 1"/></equality>)"));
  EXPECT_LE(rows(given, kQuarter, kQuarter).norm(), kRounding);
  EXPECT_GT(rows(given, kQuarter, 0).norm(), 0.05);
}

TEST(MjcfEqualities, WeldWithoutTorqueIsAConnect) {
  const auto welded = [](const std::string& attributes) {
    return read_cleanly(
        two("<equality><weld body1=\"a\" body2=\"b\" anchor=\"-1 2 0\" " + attributes + "/></equality>"));
  };
  const Mechanism free_to_turn = welded(R"(torquescale="0")");
  ASSERT_EQ(free_to_turn.loops.size(), 1u);
  EXPECT_EQ(free_to_turn.loops[0].type, LoopType::kBall);
  EXPECT_LE(rows(free_to_turn, kQuarter, 0).norm(), kRounding);
  EXPECT_GT(rows(free_to_turn, kQuarter, 0.1).norm(), 0.05);
  EXPECT_EQ(rows(welded(R"(torquescale="3")"), kQuarter, 0).size(), 6);
}

TEST(MjcfJoints, FreeOnesThatAreAlignedAreTold) {
  const auto messages = [](const std::string& align) {
    return read("<mujoco><worldbody><body name=\"b\"><freejoint name=\"f\"" + align + "/>" + kInertial +
                "</body></worldbody></mujoco>")
        .messages;
  };
  EXPECT_NE(messages(R"( align="true")").find("warning: align of joint 'f' is ignored"), std::string::npos);
  EXPECT_EQ(messages(R"( align="auto")"), "");
  EXPECT_EQ(messages(R"( align="false")"), "");
  EXPECT_EQ(messages(""), "");
}

TEST(MjcfEqualities, JointsFollowAPolynomialFromTheirReferences) {
  const Mechanism line =
      read_cleanly(two(R"(<equality><joint joint1="p" joint2="q" polycoef="0.1 -3"/></equality>)"));
  EXPECT_NEAR(rows(line, kQuarter + 0.5, 0.2)[0], 0.5 - (0.1 - 0.6), kRounding);
  const Mechanism from_reference =
      read_cleanly(two(R"(<equality><joint joint1="q" joint2="p" polycoef="0.1 -3 0 0 0"/></equality>)"));
  EXPECT_NEAR(rows(from_reference, kQuarter + 0.5, 0.2)[0], 0.2 - (0.1 - 1.5), kRounding);
  const Mechanism curve =
      read_cleanly(two(R"(<equality><joint joint1="q" joint2="p" polycoef="0.1 -3 2 0.5 4"/></equality>)"));
  EXPECT_NEAR(rows(curve, kQuarter + 0.5, 0.2)[0], 0.2 - (0.1 - 1.5 + 0.5 + 0.0625 + 0.25), kRounding);
  const Mechanism held =
      read_cleanly(two(R"(<equality><joint joint1="p" polycoef="0.1 0 0 0 0"/></equality>)"));
  EXPECT_NEAR(rows(held, kQuarter, 0)[0], -0.1, kRounding);
}

TEST(MjcfEqualities, AreLeftOutWhereAFlagSaysSo) {
  const Read off = read(two(R"(<option><flag equality="disable"/></option>
    <equality><connect body1="a" body2="b" anchor="0 2 0"/></equality>)"));
  EXPECT_TRUE(off.mechanism.loops.empty());
  EXPECT_NE(off.messages.find("equality constraints are disabled"), std::string::npos);
}

TEST(MjcfEqualities, HaveDefaultsOfTheirOwn) {
  const std::string equality = R"(<equality><joint joint1="p" joint2="q"/></equality>)";
  const Read off = read(two(R"(<default><equality active="false"/></default>)" + equality));
  EXPECT_TRUE(off.mechanism.loops.empty());
  EXPECT_NE(off.messages.find("note: <joint> is not active: left out"), std::string::npos) << off.messages;
  // Defaults of bodies' joints are not theirs.
  const Read on = read(two(R"(<default><joint damping="1"/></default>)" + equality));
  EXPECT_EQ(on.mechanism.loops.size(), 1u) << on.messages;
}

TEST(MjcfEqualities, SayWhatIsLeftOut) {
  const auto messages = [](const std::string& element) {
    return read(two("<equality>" + element + "</equality>")).messages;
  };
  EXPECT_NE(messages(R"(<connect body1="a" body2="b" anchor="0 0 0" active="false"/>)")
                .find("<connect> is not active"),
            std::string::npos);
  EXPECT_NE(messages(R"(<tendon tendon1="t"/>)").find("<tendon> of <equality> is not read"),
            std::string::npos);
  EXPECT_NE(messages(R"(<connect body1="a" body2="c" anchor="0 0 0"/>)").find("names unknown body 'c'"),
            std::string::npos);
}

}  // namespace
}  // namespace jourdain::model
