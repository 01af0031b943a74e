// modelDescription.xml: against schemas written from the standard, and what it says of three models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fmu/importer.hpp"
#include "package/project.hpp"
#include "properties/effort.hpp"
#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSourcesOnly = "--sources-only";

support::ProcessResult validate(int version, const std::vector<std::string>& files) {
  std::vector<std::string> command = {"/usr/bin/xmllint", "--noout", "--schema",
                                      fmt::format("{}/tests/fmu/fmi{}.xsd", JOURDAIN_SOURCE_DIR, version)};
  command.insert(command.end(), files.begin(), files.end());
  return support::run_process(command);
}

/// What the schema cannot say: which attributes go together, and that the structure lists what it has to.
void expect_consistent(const Fmu& fmu, const std::string& model) {
  References outputs, unknowns;
  std::vector<unsigned> inputs;
  const unsigned count = fmu.reference("");
  for (unsigned k = 0; k < count; ++k) {
    const std::string name = fmu.name_of(k);
    const Attributes& variable = fmu.variable(name);
    const std::string causality = variable.at("causality"), variability = variable.at("variability");
    const std::string initial = variable.count("initial") ? variable.at("initial") : "";
    EXPECT_EQ(variable.count("start"), std::size_t(initial == "exact" || causality == "input"))
        << model << name;
    EXPECT_EQ(initial.empty(), causality == "input" || causality == "independent") << model << name;
    EXPECT_EQ(causality == "parameter", variability == "tunable") << model << name;
    EXPECT_EQ(causality == "independent", k == 0) << model << name;
    if (causality == "output") outputs.push_back(k);
    if (initial == "calculated" && (causality == "output" || variable.count("derivative")))
      unknowns.push_back(k);
  }
  EXPECT_EQ(fmu.structure("Outputs"), outputs) << model;
  EXPECT_EQ(fmu.structure("InitialUnknowns"), unknowns) << model;
  for (const unsigned state : fmu.states()) {
    EXPECT_EQ(fmu.variable(fmu.name_of(state)).at("causality"), "output") << model;
    EXPECT_EQ(fmu.variable(fmu.name_of(state)).count("derivative"), 0u) << model;
  }
}

class Schema : public testing::TestWithParam<int> {};

/// But of those with memories, of which units are refused.
std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(JOURDAIN_SOURCE_DIR) / "models"))
    if (entry.path().extension() == ".toml" &&
        support::read_file(entry.path().string()).find("[[memory]]") == std::string::npos)
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// One version has every sixth model, the other version others, unless every case is asked for.
TEST_P(Schema, HoldsForEveryModel) {
  std::vector<std::unique_ptr<Fmu>> units;
  std::vector<std::string> files;
  const std::vector<std::string> models = model_names();
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (!draws(i + 3 * static_cast<std::size_t>(GetParam()), 6)) continue;
    const std::string& model = models[i];
    units.push_back(std::make_unique<Fmu>(make_fmu(model, GetParam(), kSourcesOnly), false));
    files.push_back(units.back()->folder() + "/modelDescription.xml");
    if (GetParam() == 3) files.push_back(units.back()->folder() + "/sources/buildDescription.xml");
    expect_consistent(*units.back(), model + ": ");
  }
  ASSERT_GE(units.size(), models.size() / 6);
  const support::ProcessResult result = validate(GetParam(), files);
  EXPECT_EQ(result.status, 0) << result.output;
}

INSTANTIATE_TEST_SUITE_P(Versions, Schema, testing::Values(2, 3));

/// What TOML may hold and XML may not; and a parameter that is called as the time is.
TEST_P(Schema, HoldsForTextsOfAnyCharacters) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/odd.toml", unit = folder.path() + "/odd.fmu";
  support::write_file(model,
                      "[model]\nname = \"odd\"\ndescription = \"a\\uFFFEc\\uFFFFd \\\" <&> \\U0001F600\"\n"
                      "[parameters]\nm = { value = 2, unit = \"kg\", description = \"\\uFFFF]]>\" }\n"
                      "time = { value = 0.1, unit = \"m\" }\n"
                      "[[body]]\nname = \"cart\"\nmass = \"m\"\ncenter_of_mass = [\"time\", 0, "
                      "0]\n[[joint]]\nname = \"slide\"\n"
                      "type = \"prismatic\"\nparent = \"world\"\nchild = \"cart\"\naxis = [1, 0, 0]\n");
  const support::ProcessResult made =
      support::run_process({command_folder() + "/jourdain", "fmu", model, "--fmi", std::to_string(GetParam()),
                            kSourcesOnly, "-o", unit});
  ASSERT_EQ(made.status, 0) << made.output;
  const Fmu fmu(unit, false);
  EXPECT_EQ(fmu.variable("time_parameter").at("causality"), "parameter");
  const support::ProcessResult result = validate(GetParam(), {fmu.folder() + "/modelDescription.xml"});
  EXPECT_EQ(result.status, 0) << result.output;
}

