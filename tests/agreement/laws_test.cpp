// Functions in force laws: which sides of kinks are compared, and that faults planted in them are refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "agreement/judge.hpp"
#include "compile/compile.hpp"
#include "model/read/read.hpp"
#include "properties/random.hpp"
#include "support/constant_array.hpp"
#include "validate/translation.hpp"

namespace jourdain::tests {
namespace {

using ir::Op;

/// Two masses that slide, with this force on the first one.
Derived with_law(const std::string& law, const std::string& more = "") {
  const std::string text = fmt::format(R"([model]
name = "masses"
[parameters]
a = 0.7
[[body]]
name = "b"
mass = 1.2
[[body]]
name = "c"
mass = 0.8
[[joint]]
name = "s"
type = "prismatic"
axis = [1, 0, 0]
parent = "world"
child = "b"
[[joint]]
name = "r"
type = "prismatic"
axis = [0, 0.6, 0.8]
parent = "b"
child = "c"
{}
[[input]]
name = "u"
[[force]]
joint = "s"
value = "{}"
)",
                                       more, law);
  support::Diagnostics diagnostics("masses.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return derive(mechanism.value());
}

validate::Verdict verdict_of(const Derived& derived) {
  return validate::validate_translation(derived.mechanism, derived.equations, derived.module);
}

TEST(Laws, AreComparedOnBothSidesOfKinksFarAndNear) {
  for (const char* law :
       {"max(s - 0.4, 0)", "max(s - 80, 0)", "if(r.rate > 30, s, u)", "abs(s - 1e-3)", "floor(3*t)*s",
        "if(s > 0, if(r > 0, 1, 2), if(r.rate > 0, 3, 4))", "min(max(s, -0.01), 0.01)*r.rate"}) {
    const validate::Verdict verdict = verdict_of(with_law(law));
    EXPECT_TRUE(verdict.accepted()) << law << ": " << verdict.failures.front();
    EXPECT_GT(verdict.kinks.count, 0u) << law;
    EXPECT_EQ(verdict.kinks.on_both_sides, verdict.kinks.count) << law << ": " << in_words(verdict.kinks);
  }
}

TEST(Laws, SayWhatTheyWereNotComparedOn) {
  const validate::Verdict verdict = verdict_of(with_law("max(s - 1e9, 0) + abs(r)"));
  EXPECT_EQ(verdict.kinks.count, 2u);
  EXPECT_EQ(verdict.kinks.on_both_sides, 1u);
}

/// The start is on a kink, or next to it by rounding, where a jump may go either way.
TEST(Laws, MayStartOnAKink) {
  for (const char* law :
       {"if(s < 0, 5, -5)", "if(s - 0.1 - 0.2 < -0.3, 5, -5)", "floor(s/0.1 + 3*0.1 - 0.3)", "sign(s)"}) {
    const validate::Verdict verdict = verdict_of(with_law(law));
    EXPECT_TRUE(verdict.accepted()) << law << ": " << verdict.failures.front();
    EXPECT_GE(verdict.states, 7u) << law;
  }
}

/// A frame that never moves, but for rounding: its speed is on the kink in every state.
TEST(Laws, MayStayOnAKink) {
  const std::string frame = "[[frame]]\nname = \"tip\"\nbody = \"c\"\n";
  for (const char* law : {"abs(tip.y*0.8 - tip.z*0.6)", "max(tip.y*0.8 - tip.z*0.6, 0) + min(s, 0)"}) {
    const validate::Verdict verdict = verdict_of(with_law(law, frame));
    EXPECT_TRUE(verdict.accepted()) << law << ": " << verdict.failures.front();
    EXPECT_GE(verdict.states, 6u) << law;
  }
}

std::string points(Random& random, std::size_t count, bool at_equal_distances) {
  std::string text;
  const double first = random.uniform(-1.5, -1);
  double point = first;
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", at_equal_distances ? first + 0.125 * double(i) : point);
    point += random.uniform(0.1, 5) / double(count);
  }
  return text;
}

/// Of one number or two, of a few points or many.
std::string random_table(Random& random, bool is_grid) {
  const std::size_t n = 2 + random.below(is_grid ? 7 : 40), m = is_grid ? 2 + random.below(7) : 1;
  const char* const kinds[] = {"linear", "spline", "monotone"};
  const bool extends = random.chance(0.3);
  std::string text =
      fmt::format("[[table]]\nname = \"f\"\nx = [{}]\n", points(random, n, random.chance(0.5)));
  if (is_grid) text += fmt::format("y = [{}]\n", points(random, m, random.chance(0.5)));
  text +=
      fmt::format("interpolation = \"{}\"\n", kinds[is_grid && extends ? 0 : random.below(is_grid ? 2 : 3)]);
  if (extends) text += "beyond = \"extend\"\n";
  text += "values = [";
  for (std::size_t i = 0; i < n; ++i) {
    if (is_grid) text += "[";
    for (std::size_t j = 0; j < m; ++j) text += fmt::format("{:.3f}, ", random.uniform(-2, 2));
    if (is_grid) text += "], ";
  }
  return text + "]\n";
}

TEST(Laws, MayBeTables) {
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    const bool is_grid = i % 2 == 1;
    const std::string table = random_table(random, is_grid);
    const Derived derived = with_law(is_grid ? "f(s, r + 0.1*u)*a" : "f(s + 0.3*r.rate) + f(r)", table);
    const validate::Verdict verdict = verdict_of(derived);
    EXPECT_TRUE(verdict.accepted()) << table << verdict.failures.front();
    EXPECT_GT(verdict.states, 3u);
  }
}

