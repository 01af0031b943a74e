// The reader knows C++: what small texts compute, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "readback/interpreter.hpp"
#include "readback/node_table.hpp"
#include "readback/parser.hpp"

namespace jourdain::tests {
namespace {

using readback::Interpreter;
using readback::NodeTable;
using readback::Number;
using readback::Unit;
using readback::Value;

/// A file with one function `f` of a, b, c, d, whose body is given; more may stand before it.
std::string file_with(const std::string& body, const std::string& before = "") {
  return "namespace test {\n" + before +
         "template <class Real> JOURDAIN_FUNCTION\nReal f(const Real& a, const Real& b, const Real& c, const "
         "Real& d) noexcept "
         "{\n" +
         body + "\n}\n}  // namespace test\n";
}

/// What `f` computes, as text: "add(old[0], old[1])".
std::string computed(const std::string& body, const std::string& before = "") {
  const support::FileText file = {"test.hpp", file_with(body, before)};
  Unit unit;
  readback::parse(unit, {&file});
  NodeTable table;
  Interpreter run(unit, table);
  std::vector<Value> arguments;
  for (std::size_t i = 0; i < 4; ++i) {
    arguments.push_back(run.make(run.types().number()));
    run.set(arguments.back(), table.mark(i));
  }
  const Value result = run.call("", "f", arguments);
  std::string text = table.print(run.number(result), 20);
  for (const auto& [from, to] : {std::pair("old[0]", "a"), {"old[1]", "b"}, {"old[2]", "c"}, {"old[3]", "d"}})
    for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, 6, to);
  return text;
}

/// Why the text is refused, or that it is not.
std::string refusal(const std::string& body, const std::string& before = "") {
  try {
    computed(body, before);
  } catch (const readback::Refusal& refusal) {
    return refusal.what();
  }
  return "accepted";
}

TEST(Reader, GroupsAsCppDoes) {
  EXPECT_EQ(computed("return a - (b + c);"), "sub(a, add(b, c))");
  EXPECT_EQ(computed("return a - b + c;"), "add(sub(a, b), c)");
  EXPECT_EQ(computed("return a - b - c;"), "sub(sub(a, b), c)");
  EXPECT_EQ(computed("return -a * b;"), "mul(neg(a), b)");
  EXPECT_EQ(computed("return -(a * b);"), "neg(mul(a, b))");
  EXPECT_EQ(computed("return -a + b;"), "add(neg(a), b)");
  EXPECT_EQ(computed("return a / (b * c);"), "div(a, mul(b, c))");
  EXPECT_EQ(computed("return (a / b) * c;"), "mul(div(a, b), c)");
  EXPECT_EQ(computed("return a / b * c;"), "mul(div(a, b), c)");
  EXPECT_EQ(computed("return a / b / c;"), "div(div(a, b), c)");
  EXPECT_EQ(computed("return a + b * c - d;"), "sub(add(a, mul(b, c)), d)");
  EXPECT_EQ(computed("return (a + b) * (c - d);"), "mul(add(a, b), sub(c, d))");
  EXPECT_EQ(computed("return a * -b;"), "mul(a, neg(b))");
  EXPECT_EQ(computed("return a - -b;"), "sub(a, neg(b))");
}

TEST(Reader, KeepsTheOrderOfOperandsAndTheBitsOfLiterals) {
  EXPECT_NE(computed("return a + b;"), computed("return b + a;"));
  EXPECT_NE(computed("return a * b;"), computed("return b * a;"));
  EXPECT_EQ(computed("return a * Real(0.1);"), "mul(a, 0.1)");
  EXPECT_EQ(computed("return a * Real(0.1000000000000000055);"), computed("return a * Real(0.1);"));
  EXPECT_NE(computed("return a * Real(0.10000000000000002);"), computed("return a * Real(0.1);"));
  EXPECT_EQ(computed("return Real(-0.0);"), "-0");
  EXPECT_EQ(computed("return Real(0.0);"), "0");
  EXPECT_EQ(computed("return -Real(2.5e-3);"), "neg(0.0025)");
  EXPECT_EQ(computed("return Real(1e-320);"), "1e-320");
  EXPECT_EQ(computed("return Real(3);"), "3");
}

TEST(Reader, FollowsStatements) {
  EXPECT_EQ(computed("Real s = Real(0.0);\nfor (int i = 0; i < 3; ++i) s = s + a;\nreturn s;"),
            "add(add(add(0, a), a), a)");
  EXPECT_EQ(computed("Real v[3];\nfor (int i = 3 - 1; i >= 0; --i) v[i] = Real(i);\nreturn v[0] + v[2];"),
            "add(0, 2)");
  EXPECT_EQ(computed("Real M[2][2];\nM[0][1] = M[1][0] = a;\nreturn M[1][0] * M[0][1];"), "mul(a, a)");
  EXPECT_EQ(computed("int n = 1;\nif (n < 1) return a;\nelse return b;"), "b");
  EXPECT_EQ(
      computed("const Real v[2] = {a, -b};\nReal s = c;\nfor (const Real& x : v) s = s - x;\nreturn s;"),
      "sub(sub(c, a), neg(b))");
  EXPECT_EQ(computed("Real x = a;\n{\n  Real x = b;\n  x = c;\n}\nreturn x;"), "a");
  EXPECT_EQ(computed("Real v[4];\nReal(&e)[4] = v;\ne[2] = a;\nreturn v[2];"), "a");
}

constexpr const char* kOverloads = R"(
namespace detail {
JOURDAIN_FUNCTION inline double g(double x) noexcept { return ::sin(x); }
template <class Real> JOURDAIN_FUNCTION
Real g(const Real& x) noexcept { return sin(x); }
template <class Real> JOURDAIN_FUNCTION
Real h(const Real& x, const Real&) noexcept { return x; }
template <class Real, class Other> JOURDAIN_FUNCTION
Real h(const Other&, const Real& y) noexcept { return y; }
template <class Real> JOURDAIN_FUNCTION
void fill(const Real& x, Real* to) noexcept { to[1] = x; }
template <class Real> JOURDAIN_FUNCTION
void fill3(const Real& x, Real (&to)[3]) noexcept { to[2] = x; }
constexpr int order[] = {2, 0, 1};
}
)";

