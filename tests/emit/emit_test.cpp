#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "agreement/compiled_batch.hpp"
#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"
#include "emit/body.hpp"
#include "emit/cpp/index_constants.hpp"
#include "emit/cpp/printer.hpp"
#include "emit/cpp/structs.hpp"
#include "emit/layout.hpp"
#include "emit/templates.hpp"
#include "emit/unique_names.hpp"
#include "ir/builder.hpp"
#include "programs/output_names.hpp"
#include "support/check.hpp"

namespace jourdain::emit {
namespace {

TEST(Names, AreIdentifiersThatDiffer) {
  Names names({"state"});
  EXPECT_EQ(names.unique("table_0a1b2c", "t"),
            "table_0a1b2c_value");  // what a table's function may be called
  EXPECT_EQ(names.unique("table_force", "t"), "table_force");
  EXPECT_EQ(names.unique("w3_x", "t0"), "w3_x");
  EXPECT_EQ(names.unique("w3_x", "t0"), "w3_x_2");
  EXPECT_EQ(names.unique("state", "t0"), "state_2");
  EXPECT_EQ(names.unique("", "t0"), "t0");
  EXPECT_EQ(names.unique("double", "t0"), "double_value");
  EXPECT_EQ(names.unique("a.b/c", "t0"), "a_b_c");
  EXPECT_EQ(names.unique("x; system(\"rm\"); //", "t0"), "x_system_rm_");
  EXPECT_EQ(names.unique("__x", "t0"), "v_x");
  EXPECT_EQ(names.unique("3d", "t0"), "v3d");
}

TEST(IndexConstants, HaveNamesThatDiffer) {
  ModelText model;
  EXPECT_EQ(cpp::index_constants(model), "");
  model.facts.positions = {"a.b", "a b", "x"};
  model.facts.inputs = {"int"};
  EXPECT_EQ(cpp::index_constants(model),
            "\n// Entries by name: state.y[index::y_a_b], input.u[index::u_int].\n"
            "namespace index {\n"
            "inline constexpr int y_a_b = 0;\n"
            "inline constexpr int y_a_b_2 = 1;\n"
            "inline constexpr int y_x = 2;\n"
            "inline constexpr int u_int = 0;\n"
            "}  // namespace index\n");
}

TEST(Outputs, HaveNumbersWithTheNamesOfTheirMembers) {
  ModelText model;
  model.facts.outputs = {{"a", "", {{"", 1, 1, false}}},
                         {"b", "", {{"v", 3, 1, false}, {"R", 2, 2, true}, {"row", 1, 2, true}}}};
  std::vector<std::string> names;
  for (const programs::OutputFacts& output : model.facts.outputs)
    for (const programs::OutputMember& member : output.members)
      for (const std::string& name : number_names(output, member)) names.push_back(name);
  EXPECT_THAT(names, testing::ElementsAre("a", "b.v[0]", "b.v[1]", "b.v[2]", "b.R[0][0]", "b.R[0][1]",
                                          "b.R[1][0]", "b.R[1][1]", "b.row[0]", "b.row[1]"));
  for (const char* declared : {"Real a;", "Real v[3];", "Real R[2][2];", "Real row[2];", "} b;"})
    EXPECT_THAT(cpp::output_struct(model), testing::HasSubstr(declared));
}

TEST(Text, CannotLeaveCommentsOrStrings) {
  EXPECT_EQ(comment_text("a\nint main() {} \\"), "a?int main() {} ?");
  EXPECT_EQ(quoted_text("a\"b\\c\n"), "a\\\"b\\\\c?");
}

TEST(Literals, AreTheShortestThatReadBack) {
  EXPECT_EQ(cpp::literal_text(0.1), "Real(0.1)");
  EXPECT_EQ(cpp::literal_text(2), "Real(2.0)");
  EXPECT_EQ(cpp::literal_text(1e22), "Real(1e+22)");
  for (const double x : {1.0 / 3, 9.81, 1.7976931348623157e308, 5e-324}) {
    const std::string text = cpp::literal_text(x);
    EXPECT_EQ(std::strtod(text.c_str() + 5, nullptr), x) << text;
  }
}

TEST(Layout, BreaksLongLinesAtSpaces) {
  std::string line = "const Real x = a";
  for (int i = 0; i < 60; ++i) line += " + b";
  const std::string text = wrapped(line + ";", 2);
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(end - begin, 110u);
}

TEST(Layout, BreaksNoString) {
  const std::string entry = R"("left \" hind leg", )";
  std::string line = "const char* const names[] = {";
  for (int i = 0; i < 30; ++i) line += entry;
  std::istringstream lines(wrapped(line + "nullptr};", 0));
  int entries = 0;
  for (std::string part; std::getline(lines, part);) {
    EXPECT_LE(part.size(), 110u);
    const auto quotes = std::count(part.begin(), part.end(), '"');
    EXPECT_EQ(quotes % 3, 0) << part;
    entries += static_cast<int>(quotes / 3);
  }
  EXPECT_EQ(entries, 30);
}

TEST(Tree, MentionsVariablesButNoMembersOfTheirNames) {
  const Statements statements = {set(name("x"), name("model").dot("state")),
                                 loop("i", 3, {set(name("y")[name("i")], 0.0)})};
  EXPECT_TRUE(mentions(statements, "model"));
  EXPECT_TRUE(mentions(statements, "y"));
  EXPECT_FALSE(mentions(statements, "state"));
}

TEST(Templates, FillEveryHole) {
  EXPECT_EQ(fill("a @X@ b @X@@Y@", {{"X", "1"}, {"Y", "@Z@"}}), "a 1 b 1@Z@");
  EXPECT_THROW(fill("@X@", {}), support::InternalError);
  EXPECT_THROW(template_text("nothing.in"), support::InternalError);
}

TEST(Body, CallsTheArctangentWithBothItsOperands) {
  ir::Builder b;
  const ir::Signed x = b.leaf(ir::LeafKind::kPosition, 0), y = b.leaf(ir::LeafKind::kPosition, 1);
  b.output("r", 0, -1, b.multiply(b.atan2(b.add(x, y), -x), y));
  const Body body = body_of(
      b.finish("angle"), Names({}), [](ir::LeafKind, std::size_t i) { return name("y" + std::to_string(i)); },
      [](const ir::Output&, const Expression& value) { return Statement{Return{value}}; });
  EXPECT_EQ(cpp::statements_text(body.parts[0], {}, 0), "return y1 * detail::arctangent2(y0 + y1, -y0);\n");
}

/// The program with the first position reduced to one turn.
ir::Program reduced(const ir::Program& program) {
  ir::Builder b;
  std::vector<ir::Signed> copy;
  for (const ir::Node& node : program.nodes) {
    const bool angle = node.op == ir::Op::kLeaf && node.leaf == ir::LeafKind::kPosition && node.index == 0;
    const ir::Signed value = b.apply(node, copy.empty() ? ir::Signed{} : copy[node.a.value],
                                     copy.empty() ? ir::Signed{} : copy[node.b.value]);
    copy.push_back(angle ? b.atan2(b.unary(ir::Op::kSin, value), b.unary(ir::Op::kCos, value)) : value);
  }
  for (const ir::Output& output : program.outputs)
    b.output(output.name, output.row, output.column, copy[output.value.value]);
  return b.finish(program.name);
}

TEST(Arctangent, IsEmittedWithItsOverloadsWhereAProgramHasIt) {
  tests::Derived derived = tests::derive(tests::read_model(tests::model_path("pendulum.toml")));
  const tests::EmittedModel plain = tests::emit_model(derived, "plain");
  for (ir::Program& function : derived.module.functions)
    if (function.name == "potential_energy") function = reduced(function);
  const tests::EmittedModel model = tests::emit_model(derived, "turned");
  for (const char* text : {"arctangent2(double y, double x)", "detail::arctangent2(", "return atan2(y, x)"}) {
    EXPECT_THAT(model.files[1].text, ::testing::HasSubstr(text));
    EXPECT_THAT(plain.files[1].text, ::testing::Not(::testing::HasSubstr(text)));
  }
  EXPECT_THAT(model.files[0].text, ::testing::HasSubstr("sin and cos, 1 atan2."));
  EXPECT_THAT(model.files[3].text, ::testing::HasSubstr("\"atan2\": 1"));
  EXPECT_THAT(plain.files[3].text, ::testing::Not(::testing::HasSubstr("atan2")));
  const tests::Sample sample = tests::random_sample(derived.mechanism, 1);
  const double expected = tests::interpreted<double>(derived.module, "potential_energy", sample)[0];
  for (const char* real : {"double", "float"}) {
    const tests::CompiledBatch batch({model}, "g++", real, {"-O1", "-ffp-contract=off"});
    EXPECT_NEAR(batch.evaluate(0, sample).potential, expected, real[0] == 'd' ? 0 : 1e-5);
  }
}

TEST(Body, IsCutIntoPartsOfTheWantedLength) {
  const tests::Derived panda = tests::derive(tests::read_model(tests::model_path("panda.toml")));
  for (const ir::Program& program : panda.module.functions) {
    if (program.name != "forward_dynamics") continue;
    const auto leaf = [](ir::LeafKind kind, std::size_t i) {
      return name(std::string(ir::leaf_name(kind)) + std::to_string(i));
    };
    const auto output = [](const ir::Output& o, const Expression& value) {
      return set(name("zdot")[o.row], value);
    };
    const Body whole = body_of(program, Names({}), leaf, output),
               parts = body_of(program, Names({}), leaf, output, {}, {100, 100});
    EXPECT_EQ(whole.parts.size(), 1u);
    EXPECT_EQ(whole.work_size, 0u);
    EXPECT_GT(parts.parts.size(), 4u);
    EXPECT_GT(parts.work_size, 0u);
    std::multiset<std::string> statements, expected;
    for (const Statement& statement : whole.parts[0]) expected.insert(cpp::statements_text({statement}, {}));
    for (const Statements& part : parts.parts) {
      std::size_t own = 0;
      for (const Statement& statement : part) {
        if (mentions(Statements{statement}, "w")) continue;
        statements.insert(cpp::statements_text({statement}, {}));
        ++own;
      }
      EXPECT_LE(own, 120u);
    }
    EXPECT_EQ(statements, expected);
  }
}

}  // namespace
}  // namespace jourdain::emit