/// All of them, so that those count that the states take.
TEST(Laws, AreRefusedWhereEntriesOfATableAreOthers) {
  const std::string table =
      "[[table]]\nname = \"f\"\nx = [-3, -2, -1, 0, 1, 2, 3]\nvalues = [0, 2, 1, 4, -1, 3, 2]\n"
      "interpolation = \"spline\"\n";
  const Derived correct = with_law("f(s) + f(r)", table);
  ASSERT_TRUE(verdict_of(correct).accepted());
  int planted = 0;
  for (std::size_t p = 0; p < correct.module.functions.size(); ++p)
    for (const ir::Node& node : correct.module.functions[p].nodes) {
      if (node.op != Op::kEntry) continue;
      Derived mutant = correct;
      ir::Node& number = mutant.module.functions[p].nodes[node.b.value];
      std::vector<double> values = support::array_of(static_cast<std::uint32_t>(number.literal));
      for (double& value : values) value += 1e-6;
      number.literal = support::number_of_array(values);
      number.tail = {};
      EXPECT_FALSE(verdict_of(mutant).accepted()) << mutant.module.functions[p].name;
      ++planted;
    }
  EXPECT_GT(planted, 4);
}

std::vector<Op> others(Op op) {
  switch (op) {
    case Op::kExp:
      return {Op::kSinh, Op::kCosh};
    case Op::kLog:
    case Op::kSinh:
    case Op::kCosh:
    case Op::kTanh:
    case Op::kAbs:
    case Op::kFloor:
      return {Op::kExp, Op::kNegate, op == Op::kSinh ? Op::kTanh : Op::kSinh};
    case Op::kMin:
      return {Op::kMax};
    case Op::kMax:
      return {Op::kMin};
    case Op::kWhereNegative:
      return {Op::kWhereNotNegative, Op::kMultiply};
    case Op::kWhereNotNegative:
      return {Op::kWhereNegative, Op::kMultiply};
    case Op::kPower:
      return {Op::kMultiply, Op::kAtan2};
    default:
      return {};
  }
}

