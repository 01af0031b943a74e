#include <gtest/gtest.h>

#include <string>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

const std::string kInertial =
    R"(<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)";

/// What is said of a joint with `inside` in a robot with `beside`.
std::string messages(const std::string& inside, const std::string& beside = "",
                     const std::string& inertial = kInertial) {
  support::Diagnostics diagnostics(
      "arm.urdf", R"(<robot name="arm" xmlns:xacro="x"><link name="base"/><link name="arm">)" + inertial +
                      R"(</link><joint name="j" type="revolute"><parent link="base"/><child link="arm"/>)" +
                      inside + "</joint>" + beside + "</robot>");
  read_mechanism(diagnostics);
  return diagnostics.format();
}

void expect_said(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(UrdfSchema, AttributesThatAreNotReadAreTold) {
  expect_said(messages(R"(<dynamics dampning="5"/>)"),
              "warning: attribute 'dampning' of <dynamics> is ignored");
  expect_said(messages(R"(<dynamics dampning="5"/>)"), "did you mean 'damping'?");
  expect_said(messages(R"(<axis xyx="0 1 0"/>)"), "attribute 'xyx' of <axis> is ignored");
  expect_said(messages(R"(<origin xyz="0 0 0" quat="0.6 0 0 0.8"/>)"),
              "note: attribute 'quat' of <origin> is ignored");
  expect_said(messages("", "", R"(<inertial><origin xzy="1 2 3"/>)" + kInertial.substr(10)),
              "attribute 'xzy' of <origin> is ignored");
  const std::string other =
      R"(<joint name="k" type="fixed"><parent link="arm"/><child link="tip"/><dynamics D="1"/></joint>)"
      R"(<link name="tip"/>)";
  expect_said(messages(R"(<dynamics D="1"/>)", other),
              "note: attribute 'D' of <dynamics> is ignored, here and 1 times more");
  EXPECT_EQ(messages(R"(<limit current="2" effort="1" velocity="1"/>)"), "");
  EXPECT_EQ(
      messages(R"(<origin xyz="0 0 0" rpy="0 0 0"/><axis xyz="0 1 0"/><dynamics damping="1" friction="0"/>
                        <limit lower="-1" upper="1" effort="1" velocity="1" acceleration="2"/>)"),
      "");
}

TEST(UrdfSchema, WhatOtherProgramsMoveByIsTold) {
  expect_said(messages("", R"(<gazebo reference="j"><springStiffness>5</springStiffness></gazebo>)"),
              "warning: <springStiffness> of <gazebo> is ignored");
  expect_said(messages("", R"(<gazebo reference="arm"><turnGravityOff>true</turnGravityOff></gazebo>)"),
              "<turnGravityOff> of <gazebo> is ignored");
  expect_said(messages("", R"(<loop_joint name="k"/>)"), "<loop_joint> of <robot> is ignored");
  expect_said(messages("", R"(<transmission name="t"><actuator name="a"><motorInertia>0.1</motorInertia>
                               </actuator></transmission>)"),
              "<motorInertia> of <actuator> is ignored");
  EXPECT_EQ(messages("", R"(<gazebo reference="j"><springStiffness>0</springStiffness><mu1>0.2</mu1>
                       <turnGravityOff>false</turnGravityOff></gazebo><transmission name="t"><actuator name="a">
                       <mechanicalReduction>50</mechanicalReduction></actuator></transmission>)"),
            "");
}

}  // namespace
}  // namespace jourdain::model
