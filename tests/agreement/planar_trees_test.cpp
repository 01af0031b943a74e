// Trees that move in planes: accelerations by those of links against accelerations by those of joints, in 77 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "dynamics/absolute_rates.hpp"
#include "extremes/extreme_scenes.hpp"
#include "properties/refusals.hpp"

namespace jourdain::tests {
namespace {

using support::ScaledReal;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool happens(double share) { return number(0, 1) < share; }
  int below(int count) { return static_cast<int>(number(0, count)); }

 private:
  std::mt19937_64 random_;
};

/// Slides on the ground and on slides, then turns about one axis either way, with branches, springs, dampers,
/// rotors and a force.
std::string planar_tree(std::uint64_t seed) {
  Draw draw(seed);
  const int count = 2 + draw.below(6);
  const auto vector = [&](double reach) {
    return fmt::format("[{}, {}, {}]", draw.number(-reach, reach), draw.number(-reach, reach),
                       draw.number(-reach, reach));
  };
  std::string text =
      "[model]\nname = \"planar_tree\"\ngravity = " + vector(9) + "\n[parameters]\nlength = 0.7\n";
  for (int i = 0; i < count; ++i)
    text +=
        fmt::format("[[body]]\nname = \"b{}\"\nmass = {}\ncenter_of_mass = {}\ninertia = [0.1, 0.12, 0.14]\n",
                    i, draw.number(0.2, 3), vector(0.3));
  std::vector<bool> slides;
  for (int i = 0; i < count; ++i) {
    const int parent = draw.below(i + 1) - 1;
    const bool on_slides = parent < 0 || slides[static_cast<std::size_t>(parent)];
    slides.push_back(on_slides && i + 1 < count && draw.happens(0.3));
    text += fmt::format(
        "[[joint]]\nname = \"j{0}\"\ntype = \"{1}\"\nparent = \"{2}\"\nchild = \"b{0}\"\naxis = {3}\n", i,
        slides.back() ? "prismatic" : "revolute", parent < 0 ? "world" : fmt::format("b{}", parent),
        slides.back()       ? vector(1)
        : draw.happens(0.5) ? "[0.6, 0, 0.8]"
                            : "[-0.6, 0, -0.8]");
    text += fmt::format("position = [\"length\", {}, {}]\n", draw.number(-1, 1), draw.number(-1, 1));
    if (draw.happens(0.5)) text += "damping = 0.3\nstiffness = 4.0\n";
    if (draw.happens(0.4))
      text += fmt::format("[[actuator]]\njoint = \"j{}\"\ngear_ratio = 5\nrotor_inertia = 0.01\n", i);
  }
  return text +
         fmt::format(
             "[[frame]]\nname = \"f\"\nbody = \"b{}\"\nposition = {}\n[[force]]\nframe = \"f\"\nforce = {}\n",
             count - 1, vector(0.3), vector(3));
}

TEST(PlanarTrees, MoveAlikeByAccelerationsOfLinksAndOfJoints) {
  int by_links = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const model::Mechanism mechanism = read_scene(planar_tree(seed));
    dynamics::DerivationOptions links;
    links.planar = true;
    kinematics::Statements statements;
    by_links += dynamics::moves_in_planes(dynamics::Scene(mechanism, {}, statements));
    const ir::Program found = lower_accelerations(mechanism, links),
                      wanted = lower_accelerations(mechanism, {});
    for (const validate::Sample& sample : validate::draw_samples(mechanism, 3)) {
      const validate::Point point = validate::point_at(mechanism, sample);
      const std::vector<ScaledReal> a = ir::interpret(found, point.exact),
                                    b = ir::interpret(wanted, point.exact);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_LE(std::fabs(static_cast<long double>(a[i] - b[i])), 1e-40L * b[i].scale()) << "seed " << seed;
    }
  }
  EXPECT_GE(by_links, 50);
}

TEST(PlanarTrees, WithoutSharedFramesGoByJoints) {
  const model::Mechanism mechanism = read_model(model_path("chain4.toml"));
  dynamics::DerivationOptions joints, links;
  joints.link_tree.share_parallel = links.link_tree.share_parallel = false;
  links.planar = true;
  EXPECT_EQ(print(lower_accelerations(mechanism, links)), print(lower_accelerations(mechanism, joints)));
}

TEST(Articulation, SpendsOperationsWhereTheFewestLoseAllDigitsAndSaysSo) {
  for (const ValidKind& kind : valid_kinds()) {
    if (kind.name != "chains of 2 to 12, 24 orders") continue;
    const Articulation chosen = choose_articulation(valid_mechanism(kind, 206), {});
    EXPECT_GT(chosen.spent, 0u);
    EXPECT_LT(chosen.error.units, chosen.fewest_error.units);
    EXPECT_NE(accuracy_sentence(chosen).find(fmt::format("{} operations more", chosen.spent)),
              std::string::npos);
    return;
  }
  FAIL() << "no such chains";
}

}  // namespace
}  // namespace jourdain::tests