TEST(SchemaOfTests, RefusesWhatTheStandardDoes) {
  const Fmu fmu(make_fmu("pendulum", 3, kSourcesOnly), false);
  const std::string file = fmu.folder() + "/modelDescription.xml";
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS);
  tinyxml2::XMLElement* variable =
      document.RootElement()->FirstChildElement("ModelVariables")->FirstChildElement();
  const auto is_valid_with = [&](const char* attribute, const char* value) {
    const std::string before = variable->Attribute(attribute) ? variable->Attribute(attribute) : "";
    variable->SetAttribute(attribute, value);
    EXPECT_EQ(document.SaveFile(file.c_str()), tinyxml2::XML_SUCCESS);
    before.empty() ? variable->DeleteAttribute(attribute) : variable->SetAttribute(attribute, before.c_str());
    return validate(3, {file}).status == 0;
  };
  EXPECT_TRUE(is_valid_with("description", "another"));
  EXPECT_FALSE(is_valid_with("causality", "state"));
  EXPECT_FALSE(is_valid_with("unit", "furlong"));
  EXPECT_FALSE(is_valid_with("valueReference", "1"));
  EXPECT_FALSE(is_valid_with("start", "nan"));
  EXPECT_FALSE(is_valid_with("colour", "red"));
}

/// What is said of one variable, those attributes in one line.
std::string said(const Fmu& fmu, const std::string& name) {
  const Attributes& variable = fmu.variable(name);
  std::string line;
  for (const char* attribute : {"causality", "variability", "initial", "unit", "start", "min", "max"})
    if (variable.count(attribute)) line += (line.empty() ? "" : " ") + variable.at(attribute);
  return line;
}

/// Names of what an unknown depends on.
std::vector<std::string> known(const Fmu& fmu, const std::string& group, const std::string& name) {
  std::vector<std::string> names;
  for (const unsigned reference : fmu.dependencies(group, fmu.reference(name)))
    names.push_back(fmu.name_of(reference));
  return names;
}

/// Exponents of kg, m, s, rad of a unit.
std::vector<int> powers(const Fmu& fmu, const std::string& unit) {
  for (auto* one = fmu.root().FirstChildElement("UnitDefinitions")->FirstChildElement("Unit"); one;
       one = one->NextSiblingElement("Unit"))
    if (one->Attribute("name", unit.c_str())) {
      const auto* base = one->FirstChildElement("BaseUnit");
      return {base->IntAttribute("kg"), base->IntAttribute("m"), base->IntAttribute("s"),
              base->IntAttribute("rad")};
    }
  return {};
}

using Names = std::vector<std::string>;

class Description : public testing::TestWithParam<int> {};

TEST_P(Description, OfACartWithAPole) {
  const Fmu fmu(make_fmu("cart_pole", GetParam(), kSourcesOnly), false);
  EXPECT_EQ(said(fmu, "time"), "independent continuous s");
  EXPECT_EQ(said(fmu, "slide"), "output continuous exact m 0");
  EXPECT_EQ(said(fmu, "hinge"), "output continuous exact rad 0.05235987755982989");
  EXPECT_EQ(said(fmu, "hinge_velocity"), "output continuous exact rad/s 0");
  EXPECT_EQ(said(fmu, "der(slide)"), "local continuous calculated m/s");
  EXPECT_EQ(said(fmu, "der(hinge_velocity)"), "local continuous calculated rad/s^2");
  EXPECT_EQ(said(fmu, "push"), "input continuous N 0");
  EXPECT_EQ(said(fmu, "pole_mass"), "parameter tunable exact kg 0.1 0");
  EXPECT_EQ(said(fmu, "gravity[2]"), "local constant exact m/s^2 -9.8");
  EXPECT_EQ(powers(fmu, "N"), (std::vector<int>{1, 1, -2, 0}));
  EXPECT_EQ(powers(fmu, "rad/s^2"), (std::vector<int>{0, 0, -2, 1}));
  EXPECT_EQ(known(fmu, "Derivatives", "der(slide)"), (Names{"slide_velocity"}));
  EXPECT_EQ(known(fmu, "Derivatives", "der(slide_velocity)"), (Names{"hinge", "hinge_velocity", "push"}));
  EXPECT_EQ(known(fmu, "Outputs", "slide"), (Names{"slide"}));
  References states;
  for (const char* name : {"slide", "hinge", "slide_velocity", "hinge_velocity"})
    states.push_back(fmu.reference(name));
  EXPECT_EQ(fmu.states(), states);
  const std::string about = fmu.root().Attribute("description");
  EXPECT_NE(about.find("steps of 0.001 s with rk4; their error is not assured"), std::string::npos) << about;
}

