// Directional and adjoint derivatives against differences of what the FMU computes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fmu/importer.hpp"

namespace jourdain::tests {
namespace {

/// What is differentiated at one state of a model.
class Differentiated {
 public:
  explicit Differentiated(Instance& instance, const Fmu& fmu)
      : instance_(instance), fmu_(fmu), knowns_(fmu.states()) {
    for (unsigned k = 1; k < fmu.reference(""); ++k)
      if (fmu.variable(fmu.name_of(k)).at("causality") == "input") knowns_.push_back(k);
    unknowns_ = fmu.structure("Derivatives");
    for (const unsigned output : fmu.structure("Outputs")) unknowns_.push_back(output);
  }

  const References& knowns() const { return knowns_; }
  const References& unknowns() const { return unknowns_; }

  void move(const Numbers& at) {
    const std::size_t states = fmu_.states().size();
    const auto middle = at.begin() + static_cast<std::ptrdiff_t>(states);
    ASSERT_EQ(instance_.set_states(Numbers(at.begin(), middle)), kOk);
    ASSERT_EQ(instance_.set(References(knowns_.begin() + static_cast<std::ptrdiff_t>(states), knowns_.end()),
                            Numbers(middle, at.end())),
              kOk);
  }

  /// By central differences, by one known.
  Numbers differences(Numbers at, std::size_t known) {
    constexpr double kStep = 1e-5;
    at[known] += kStep;
    move(at);
    Numbers ahead = instance_.values(unknowns_);
    at[known] -= 2 * kStep;
    move(at);
    const Numbers behind = instance_.values(unknowns_);
    for (std::size_t k = 0; k < ahead.size(); ++k) ahead[k] = (ahead[k] - behind[k]) / (2 * kStep);
    return ahead;
  }

 private:
  Instance& instance_;
  const Fmu& fmu_;
  References knowns_, unknowns_;
};

struct Case {
  const char* model;
  int version;
};

class Derivatives : public testing::TestWithParam<Case> {};

TEST_P(Derivatives, AreThoseOfDifferences) {
  const Fmu fmu(make_fmu(GetParam().model, GetParam().version, "--step 0.001"));
  Instance instance(fmu, true);
  instance.start();
  Differentiated model(instance, fmu);
  Numbers at = instance.values(model.knowns());
  for (std::size_t k = 0; k < at.size(); ++k) at[k] += 0.1 * std::sin(static_cast<double>(k) + 1);
  for (std::size_t known = 0; known < at.size(); ++known) {
    const Numbers expected = model.differences(at, known);
    model.move(at);
    Numbers found;
    ASSERT_EQ(instance.directional({model.unknowns(), {model.knowns()[known]}, {1}}, found), kOk);
    double size = 1;
    for (const double number : expected) size = std::max(size, std::fabs(number));
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 1e-6 * size)
          << fmu.name_of(model.unknowns()[k]) << " by " << fmu.name_of(model.knowns()[known]);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Derivatives,
                         testing::Values(Case{"cart_pole", 2}, Case{"panda", 2}, Case{"squeezer", 2},
                                         Case{"cart_pole", 3}, Case{"four_bar", 3},
                                         Case{"double_wishbone", 3}),
                         [](const auto& one) {
                           return fmt::format("{}_{}", one.param.model, one.param.version);
                         });

TEST(Derivatives, OfTheAdjointAreTransposed) {
  const Fmu fmu(make_fmu("four_bar", 3, "--step 0.001"));
  Instance instance(fmu, true);
  instance.start();
  const Differentiated model(instance, fmu);
  for (std::size_t u = 0; u < model.unknowns().size(); ++u) {
    Numbers row, column;
    ASSERT_EQ(instance.adjoint({{model.unknowns()[u]}, model.knowns(), {1}}, row), kOk);
    for (std::size_t k = 0; k < model.knowns().size(); ++k) {
      ASSERT_EQ(instance.directional({{model.unknowns()[u]}, {model.knowns()[k]}, {1}}, column), kOk);
      EXPECT_EQ(row[k], column[0]);
    }
  }
}

TEST(Derivatives, AreRefusedWhereTheModelHasNone) {
  const Fmu fmu(make_fmu("quadrotor", 3, "--step 0.001"));
  EXPECT_STREQ(fmu.root().FirstChildElement("ModelExchange")->Attribute("providesDirectionalDerivatives"),
               "false");
  Instance instance(fmu, true);
  instance.start();
  Numbers result;
  EXPECT_EQ(instance.directional({fmu.structure("Derivatives"), {fmu.states()[0]}, {1}}, result), kError);
  EXPECT_EQ(instance.log().size(), 1u);
}

}  // namespace
}  // namespace jourdain::tests
