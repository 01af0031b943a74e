// Values in windows of memory: which they are, and that functions compute the same to the bit.
#include "emit/far_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "emit/cpp/printer.hpp"
#include "emit/model_code.hpp"
#include "emit/sine_blocks.hpp"
#include "emit/tree_interpreter.hpp"
#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

using namespace emit;

Expression y(int i) { return name("y")[i]; }

std::string text(const Statements& body) { return cpp::statements_text(body, {}, 0); }

/// Statements that nothing far reads.
void add_others(Statements& body, int count) {
  for (int k = 0; k < count; ++k) body.push_back(set(name("r")[k], y(k)));
}

std::string without_others(std::string text) {
  std::string rest;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    if (text.compare(begin, 2, "r[") != 0) rest += text.substr(begin, end - begin);
    begin = end;
  }
  return rest;
}

TEST(FarValues, AreReadFromAWindowThatIsAddressedAnew) {
  Statements body = {constant("a", y(0) * y(1)), constant("near", name("a") + y(2))};
  add_others(body, 40);
  body.push_back(constant("b", name("a") + name("near")));
  body.push_back(set(name("r")[50], name("b") * name("b")));
  EXPECT_EQ(without_others(text(with_far_values(body).value())),
            "Real far1_0[32];\n"
            "const Real a = y[0] * y[1];\n"
            "Real (&near0)[32] = detail::nearby(far1_0);\n"
            "near0[0] = a;\n"
            "const Real near = a + y[2];\n"
            "near0[1] = near;\n"
            "const Real b = near0[0] + near0[1];\n");
}

TEST(FarValues, OfSinesAreWrittenThere) {
  Statements body = {{Declare{{}, Declare::Change::kFree, {{"s"}, {"c"}}}},
                     {Call{"sine_cosine2", {y(0), name("s"), name("c")}, true}},
                     constant("a", name("s") * name("c"))};
  add_others(body, 40);
  body.push_back(set(name("r")[50], name("s") * name("a")));
  EXPECT_EQ(without_others(text(with_far_values(body).value())),
            "Real far1_0[32];\n"
            "Real c;\n"
            "Real (&near0)[32] = detail::nearby(far1_0);\n"
            "detail::sine_cosine2(y[0], near0[0], c);\n"
            "const Real a = near0[0] * c;\n"
            "near0[1] = a;\n");
}

TEST(FarValues, ThatAreReadOftenAreReadOnce) {
  Statements body = {constant("a", y(0) * y(1)), constant("a_", y(3))};
  add_others(body, 40);
  for (int k = 0; k < 4; ++k) body.push_back(set(name("q")[k], name("a") * y(k)));
  const std::string all = text(with_far_values(body).value());
  EXPECT_NE(all.find("const Real a__ = near0[0];\nq[0] = a__ * y[0];\n"), std::string::npos) << all;
  EXPECT_NE(all.find("q[3] = a__ * y[3];\n"), std::string::npos) << all;
}

TEST(FarValues, StayWhereLoopsReadThem) {
  Statements body = {constant("a", y(0) * y(1))};
  add_others(body, 40);
  body.push_back(loop("i", 3, {set(name("q")[name("i")], name("a"))}));
  EXPECT_FALSE(with_far_values(body));
  body.back() = set(name("q")[0], name("a"));
  EXPECT_TRUE(with_far_values(body));
}

/// All functions of a model, with all that is far in windows and as they were.
void expect_the_same(const std::string& model, const std::vector<std::string>& functions) {
  const CompiledText compiled = compiled_text(model, functions);
  const programs::SceneFacts& scene = compiled.compiled.facts;
  const ModelCode code = model_code(scene, compiled.compiled.functions, compiled.compiled.module);
  ModelCode far = code;
  std::size_t kept = 0;
  for (CutFunction& cut : far.functions)
    if (std::optional<Statements> body = with_far_values(cut.function.body)) {
      cut.function.body = std::move(*body);
      ++kept;
    }
  EXPECT_GT(kept, 0u) << model;
  TreeInterpreter plain(code, scene), with_windows(far, scene);
  Value state = plain.call("initial_state", {}), h;
  for (std::size_t k = 0; k < scene.positions.size(); ++k)
    state.members["y"].entries[long(k)].number += 0.1 * std::sin(double(k) + 1);
  for (std::size_t k = 0; k < scene.velocities.size(); ++k)
    state.members["z"].entries[long(k)].number = std::cos(double(k));
  for (const CutFunction& cut : code.functions) {
    if (cut.function.name != "forward_dynamics" && cut.function.name != "mass_matrix") continue;
    Value input, before, after;
    const bool has_input = cut.function.parameters.size() > 3;
    const auto call = [&](TreeInterpreter& tree, Value& result) {
      tree.call(cut.function.name, has_input ? std::vector<Value*>{&state, &input, &result}
                                             : std::vector<Value*>{&state, &result});
    };
    call(plain, before);
    call(with_windows, after);
    ASSERT_FALSE(before.entries.empty()) << model;
    for (const auto& [i, row] : before.entries) {
      EXPECT_EQ(row.number, after.entries[i].number) << model << " " << cut.function.name << " " << i;
      for (const auto& [j, entry] : row.entries)
        EXPECT_EQ(entry.number, after.entries[i].entries[j].number) << model << " " << i << " " << j;
    }
  }
}

TEST(FarValues, AreTheSameToTheBit) {
  for (const char* model : {"panda", "quadruped", "puma560"})
    expect_the_same(model, {"initial_state", "forward_dynamics", "mass_matrix"});
}

}  // namespace
}  // namespace jourdain::tests
