// Trees that move in planes: accelerations by those of links against accelerations by those of joints, in 77 digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "compile/program_cost.hpp"
#include "dynamics/absolute_rates.hpp"
#include "dynamics/link_equations.hpp"
#include "extremes/extreme_scenes.hpp"
#include "passes/pipeline.hpp"
#include "programs/tree_functions.hpp"
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

/// Largest difference of two programs of one function, in 77 digits, in units of their numbers' scale.
long double difference(const ir::Program& found, const ir::Program& wanted, const validate::Point& point) {
  const std::vector<ScaledReal> a = ir::interpret(found, point.exact), b = ir::interpret(wanted, point.exact);
  long double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (const long double scale = b[i].scale(); scale > 0)
      largest = std::max(largest, std::fabs(static_cast<long double>(a[i] - b[i])) / scale);
  return largest;
}

TEST(PlanarTrees, MoveAlikeByAnglesBetweenLinks) {
  int by_angles = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const model::Mechanism mechanism = read_scene(planar_tree(seed));
    kinematics::Statements statements;
    by_angles += dynamics::has_link_equations(dynamics::Scene(mechanism, {}, statements));
    for (const bool regroup : {true, false})
      for (const dynamics::PlanarForm form :
           {dynamics::PlanarForm::kAngles, dynamics::PlanarForm::kAnglesToUnitRows}) {
        dynamics::DerivationOptions angles;
        angles.planar = true;
        angles.planar_form = form;
        angles.link_tree.regroup = regroup;
        const ir::Program found = lower_accelerations(mechanism, angles),
                          wanted = lower_accelerations(mechanism, {});
        for (const validate::Sample& sample : validate::draw_samples(mechanism, 3))
          EXPECT_LE(difference(found, wanted, validate::point_at(mechanism, sample)), 1e-40L) << seed;
      }
  }
  EXPECT_GE(by_angles, 60);
}

TEST(PlanarTrees, HaveTheSameMassesAndForcesByAnglesBetweenLinks) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const model::Mechanism mechanism = read_scene(planar_tree(seed));
    dynamics::DerivationOptions angles;
    angles.from_links = {true, true, true, true, true};
    const dynamics::Equations found = dynamics::derive_equations(mechanism, angles),
                              wanted = dynamics::derive_equations(mechanism);
    for (const ir::FunctionId function :
         {ir::FunctionId::kMassMatrix, ir::FunctionId::kKBar, ir::FunctionId::kQBar,
          ir::FunctionId::kInverseDynamics, ir::FunctionId::kKineticEnergy})
      for (const validate::Sample& sample : validate::draw_samples(mechanism, 3))
        EXPECT_LE(
            difference(programs::lower_function(found, function), programs::lower_function(wanted, function),
                       validate::point_at(mechanism, sample)),
            1e-40L)
            << seed << " " << ir::name_of(function);
  }
}

TEST(PlanarTrees, MayEndInALinkWhoseRotorAloneResists) {
  const model::Mechanism mechanism = read_scene(R"toml([model]
name = "rotor"
gravity = [0, -9.81, 0]
[[body]]
name = "arm"
mass = 2
center_of_mass = [0.3, 0, 0]
inertia = [0, 0.1, 0.1]
[[body]]
name = "tool"
mass = 0
inertia = [0, 0, 0]
[[joint]]
name = "shoulder"
type = "revolute"
parent = "world"
child = "arm"
axis = [0, 0, 1]
[[joint]]
name = "wrist"
type = "revolute"
parent = "arm"
child = "tool"
axis = [0, 0, 1]
position = [0.5, 0, 0]
[[actuator]]
joint = "wrist"
rotor_inertia = 0.02
)toml");
  EXPECT_LE(choose_articulation(mechanism, {}).error.units, 8);
}

TEST(PlanarTrees, GoByAnglesOnlyWhereThatTakesNoMoreArithmetic) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const model::Mechanism mechanism = read_scene(planar_tree(seed));
    const Articulation chosen = choose_articulation(mechanism, {});
    if (chosen.form == dynamics::PlanarForm::kWorkingFrames) continue;
    const auto arithmetic = [&](bool planar, dynamics::PlanarForm form) {
      dynamics::DerivationOptions options;
      options.planar = planar;
      options.planar_form = form;
      return cost_behind_passes(lower_accelerations(mechanism, options)).arithmetic;
    };
    EXPECT_EQ(arithmetic(true, chosen.form), chosen.operations);
    EXPECT_LE(chosen.operations, arithmetic(true, dynamics::PlanarForm::kWorkingFrames)) << seed;
  }
}

/// Median over 200 states of the error in double, as emitted, in units of rounding of the largest acceleration.
double median_units(const model::Mechanism& mechanism, dynamics::PlanarForm form) {
  dynamics::DerivationOptions options;
  options.planar = true;
  options.planar_form = form;
  ir::Module module{{}, {lower_accelerations(mechanism, options)}};
  const ir::Program zdot = passes::optimise(std::move(module), {"hoist"}).module.functions[0];
  std::vector<double> units;
  for (const validate::Sample& sample : validate::draw_samples(mechanism, 200)) {
    const validate::Point point = validate::point_at(mechanism, sample);
    const std::vector<ScaledReal> exact = ir::interpret(zdot, point.exact);
    const std::vector<double> found = ir::interpret(zdot, point.rounded);
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      largest = std::max(largest, std::fabs(static_cast<double>(exact[i])));
      error = std::max(error, std::fabs(static_cast<double>(exact[i] - ScaledReal(found[i]))));
    }
    units.push_back(error / largest / 0x1p-53);
  }
  std::nth_element(units.begin(), units.begin() + 100, units.end());
  return units[100];
}

TEST(PlanarTrees, LoseNoMoreDigitsByAnglesThanByWorkingFrames) {
  constexpr double kSampling = 1.1;  // medians of a few hundred states scatter by that much
  for (const char* name : {"double_pendulum.toml", "chain4.toml"}) {
    const model::Mechanism mechanism = read_model(model_path(name));
    EXPECT_LE(median_units(mechanism, choose_articulation(mechanism, {}).form),
              kSampling * median_units(mechanism, dynamics::PlanarForm::kWorkingFrames))
        << name;
  }
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
