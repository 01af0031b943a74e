#include "properties/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "extremes/extreme_scenes.hpp"
#include "loops/plan/plan.hpp"
#include "programs/functions.hpp"
#include "properties/random_linkages.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_rolling.hpp"
#include "properties/random_scene.hpp"
#include "properties/random_tree.hpp"
#include "support/uniform.hpp"

namespace jourdain::tests {

namespace {

std::string vector(support::Uniform& uniform, double size) {
  return fmt::format("[{}, {}, {}]", uniform(-size, size), uniform(-size, size), uniform(-size, size));
}

/// `count` hinges in a row whose sizes are spread over `orders` orders of magnitude.
model::Mechanism chain(int count, double orders, std::uint64_t seed) {
  support::Uniform uniform(seed + 1);
  const auto spread = [&] { return std::pow(10, uniform(-orders / 2, orders / 2)); };
  std::string text = "[model]\nname = \"chain\"\n";
  for (int i = 0; i < count; ++i) {
    const double mass = spread(), moment = spread(), length = orders > 0 ? spread() : 1;
    text += fmt::format(
        "[[body]]\nname = \"b{0}\"\nmass = {1}\ncenter_of_mass = {2}\ninertia = {{ xx = {3}, yy = {4}, zz = "
        "{5} }}\n"
        "[[joint]]\nname = \"j{0}\"\ntype = \"revolute\"\nparent = \"{6}\"\nchild = \"b{0}\"\naxis = {7}\n"
        "position = {8}\nrpy = {9}\nstiffness = {10}\ninitial_position = {11}\n",
        i, mass, vector(uniform, 0.3 * length), moment, 1.1 * moment, 1.3 * moment,
        i == 0 ? "world" : fmt::format("b{}", i - 1), vector(uniform, 1), vector(uniform, length),
        vector(uniform, 3), spread(), uniform(-3, 3));
  }
  return read_scene(text);
}

model::Mechanism linkage(std::uint64_t seed) {
  const std::vector<LinkageKind>& kinds = linkage_kinds();
  return random_linkage(kinds[seed % kinds.size()], seed / kinds.size()).mechanism;
}

/// The first sizes of a family are the smallest: seeds go through all of them.
model::Mechanism extreme(std::uint64_t seed) {
  const std::vector<Family>& families = extreme_families();
  const Family& family = families[seed % families.size()];
  const std::vector<int> list = exponents(family);
  return read_scene(family.description(std::ldexp(1.0, list[seed / families.size() * 7 % list.size()])));
}

}  // namespace

const std::vector<ValidKind>& valid_kinds() {
  static const std::vector<ValidKind> kinds = {
      {"trees", 3000, 15},     {"scenes", 3000, 15},   {"loops", 1200, 5},
      {"linkages", 900, 5},    {"extremes", 1500, 40}, {"chains of 2 to 12, 24 orders", 400, 10},
      {"chains of 20", 20, 1}, {"chains of 60", 6, 1}, {"chains of 200", 1, 0},
      {"rolling", 400, 4}};
  return kinds;
}

model::Mechanism valid_mechanism(const ValidKind& kind, std::uint64_t seed) {
  if (kind.name == "trees") return random_tree(seed);
  if (kind.name == "scenes") return random_scene(seed);
  if (kind.name == "loops") return random_loops(seed);
  if (kind.name == "rolling") return random_rolling(seed);
  if (kind.name == "linkages") return linkage(seed);
  if (kind.name == "extremes") return extreme(seed);
  if (kind.name == "chains of 20") return chain(20, 0, seed);
  if (kind.name == "chains of 60") return chain(60, 0, seed);
  if (kind.name == "chains of 200") return chain(200, 0, seed);
  return chain(static_cast<int>(2 + seed % 11), 24, seed);
}

std::string refusal(const model::Mechanism& mechanism, std::uint64_t seed) {
  CompileOptions options;
  options.functions.clear();
  constexpr std::size_t kSmall = 12;  // derivatives of long chains take long
  const bool small = seed % 8 == 0 && model::lay_out_coordinates(mechanism).velocity_count() <= kSmall;
  for (const programs::FunctionInfo& function : programs::all_functions())
    if (!function.stepper && (small || !function.holds_derivatives))
      options.functions.push_back(function.name);
  support::Diagnostics diagnostics("", "");
  if (!mechanism.loops.empty()) {
    options.loops = loops::plan_loops(mechanism, diagnostics);
    if (!options.loops) return "";  // a diagnostic is no refusal by validation
  }
  const CompiledModel compiled = compile(mechanism, options);
  return compiled.verdict.accepted() ? "" : compiled.verdict.failures.front();
}

}  // namespace jourdain::tests
