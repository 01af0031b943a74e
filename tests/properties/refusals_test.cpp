// No valid mechanism is refused: a sample of what `build/release/refusals` tries, and scenes that were refused once.
#include "properties/refusals.hpp"

#include <gtest/gtest.h>

#include "agreement/shared_data.hpp"
#include "extremes/extreme_scenes.hpp"
#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

TEST(Refusals, NoValidMechanismIsRefused) {
  for (const ValidKind& kind : valid_kinds())
    for (std::uint64_t seed = 0; seed < (draws_all_cases() ? kind.test : (kind.test + 15) / 16); ++seed)
      EXPECT_EQ(refusal(valid_mechanism(kind, seed), seed), "") << kind.name << ", seed " << seed;
}

/// One body of 2 kg on a revolute joint; `body`, `joint`: what else is said of them.
std::string hinged(const std::string& body, const std::string& joint, const std::string& rest = "") {
  return "[model]\nname = \"hinged\"\n[[body]]\nname = \"b\"\nmass = 2\n" + body +
         "\n[[joint]]\nname = \"j\"\ntype = \"revolute\"\nparent = \"world\"\nchild = \"b\"\n" + joint +
         "\n" + rest;
}

struct OnceRefused {
  const char* what;
  std::string text;
};

class WhatWasRefusedOnce : public ::testing::TestWithParam<OnceRefused> {};

TEST_P(WhatWasRefusedOnce, Passes) {
  constexpr std::uint64_t kWithDerivatives = 0;
  EXPECT_EQ(refusal(read_scene(GetParam().text), kWithDerivatives), "");
}

INSTANTIATE_TEST_SUITE_P(
    Refusals, WhatWasRefusedOnce,
    ::testing::Values(
        OnceRefused{"turntable", hinged("center_of_mass = [0.5, 1, 0]", "rpy = [0, 0, 2]")},
        OnceRefused{"acceleration_that_is_zero",
                    hinged("center_of_mass = [-0.5, 0, 1]", "axis = [1, -0.3, 1]",
                           "[[frame]]\nname = \"f\"\nbody = \"b\"\nposition = [1, 0, 0]\n"
                           "[[output]]\nname = \"o\"\nkind = \"acceleration\"\nframe = \"f\"\n")},
        OnceRefused{
            "jacobian_with_zeros",
            "[model]\nname = \"m\"\n[[body]]\nname = \"a\"\nmass = 1\n[[body]]\nname = \"b\"\nmass = 1\n"
            "[[body]]\nname = \"c\"\nmass = 1\ncenter_of_mass = [0, 1, 0]\n"
            "[[joint]]\nname = \"j0\"\ntype = \"free\"\nparent = \"world\"\nchild = \"a\"\n"
            "[[joint]]\nname = \"j1\"\ntype = \"prismatic\"\nparent = \"a\"\nchild = \"b\"\n"
            "position = [1, 0, 0]\nrpy = [0, 1, 1]\n"
            "[[joint]]\nname = \"j2\"\ntype = \"revolute\"\nparent = \"b\"\nchild = \"c\"\n"
            "[[frame]]\nname = \"f\"\nbody = \"b\"\n"
            "[[output]]\nname = \"o\"\nkind = \"jacobian\"\nframe = \"f\"\n"},
        OnceRefused{"axis_of_a_cad_export",
                    hinged("inertia = [1, 1, 1]", "axis = [1, 0, 6.123e-17]",
                           "[[output]]\nname = \"o\"\nkind = \"reaction\"\njoint = \"j\"\n")},
        OnceRefused{"output_of_time",
                    hinged("center_of_mass = [0, -1, 0]", "axis = [0, 0, 1]",
                           "[[output]]\nname = \"o\"\nkind = \"expression\"\nvalue = \"t*j\"\n")},
        OnceRefused{"rounded_right_angles", hinged("center_of_mass = [0.3, 0.2, 0.1]\ninertia = [1, 2, 2.5]",
                                                   "axis = [0, 0, 1]\nrpy = [1.5708, 3.1416, 3.14159]")},
        OnceRefused{
            "equilibrium",  // gravity has no part in it, but for rounding
            "[model]\nname = \"cart\"\n[[body]]\nname = \"a\"\nmass = 40\n[[body]]\nname = \"b\"\nmass = 8\n"
            "[[joint]]\nname = \"j\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"a\"\n"
            "axis = [0.8, 0, 0.6]\nmotion = \"0.05*sin(12*t)\"\n[[joint]]\nname = \"k\"\ntype = "
            "\"prismatic\"\n"
            "parent = \"a\"\nchild = \"b\"\naxis = [1, 0, 0]\nstiffness = 900\n"},
        OnceRefused{"huge_angle", hinged("center_of_mass = [0, -1, 0]", "initial_position = 1e17")}),
    [](const auto& scene) { return scene.param.what; });

TEST(Refusals, NoneOfTheSeedsThatWereRefused) {
  const std::pair<const char*, std::uint64_t> seeds[] = {{"loops", 162}, {"linkages", 11}, {"linkages", 379}};
  for (const ValidKind& kind : valid_kinds())
    for (const auto& [name, seed] : seeds)
      if (kind.name == name) {
        EXPECT_EQ(refusal(valid_mechanism(kind, seed), seed), "") << name << " " << seed;
      }
}

TEST(Refusals, NoneOfALoopWithAHugeMass) {
  model::Mechanism mechanism = read_model(model_path("n_four_bar.toml"));
  mechanism.bodies[1].mass = model::Expression(2.5e10);
  EXPECT_EQ(refusal(mechanism, 0), "");
}

}  // namespace
}  // namespace jourdain::tests
