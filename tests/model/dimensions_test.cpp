#include "model/dimensions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "model/expression.hpp"
#include "model/read/read.hpp"
#include "model/read/scenario.hpp"

namespace jourdain::model {
namespace {

using Kind = Variable::Kind;

const std::vector<DeclaredParameter> kParameters{
    {"m", Measure::parameter("kg")},    {"l", Measure::parameter("m")},
    {"g", Measure::parameter("m/s^2")}, {"k", Measure::parameter("N/m")},
    {"w", Measure::parameter("rad/s")}, {"alpha", Measure::parameter("deg")},
    {"mu", Measure::parameter("")}};
const Scope kScope{{"t", {.kind = Kind::kTime}, Measure::time()},
                   {"x", {.kind = Kind::kPosition}, Measure::variable(needed::kLength)},
                   {"angle", {.kind = Kind::kPosition, .index = 1}, Measure::variable(needed::kAngle)},
                   {"x.rate", {.kind = Kind::kVelocity}, Measure::variable(needed::kSpeed)}};

/// The unit of what is known, "any" or the message.
std::string unit_of(const std::string& text) {
  const auto result = parse_expression(text, kParameters, kScope);
  if (const auto* error = std::get_if<ExpressionError>(&result)) return error->message;
  const Measure& measure = std::get<MeasuredExpression>(result).measure;
  return measure.is_known() ? measure.unit() : "any";
}

TEST(Dimensions, FollowFromParametersWithUnits) {
  for (const auto& [text, unit] : {std::pair("m", "kg"),
                                   {"m*l^2", "kg m^2"},
                                   {"-m*g*l*sin(angle)", "N m"},
                                   {"k*(l - x)", "N"},
                                   {"sqrt(k/m)", "1/s"},
                                   {"sqrt(sqrt(m))", "kg^(1/4)"},
                                   {"m^0.5*l^-2", "kg^(1/2)/m^2"},
                                   {"m/l^3", "kg/m^3"},
                                   {"1/(m*l)", "1/(kg m)"},
                                   {"w*t + alpha", "rad or 1"},
                                   {"l*(1 - cos(w*t))", "m"},
                                   {"m*x.rate", "kg m/s"},
                                   {"l + 2*t", "m"}})
    EXPECT_EQ(unit_of(text), unit) << text;
}

TEST(Dimensions, OfBareNumbersAreThoseOfTheirPlace) {
  for (const char* text : {"9.81*m", "mu*m", "mu", "1", "4.0*m", "-10*m", "t", "2*t", "sin(t)", "30*deg",
                           "2*pi", "sin(w*t)", "9.81*0.25/k", "2*mu*sqrt(k)"})
    EXPECT_EQ(unit_of(text), "any") << text;
}

TEST(Dimensions, CountsBesideParametersArePure) {
  for (const auto& [text, unit] : {std::pair("1/12*m*l^2", "kg m^2"),
                                   {"2/5*m*l^2", "kg m^2"},
                                   {"m*(3*l^2 + l^2)/12", "kg m^2"},
                                   {"0.5*l", "m"},
                                   {"2*pi*sqrt(l/g)", "s"},
                                   {"k/2*(x - l)^2", "N m"},
                                   {"k/2*(l - l*w*t)", "N"}})
    EXPECT_EQ(unit_of(text), unit) << text;
  for (const char* text : {"2*alpha", "2*l/l", "2*k*x", "2*l*w*t", "l*t/2", "2*m*cos(w*t)"})
    EXPECT_EQ(unit_of(text), "any") << text;
}

TEST(Dimensions, ThatDisagreeAreNamedOnBothSides) {
  EXPECT_EQ(unit_of("2*(m + l)"), "'m' (kg) and 'l' (m) are added");
  EXPECT_EQ(unit_of("m*l - l ^ 2 "), "'m*l' (kg m) and 'l ^ 2' (m^2) are subtracted");
  EXPECT_EQ(unit_of("l - x.rate"), "'l' (m) and 'x.rate' (m/s) are subtracted");
  EXPECT_EQ(unit_of("1 + 2*m + 3*l"), "'1 + 2*m' (kg) and '3*l' (m) are added");
  EXPECT_EQ(unit_of("m*sin(l*w)"), "sin needs rad, but 'l*w' is in m/s");
  EXPECT_EQ(unit_of("m*cos(x)"), "cos needs rad, but 'x' is in m");
  const auto result = parse_expression("9.81*( m + l)", kParameters, kScope);
  EXPECT_EQ(std::get<ExpressionError>(result).offset, 7u);
  EXPECT_EQ(std::get<ExpressionError>(result).length, 5u);
}

TEST(Dimensions, AreNotJudgedWithoutAParameterWithAUnit) {
  for (const char* text : {"x - angle", "sin(x)", "-x.rate", "mu*x + x.rate"})
    EXPECT_EQ(unit_of(text), "any") << text;
}

TEST(Dimensions, AreJudgedAfterTheSyntax) {
  EXPECT_EQ(unit_of("m + l + )"), "expected a number or a name, found ')'");
}

TEST(Dimensions, BeyondAllBoundsAreOpen) {
  std::string text = "m";
  for (int i = 0; i < 20; ++i) text = "(" + text + ")^64";
  EXPECT_EQ(unit_of(text), "any");
  for (int i = 0; i < 7; ++i) text = i == 0 ? "sqrt(m)" : "sqrt(" + text + ")";
  EXPECT_EQ(unit_of(text), "any");
}

/// Messages of a model with these lines in its body, its joint and at its end.
struct Lines {
  std::string body = "mass = 1", joint = "", end = "", type = "revolute";
};

std::string description(const Lines& lines) {
  return fmt::format(R"([model]
name = "f"
[parameters]
m = {{ value = 2.0, unit = "kg" }}
l = "300 mm"
k = {{ value = 100, unit = "N/m" }}
[[body]]
name = "b"
{}
[[joint]]
name = "j"
type = "{}"
parent = "world"
child = "b"
{}
[[frame]]
name = "tip"
body = "b"
{}
)",
                     lines.body, lines.type, lines.joint, lines.end);
}

struct Read {
  std::optional<Mechanism> mechanism;
  std::string messages;
};

Read read(const Lines& lines) {
  support::Diagnostics diagnostics("f", description(lines));
  std::optional<Mechanism> mechanism = read_mechanism(diagnostics, {});
  return {std::move(mechanism), diagnostics.format()};
}

TEST(Quantities, AreConvertedAtTheirPlace) {
  const Read found =
      read({.body = "mass = \"500g\"\ncenter_of_mass = { value = [100, \"1 cm\", 0], unit = \"mm\" }\n"
                    "inertia = { value = [10, 10, 10], unit = \"kg mm^2\" }",
            .joint = "position = [\"-10 mm\", \"0.1 m\", \"l/2\"]\nrpy = [\"30 deg\", 0, 0]\n"
                     "stiffness = \"2.5 N*m/deg\"\ninitial_velocity = \"120 rpm\"\nrange = [\"-90°\", 1.6]\n"
                     "rest = { value = 90, unit = \"deg\" }",
            .end = "[[force]]\nframe = \"tip\"\nforce = [\"2 kN\", 0, 0]\n"});
  ASSERT_TRUE(found.mechanism) << found.messages;
  const Body& body = found.mechanism->bodies[0];
  const Joint& joint = found.mechanism->joints[0];
  EXPECT_EQ(body.mass.constant(), 0.5);
  EXPECT_EQ(body.center_of_mass[0].constant(), 0.1);
  EXPECT_EQ(body.center_of_mass[1].constant(), 0.01);
  EXPECT_DOUBLE_EQ(body.inertia.yy.constant(), 1e-5);
  EXPECT_EQ(joint.placement.position[0].constant(), -0.01);
  EXPECT_EQ(joint.placement.position[1].constant(), 0.1);
  EXPECT_DOUBLE_EQ(joint.placement.rotation.rpy[0].constant(), std::numbers::pi / 6);
  EXPECT_DOUBLE_EQ(joint.coordinates[0].stiffness.constant(), 450 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(joint.coordinates[0].initial_velocity.constant(), 4 * std::numbers::pi);
  EXPECT_DOUBLE_EQ((*joint.coordinates[0].range)[0], -std::numbers::pi / 2);
  EXPECT_EQ((*joint.coordinates[0].range)[1], 1.6);
  EXPECT_DOUBLE_EQ(joint.coordinates[0].rest.constant(), std::numbers::pi / 2);
  EXPECT_EQ(found.mechanism->loads[0].force[0].constant(), 2000);
}

TEST(Quantities, AreReadBesideParametersOfTheSameName) {
  const Read found = read({.joint = "position = [\"2 m\", \"0.1m\", 0]"});
  ASSERT_TRUE(found.mechanism) << found.messages;
  EXPECT_EQ(found.mechanism->joints[0].placement.position[0].constant(), 2);
  EXPECT_EQ(found.mechanism->joints[0].placement.position[1].constant(), 0.1);
  EXPECT_NE(read({.body = "mass = \"2m\""}).messages.find("expected an operator, found 'm'"),
            std::string::npos);
  EXPECT_NE(read({.body = "mass = \"2 m\""}).messages.find("a product needs '*'"), std::string::npos);
  EXPECT_NE(read({.joint = "position = [\"2 l\", 0, 0]"}).messages.find("a product needs '*'"),
            std::string::npos);
}

TEST(Places, TakeWhatFits) {
  for (const Lines& lines :
       {Lines{.body =
                  "mass = \"2*m\"\ninertia = [\"m*l^2/12\", \"2/5*m*l^2\", 0.1]\ninertia_kind = \"lumped\""},
        {.joint = "stiffness = \"k*l^2\"\ndamping = \"0.05*m*l^2\"\nfriction = \"0.3*m*9.81*l\""},
        {.joint = "stiffness = \"k*l\"\n", .type = "curve"},
        {.joint = "pitch = \"5 mm/rev\"", .type = "screw"},
        {.end = "[[force]]\njoint = \"j\"\nvalue = \"-k*l^2*j - 0.1*j.rate\"\n"},
        {.end = "[[force]]\nframe = \"tip\"\nforce = [\"tip.vx\", \"-k*tip.y\", \"-9.81*m\"]\n"},
        {.end = "[[spring]]\nfrom = \"world\"\nto = \"tip\"\nlaw = \"k*(length - l)\"\n"
                "potential = \"k/2*(length - l)^2\"\n"},
        {.end = "[[actuator]]\njoint = \"j\"\ngear_ratio = \"l\"\nrotor_inertia = \"m\"\n"},
        {.end = "[[output]]\nname = \"o\"\nkind = \"expression\"\nvalue = \"m*l\"\n"}})
    EXPECT_EQ(read({.body = lines.body,
                    .joint = lines.type == "curve"
                                 ? lines.joint + "curve = [\"l*sin(s/l)\", \"l*sin(s)\", \"l*cos(s)\"]"
                                 : lines.joint,
                    .end = lines.end,
                    .type = lines.type})
                  .messages,
              "")
        << description(lines);
}

TEST(Places, SayWhatTheyNeed) {
  struct Case {
    Lines lines;
    const char* message;
  };
  const auto force = [](const std::string& line) { return Lines{.end = "[[force]]\n" + line + "\n"}; };
  const auto spring = [](const std::string& line) {
    return Lines{.end = "[[spring]]\nfrom = \"world\"\nto = \"tip\"\n" + line + "\n"};
  };
  for (const Case& c :
       {Case{{.body = "mass = \"l^2*m\""},
             "9:9: error: 'mass' of body 'b' needs kg, but 'l^2*m' is in kg m^2"},
        {{.body = "mass = \"2 mm\""}, "needs kg, but '2 mm' is in m"},
        {{.body = "mass = { value = 2, unit = \"mm\" }"}, "needs kg, but 'mm' is in m"},
        {{.body = "mass = { value = \"m\", unit = \"g\" }"}, "'mass' of body 'b' has two units"},
        {{.body = "mass = { value = \"2 g\", unit = \"g\" }"}, "'mass' of body 'b' has two units"},
        {{.body = "mass = { value = 2 }"}, "'mass' of body 'b' needs 'unit'"},
        {{.body = "mass = \"2 furlong\""}, "'furlong' is not a unit"},
        {{.body = "mass = \"1e308 t\""}, "'mass' of body 'b' is not finite in SI units"},
        {{.body = "mass = 1\ncenter_of_mass = [\"m\", 0, 0]"}, "needs m, but 'm' is in kg"},
        {{.body = "mass = 1\ninertia = { xx = \"m*l\", yy = 1, zz = 1 }"},
         "needs kg m^2, but 'm*l' is in kg m"},
        {{.body = "shape = { kind = \"sphere\", radius = \"m\", density = 1 }"}, "needs m, but 'm' is in kg"},
        {{.body = "shape = { kind = \"sphere\", radius = 1, density = \"m\" }"}, "needs kg/m^3, but"},
        {{.joint = "stiffness = \"k\""}, "'stiffness' of joint 'j' needs N m/rad, but 'k' is in N/m"},
        {{.joint = "damping = \"k\""}, "needs N m s/rad, but"},
        {{.joint = "rest = \"l\""}, "needs rad, but 'l' is in m"},
        {{.joint = "initial_velocity = \"l\""}, "needs rad/s, but"},
        {{.joint = "motion = \"l*t\""}, "needs rad, but 'l*t' is in m s"},
        {{.joint = "range = [\"-1 mm\", 1]"}, "'range' of joint 'j' needs rad, but '-1 mm' is in m"},
        {{.joint = "rpy = [\"l\", 0, 0]"}, "needs rad, but"},
        {{.joint = "friction_speed = \"l\""}, "needs rad/s, but"},
        {{.joint = "stiffness = \"m\"", .type = "prismatic"}, "needs N/m, but 'm' is in kg"},
        {{.joint = "pitch = \"m\"", .type = "screw"}, "needs m/rad, but"},
        {{.joint = "curve = [\"m\", \"s\", \"s\"]", .type = "curve"}, "needs m, but 'm' is in kg"},
        {{.joint = "damping = \"k\"", .type = "spherical"}, "needs N m s/rad, but"},
        {{.joint = "initial_velocity = [\"l\", 0, 0]", .type = "free"}, "needs m/s, but"},
        {force("frame = \"tip\"\nforce = [\"k*tip.vx\", 0, 0]"), "needs N, but 'k*tip.vx' is in kg m/s^3"},
        {force("frame = \"tip\"\nmoment = [\"k*tip.x\", 0, 0]"), "needs N m, but 'k*tip.x' is in N"},
        {force("joint = \"j\"\nvalue = \"k*j\""), "needs N m, but 'k*j' is in N/m"},
        {spring("stiffness = \"m\""), "needs N/m, but"},
        {spring("damping = \"m\""), "needs N s/m, but"},
        {spring("free_length = \"m\""), "needs m, but"},
        {spring("law = \"k*(length - l)^2\""), "needs N, but 'k*(length - l)^2' is in N m"},
        {spring("law = 1.0\npotential = \"k/2*(length - l)\""), "needs J, but 'k/2*(length - l)' is in N"},
        {{.end = "[[actuator]]\njoint = \"j\"\nrotor_inertia = \"l\"\n"},
         "needs kg m^2 or kg, but 'l' is in m"},
        {{.end = "[[actuator]]\njoint = \"j\"\ngear_ratio = \"m\"\n"},
         "needs 1 or m or 1/m, but 'm' is in kg"},
        {{.end = "[[output]]\nname = \"o\"\nkind = \"expression\"\nvalue = \"m + l\"\n"},
         "'m' (kg) and 'l' (m) are added"}})
    EXPECT_NE(read(c.lines).messages.find(c.message), std::string::npos)
        << c.message << "\n"
        << read(c.lines).messages << description(c.lines);
}

TEST(Places, OfScenariosNeedWhatTheirInputsAre) {
  const Read found = read({.end = "[[actuator]]\njoint = \"j\"\nname = \"motor\"\n"
                                  "[[input]]\nname = \"wind\"\nunit = \"N\"\n[[input]]\nname = \"other\"\n"});
  ASSERT_TRUE(found.mechanism) << found.messages;
  const auto messages = [&](const std::string& text) {
    support::Diagnostics diagnostics("s", text);
    read_scenario(diagnostics, *found.mechanism);
    return diagnostics.format();
  };
  EXPECT_EQ(messages("[input]\nmotor = \"k*l^2\"\nwind = \"2 kN\"\nother = \"m\"\n"), "");
  EXPECT_NE(messages("[input]\nmotor = \"k\"\n").find("'motor' of [input] needs N m, but 'k' is in N/m"),
            std::string::npos);
  EXPECT_NE(messages("[input]\nwind = \"2 m\"\n").find("needs N, but '2 m' is in m"), std::string::npos);
}

}  // namespace
}  // namespace jourdain::model