TEST(Laws, WithPlantedFaultsAreRefused) {
  const Derived correct = with_law(
      "exp(-s^2) + sinh(a*s) + cosh(s.rate) - tanh(s*r) + log(1 + s^2) + pow(1 + r^2, 1.5) + (2 + sin(r))^a +"
      " abs(s.rate)*s.rate + sign(r.rate) + min(s, r) + max(s, u) + mod(t, 0.7) + floor(2*r) + if(s > 0, "
      "sqrt(s), 0) +"
      " if(r.rate <= s.rate, r^2, -s)");
  EXPECT_TRUE(verdict_of(correct).accepted());
  int planted = 0;
  for (std::size_t p = 0; p < correct.module.functions.size(); ++p)
    for (std::size_t i = 0; i < correct.module.functions[p].nodes.size(); ++i) {
      const ir::Node& node = correct.module.functions[p].nodes[i];
      Derived mutant = correct;
      ir::Node& changed = mutant.module.functions[p].nodes[i];
      const auto refuse = [&](const char* what) {
        ++planted;
        EXPECT_FALSE(verdict_of(mutant).accepted()) << mutant.module.functions[p].name << " value " << i
                                                    << ", " << ir::op_name(node.op) << " " << what;
      };
      for (const Op op : others(node.op)) {
        changed.op = op;
        refuse(ir::op_name(op));
      }
      if (!ir::is_function(node.op) || ir::operand_count(node.op) != 2 || node.op == Op::kMin ||
          node.op == Op::kMax)
        continue;
      changed = node;
      std::swap(changed.a, changed.b);
      refuse("with operands exchanged");
    }
  EXPECT_GT(planted, 100);
}

/// Drag that has a kink where the description starts: derivatives are compared beside it.
TEST(Laws, AreDifferentiatedWhereTheyHaveAKinkAtTheStart) {
  const std::string text =
      "[model]\nname = \"glider\"\n[[body]]\nname = \"b\"\nmass = 2\n[[joint]]\nname = \"q\"\ntype = "
      "\"prismatic\"\naxis = [0, 0, 1]\nparent = \"world\"\nchild = \"b\"\n[[force]]\njoint = "
      "\"q\"\nvalue = \"-3*abs(b.vz)\"\n";
  support::Diagnostics diagnostics("glider.toml", text);
  CompileOptions options;
  options.functions = {"forward_dynamics", "linearize"};
  const CompiledModel compiled = compile(model::read_mechanism(diagnostics).value(), options);
  EXPECT_EQ(compiled.verdict.failures, std::vector<std::string>());
  EXPECT_EQ(compiled.verdict.kinks.on, 1U);
  EXPECT_EQ(compiled.verdict.kinks.on_both_sides, 1U);
  for (const validate::Compared& c : compiled.verdict.compared)
    EXPECT_EQ(c.states, compiled.verdict.states - (c.function.starts_with("linearize") ? 1U : 0U))
        << c.function;
}

/// A root of what a law holds at zero does not move there, though a root's slope is infinite at zero.
TEST(Laws, AreDifferentiatedWhereTheyHoldARootAtZero) {
  const auto slope = [](const std::string& law, double y) {
    const std::string text =
        "[model]\nname = \"valve\"\n[[body]]\nname = \"b\"\nmass = 2\n[[joint]]\nname = \"q\"\ntype = "
        "\"prismatic\"\naxis = [1, 0, 0]\nparent = \"world\"\nchild = \"b\"\n[[force]]\njoint = \"q\"\nvalue "
        "= \"" +
        law + "\"\n";
    support::Diagnostics diagnostics("valve.toml", text);
    CompileOptions options;
    options.functions = {"forward_dynamics_derivatives", "residual_derivatives"};
    const CompiledModel compiled = compile(model::read_mechanism(diagnostics).value(), options);
    EXPECT_EQ(compiled.verdict.failures, std::vector<std::string>()) << law;
    Sample sample;
    sample.y = {y};
    sample.z = {0.3};
    return interpreted<double>(compiled.module, "forward_dynamics_derivatives", sample).at(1);
  };
  EXPECT_EQ(slope("sqrt(max(q, 0))", -0.5), 0);
  EXPECT_NEAR(slope("sqrt(max(q, 0))", 0.25), 0.5, 1e-12);
  EXPECT_EQ(slope("max(q, 0)^0.7", -0.5), 0);
  EXPECT_NEAR(slope("max(q, 0)^0.7", 1), 0.35, 1e-12);
  EXPECT_EQ(slope("asin(max(min(q, 1), -1))", 1.5), 0);
  EXPECT_NEAR(slope("asin(max(min(q, 1), -1))", 0.6), 0.5 / 0.8, 1e-12);
  EXPECT_EQ(slope("acos(max(min(q, 1), -1))", -2), 0);
}

}  // namespace
}  // namespace jourdain::tests
