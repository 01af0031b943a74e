// A scene as free bodies moves as the scene in minimal coordinates does.
#include "studies/free_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/read/read.hpp"
#include "studies/first_kind.hpp"
#include "studies/judged.hpp"

namespace jourdain::tests {
namespace {

const std::vector<std::string> kFunctions = {
    "initial_state",    "forward_dynamics", "position_rate", "inverse_dynamics",    "kinetic_energy",
    "potential_energy", "rk4_step",         "project",       "constraint_residual", "close_loops"};

std::string body(const std::string& name, const std::string& more = "") {
  return "[[body]]\nname = \"" + name +
         "\"\nmass = \"m\"\ncenter_of_mass = [0.1, 0.05, -0.2]\ninertia = [0.02, 0.03, 0.04]\n" + more;
}

/// A mast with a trolley that is pushed, a damped arm with a geared motor and a tool fixed to it, a cross, a
/// sleeve, a ball.
std::string chain(const std::string& on_arm = "damping = 0.3\n", const std::string& end = "") {
  return "[model]\nname = \"chain\"\ngravity = [0, 1, -9.81]\n[parameters]\nm = 1.5\n" + body("mast") +
         "[[joint]]\nname = \"turn\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"mast\"\n"
         "rpy = [0, 0.1, 0]\naxis = [0, 0, 1]\ninitial_velocity = 0.8\n" +
         body("trolley") +
         "[[joint]]\nname = \"rail\"\ntype = \"prismatic\"\nparent = \"mast\"\nchild = \"trolley\"\n"
         "position = [0.3, 0, 0]\nrpy = [0.4, 0, 0.2]\naxis = [1, 2, 0]\ninitial_velocity = 0.3\n" +
         body("arm") +
         "[[joint]]\nname = \"hinge\"\ntype = \"revolute\"\nparent = \"trolley\"\nchild = \"arm\"\n"
         "position = [0, 0.1, 0.2]\nrpy = [0.1, 0.3, 0]\naxis = [0, 3, 1]\ninitial_position = 0.5\n"
         "initial_velocity = 1.5\n" +
         on_arm + body("tool") +
         "[[joint]]\nname = \"weld\"\ntype = \"fixed\"\nparent = \"arm\"\nchild = \"tool\"\nposition = [0.2, "
         "0, 0]\n" +
         body("fork") +
         "[[joint]]\nname = \"cross\"\ntype = \"universal\"\nparent = \"tool\"\nchild = \"fork\"\n"
         "position = [0.3, 0, 0]\naxis = [1, 0, 0]\nsecond_axis = [0, 1, 0]\n"
         "first = { initial_position = 0.4 }\nsecond = { initial_position = -0.3, initial_velocity = 1.0 "
         "}\n" +
         body("rod") +
         "[[joint]]\nname = \"sleeve\"\ntype = \"cylindrical\"\nparent = \"fork\"\nchild = \"rod\"\n"
         "position = [0, 0.3, 0]\naxis = [0, 1, 0]\n" +
         body("bob") +
         "[[joint]]\nname = \"ball\"\ntype = \"spherical\"\nparent = \"rod\"\nchild = \"bob\"\n"
         "position = [0, 0, -0.4]\ninitial_angular_velocity = [0.5, 1, 2]\n"
         "[[actuator]]\nname = \"motor\"\njoint = \"hinge\"\ngear_ratio = 5.0\n"
         "[[actuator]]\nname = \"push\"\njoint = \"rail\"\n" +
         end;
}

model::Mechanism mechanism_of(const std::string& text) {
  support::Diagnostics diagnostics("model.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return *mechanism;
}

#ifndef JOURDAIN_SANITIZED  // deriving six free bodies takes long there
std::vector<FormCurve> emitted_forms(const std::string& text, const std::vector<double>& inputs) {
  const EmittedModel minimal = emitted_from(text, kFunctions);
  const auto free = as_free_bodies(minimal.mechanism);
  EXPECT_TRUE(free);
  const EmittedModel emitted = emitted_from(*free, kFunctions);
  const ConstantInputs held(inputs);
  const Flow<double> flow(minimal.table(), held);
  const EmittedFreeBodies other{*free, Flow<double>(emitted.table(), held)};
  constexpr double kSampling = 0.015625;
  const ReferenceSolution reference =
      solve_reference(flow, nullptr, ReferenceKind::kCvode, kSampling, 32, 1, 1, kSilent);
  std::vector<double> parameters;
  for (const model::Parameter& p : minimal.mechanism.parameters) parameters.push_back(p.value);
  std::vector<FormCurve> curves =
      study_forms(minimal.mechanism, parameters, flow, &other,
                  {kSampling, kSampling / 2, kSampling / 4, kSampling / 8}, kSampling, reference, 5, kSilent);
  EXPECT_EQ(curves.size(), 5u);
  return {curves.end() - 2, curves.end()};
}

TEST(FreeBodies, MoveAsTheSceneDoes) {
  const std::vector<FormCurve> curves = emitted_forms(chain(), {0.7, -3});
  for (const FormCurve& curve : curves) {
    ASSERT_EQ(curve.points.size(), 4u) << curve.form;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(curve.points[i].finite) << curve.form;
    EXPECT_LT(curve.points[3].position_error, 1e-7) << curve.form;
    EXPECT_LT(curve.points[3].angle_error, 1e-6) << curve.form;
    EXPECT_NEAR(std::log2(curve.points[1].position_error / curve.points[2].position_error), 4, 0.7)
        << curve.form;
  }
  EXPECT_EQ(curves[1].states, 6 * 13);
  EXPECT_EQ(curves[1].unknowns, 5 + 5 + 5 + 4 + 4 + 3);
  for (const FormPoint& point : curves[1].points) EXPECT_LT(point.drift, 1e-6);
  EXPECT_LT(curves[1].points[3].drift, 1e-12);
}
#endif

TEST(FreeBodies, AreRefusedWhereSomethingHasNoPlaceOnThem) {
  EXPECT_TRUE(as_free_bodies(mechanism_of(chain())));
  for (const char* on_arm : {"stiffness = 2.0\n", "friction = 0.1\n", "motion = \"0.1*sin(t)\"\n"}) {
    std::string text = chain(on_arm);
    if (std::string(on_arm).starts_with("motion")) {
      for (const char* given : {"initial_position = 0.5\ninitial_velocity = 1.5\n"})
        text.erase(text.find(given), std::string(given).size());
      const std::string motor = "[[actuator]]\nname = \"motor\"\njoint = \"hinge\"\ngear_ratio = 5.0\n";
      text.erase(text.find(motor), motor.size());
    }
    EXPECT_FALSE(as_free_bodies(mechanism_of(text))) << on_arm;
  }
  EXPECT_FALSE(
      as_free_bodies(mechanism_of(chain("", "[[force]]\njoint = \"hinge\"\nvalue = \"0.1*hinge\"\n"))));
  EXPECT_FALSE(as_free_bodies(mechanism_of(
      chain("",
            "[[body]]\nname = \"point\"\nmass = 1.0\n[[joint]]\nname = \"pin\"\ntype = \"revolute\"\n"
            "parent = \"rod\"\nchild = \"point\"\nposition = [1, 0, 0]\naxis = [0, 0, 1]\n"
            "[[body]]\nname = \"weight\"\nmass = 1.0\n[[joint]]\nname = \"arm_end\"\ntype = \"fixed\"\n"
            "parent = \"point\"\nchild = \"weight\"\nposition = [1, 0, 0]\n"))));
}

TEST(FreeBodies, OfAFreeBodyAreNothingNew) {
  EXPECT_FALSE(as_free_bodies(mechanism_of("[model]\nname = \"lone\"\n" +
                                           std::string("[parameters]\nm = 1.0\n") + body("b") +
                                           "[[joint]]\nname = \"f\"\ntype = \"free\"\nparent = \"world\"\n"
                                           "child = \"b\"\n")));
}

}  // namespace
}  // namespace jourdain::tests