/// Seven angles, one of which is a state.
TEST_P(Description, OfALinkage) {
  const Fmu fmu(make_fmu("squeezer", GetParam(), kSourcesOnly), false);
  EXPECT_EQ(said(fmu, "beta"), "output continuous exact rad -0.06171389001427645");
  EXPECT_EQ(said(fmu, "Theta"), "output continuous calculated rad");
  EXPECT_EQ(said(fmu, "der(Theta)"), "local continuous calculated rad/s");
  EXPECT_EQ(said(fmu, "common_pin.position[0]"), "output continuous calculated m");
  EXPECT_EQ(said(fmu, "common_pin.rotation[2][2]"), "output continuous calculated 1");
  EXPECT_EQ(said(fmu, "drive"), "parameter tunable exact N m 0.033");
  EXPECT_EQ(said(fmu, "c0"), "parameter tunable exact N/m 4530");
  EXPECT_EQ(said(fmu, "K5.mass"), "local constant exact kg 0.0705");
  EXPECT_EQ(powers(fmu, "N m"), (std::vector<int>{1, 2, -2, 0}));
  EXPECT_EQ(powers(fmu, "N/m"), (std::vector<int>{1, 0, -2, 0}));
  EXPECT_EQ(powers(fmu, "1"), (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(fmu.states(), (References{fmu.reference("beta"), fmu.reference("beta_velocity")}));
  EXPECT_EQ(known(fmu, "Derivatives", "der(beta_velocity)"), (Names{"beta", "beta_velocity"}));
  EXPECT_EQ(known(fmu, "Outputs", "Omega"), (Names{"beta"}));
  EXPECT_EQ(known(fmu, "Outputs", "common_pin.position[2]"), Names{});
}

TEST_P(Description, OfAFreeBody) {
  const Fmu fmu(make_fmu("quadrotor", GetParam(), kSourcesOnly), false);
  EXPECT_EQ(said(fmu, "root_z"), "output continuous exact m 1");
  EXPECT_EQ(said(fmu, "root_qw"), "output continuous exact 1 1");
  EXPECT_EQ(said(fmu, "der(root_qw)"), "local continuous calculated 1/s");
  EXPECT_EQ(said(fmu, "der(root_wx)"), "local continuous calculated rad/s^2");
  EXPECT_EQ(said(fmu, "thrust3"), "input continuous N 0");
  EXPECT_EQ(said(fmu, "drag"), "parameter tunable exact N s/m 0.0009");
  EXPECT_EQ(powers(fmu, "N s/m"), (std::vector<int>{1, 0, -1, 0}));
  EXPECT_EQ(powers(fmu, "1/s"), (std::vector<int>{0, 0, -1, 0}));
  EXPECT_EQ(fmu.states().size(), 13u);
  EXPECT_EQ(known(fmu, "Outputs", "pose.rotation[0][0]"),
            (Names{"root_qw", "root_qx", "root_qy", "root_qz"}));
  EXPECT_EQ(known(fmu, "Derivatives", "der(root_wz)"),
            (Names{"root_wx", "root_wy", "root_wz", "thrust1", "thrust2", "thrust3", "thrust4"}));
  EXPECT_EQ(known(fmu, "Derivatives", "der(root_x)"), (Names{"root_vx"}));
  const auto* exchange = fmu.root().FirstChildElement("ModelExchange");
  EXPECT_STREQ(GetParam() == 2 ? exchange->Attribute("completedIntegratorStepNotNeeded")
                               : exchange->Attribute("needsCompletedIntegratorStep"),
               GetParam() == 2 ? "false" : "true");
}

TEST_P(Description, HasTheRangesOfParametersAndCoordinates) {
  const Fmu fmu(make_fmu("spring_four_bar", GetParam(), kSourcesOnly), false);
  const Attributes& crank = fmu.variable("crank");
  EXPECT_LT(std::stod(crank.at("min")), std::stod(crank.at("start")));
  EXPECT_GT(std::stod(crank.at("max")), std::stod(crank.at("start")));
}

INSTANTIATE_TEST_SUITE_P(Versions, Description, testing::Values(2, 3));

}  // namespace
}  // namespace jourdain::tests