TEST(Reader, ChoosesOverloadsAndPassesReferences) {
  EXPECT_EQ(computed("return detail::g(a);", kOverloads), "sin(a)");
  EXPECT_EQ(computed("return detail::h(a, b);", kOverloads), "a");
  EXPECT_EQ(computed("Real w[4];\ndetail::fill(a, w + 2);\nreturn w[3];", kOverloads), "a");
  EXPECT_EQ(computed("Real w[3];\ndetail::fill3(a, w);\nreturn w[2];", kOverloads), "a");
  EXPECT_THAT(refusal("Real w[4];\ndetail::fill3(a, w);\nreturn w[2];", kOverloads),
              testing::HasSubstr("no function fits"));
  EXPECT_THAT(refusal("Real w[2];\ndetail::fill(a, w + 1);\nreturn w[1];", kOverloads),
              testing::HasSubstr("beyond"));
}

constexpr const char* kStructs = R"(
template <class Real = double>
struct Pair {
  Real first = Real(1.0), rest[2];
  struct {
    Real inner;
  } group;
  static constexpr int size = 3;
};
)";

TEST(Reader, HoldsStructs) {
  EXPECT_EQ(computed("Pair<Real> p;\np.group.inner = a;\nPair<Real> q = p;\nq.first = b;\nreturn p.first * "
                     "q.group.inner;",
                     kStructs),
            "mul(1, a)");
  EXPECT_EQ(computed("Real v[Pair<Real>::size];\nv[2] = a;\nreturn v[2];", kStructs), "a");
  EXPECT_THAT(refusal("Pair<Real> p;\nreturn p.rest[0];", kStructs), testing::HasSubstr("no value yet"));
}

TEST(Reader, RefusesWithThePlaceAndWhatWasFound) {
  EXPECT_EQ(refusal("return a + ;"), "test.hpp:4: expected an expression, found ';'");
  EXPECT_EQ(refusal("return a ? b : c;"), "test.hpp:4: expected no conditional expression, found '?'");
  EXPECT_EQ(refusal("\nwhile (a) return b;"), "test.hpp:5: expected a name, found 'while'");
}

TEST(Reader, RefusesWhatIsNoCppOrMeansNothing) {
  for (const char* body : {"return a",
                           "return a b;",
                           "return a +* b;",
                           "return a--b;",
                           "a += b;\nreturn a;",
                           "return 0.5;",
                           "return a * 2;",
                           "return a * 0.5;",
                           "return e;",
                           "Real x;\nreturn x;",
                           "const Real x = a;\nx = b;\nreturn x;",
                           "Real x = a;\nReal x = b;\nreturn x;",
                           "a = b;\nreturn a;",
                           "Real v[2];\nreturn v[2];",
                           "Real v[2];\nreturn v[-1];",
                           "int i = a;\nreturn b;",
                           "return a.b;",
                           "return a[0];",
                           "return sine(a);",
                           "return ::sin(a);",
                           "if (a) return b;\nreturn c;",
                           "for (int i = 0; i < 1; --i) Real x = a;\nreturn b;",
                           "return;",
                           "Real x = a;",
                           "return a;;}",

                           "return Real(017);",
                           "return Real(0x10);",
                           "return Real(1.0f);",
                           "return Real(1e999);",
                           "return a == b;",
                           "return a < b;",
                           "return \"a\";",
                           "return a /* b;",
                           "#define x y\nreturn a;",
                           "return a \\\n+ b;",
                           "auto x = a;\nreturn x;",
                           "static Real x = a;\nreturn x;",
                           "double x = 1.0;\nreturn a;",
                           "return Real(a, b);",
                           "return Real();",
                           "goto x;"})
    EXPECT_NE(refusal(body), "accepted") << body;
  for (const char* body :
       {"Pair<3> p;\nreturn a;", "return static_cast<3>(a);", "return static_cast<Pair<3>>(a);"})
    EXPECT_NE(refusal(body, kStructs), "accepted") << body;
}

TEST(Reader, IsNotMisledByCommentsSpacesAndParentheses) {
  EXPECT_EQ(computed("return /* - */ a // + b\n + \t (((b)));"), "add(a, b)");
}

}  // namespace
}  // namespace jourdain::tests
