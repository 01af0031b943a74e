// Which sines and cosines of a body are computed at once.
#include "emit/sine_blocks.hpp"

#include <gtest/gtest.h>

#include "emit/cpp/printer.hpp"

namespace jourdain::emit {
namespace {

Expression y(int i) { return name("y")[i]; }

void add_pair(Statements& body, const Expression& angle, const std::string& sine, const std::string& cosine) {
  body.push_back({Declare{{}, Declare::Change::kFree, {{sine}, {cosine}}}});
  body.push_back({SineCosine{angle, sine, cosine}});
}

std::string text(const Statements& body) { return cpp::statements_text(body, {}, 0); }

TEST(SineBlocks, TakeFourThenThreeOrTwoAndLeaveTheLast) {
  Statements body;
  for (int i = 0; i < 6; ++i) add_pair(body, y(i), "s" + std::to_string(i), "c" + std::to_string(i));
  const std::string four =
      "Real s0, c0, s1, c1, s2, c2, s3, c3;\n"
      "detail::sine_cosine4(y[0], s0, c0, y[1], s1, c1, y[2], s2, c2, y[3], s3, c3);\n";
  EXPECT_EQ(text(in_sine_blocks(body).value().body),
            four +
                "Real s4, c4, s5, c5;\n"
                "detail::sine_cosine2(y[4], s4, c4, y[5], s5, c5);\n");
  add_pair(body, y(6), "s6", "c6");
  EXPECT_EQ(text(in_sine_blocks(body).value().body),
            four +
                "Real s4, c4, s5, c5, s6, c6;\n"
                "detail::sine_cosine3(y[4], s4, c4, y[5], s5, c5, y[6], s6, c6);\n");
  body.erase(body.begin() + 10, body.end());
  const SineBlocks five = in_sine_blocks(body).value();
  EXPECT_EQ(text(five.body), four +
                                 "Real s4, c4;\n"
                                 "detail::sine_cosine(y[4], s4, c4);\n");
  EXPECT_EQ(five.sizes, std::vector<std::size_t>{4});
}

TEST(SineBlocks, ComeAfterTheSumsOfTheirAnglesAndBeforeTheRest) {
  Statements body;
  add_pair(body, y(0), "s0", "c0");
  body.push_back(constant("t", name("s0") * name("c0")));
  body.push_back(constant("sum", y(0) + y(1)));
  add_pair(body, name("sum"), "s1", "c1");
  EXPECT_EQ(text(in_sine_blocks(body).value().body),
            "const Real sum = y[0] + y[1];\n"
            "Real s0, c0, s1, c1;\n"
            "detail::sine_cosine2(y[0], s0, c0, sum, s1, c1);\n"
            "const Real t = s0 * c0;\n");
}

TEST(SineBlocks, LeaveAnglesThatFollowFromSinesFromTimeOrFromWhatIsWritten) {
  for (const Expression& angle : {name("s0") + y(1), to_angle(name("t")), name("r")[0]}) {
    Statements body;
    add_pair(body, y(0), "s0", "c0");
    body.push_back(set(name("r")[0], name("s0")));
    add_pair(body, angle, "s1", "c1");
    EXPECT_FALSE(in_sine_blocks(body));
  }
}

TEST(SineBlocks, LeaveWhatRunsInALoop) {
  Statements inner, body;
  for (int i = 0; i < 4; ++i) add_pair(inner, y(i), "s" + std::to_string(i), "c" + std::to_string(i));
  body.push_back(loop("i", 3, inner));
  EXPECT_FALSE(in_sine_blocks(body));
}

/// What an angle is made of is looked at once, however often it is used: 2^200 ways lead back here.
TEST(SineBlocks, LookAtEachValueOnce) {
  Statements body;
  body.push_back(constant("v0", y(0) + y(1)));
  for (int i = 1; i <= 200; ++i) {
    const std::string before = "v" + std::to_string(i - 1);
    body.push_back(constant("v" + std::to_string(i), name(before) * y(0) + name(before) * y(1)));
  }
  add_pair(body, y(0), "s0", "c0");
  add_pair(body, name("v200"), "s1", "c1");
  EXPECT_NE(text(in_sine_blocks(body).value().body).find("detail::sine_cosine2(y[0], s0, c0, v200, s1, c1);"),
            std::string::npos);
}

}  // namespace
}  // namespace jourdain::emit
