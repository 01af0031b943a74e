#include "model/read/urdf_limits.hpp"

#include <gtest/gtest.h>

namespace jourdain::model {
namespace {

/// Of a joint of this type with this element.
std::optional<Limits> limits_of(const std::string& limit, const std::string& type = "revolute") {
  const auto all = read_urdf_limits("<robot name=\"r\"><link name=\"a\"/><joint name=\"j\" type=\"" + type +
                                    "\">" + limit + "</joint><joint name=\"k\" type=\"fixed\"/></robot>");
  EXPECT_LE(all.size(), 1u);
  return all.empty() ? std::nullopt : std::optional(all.at("j"));
}

TEST(UrdfLimits, AreReadAsTheyStand) {
  const auto all = limits_of("<limit lower=\"-0.5\" upper=\" +1.5 \" velocity=\"2\" effort=\"3e1\"/>");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->lower, -0.5);
  EXPECT_EQ(all->upper, 1.5);
  EXPECT_EQ(all->velocity, 2);
  EXPECT_EQ(all->effort, 30);
}

TEST(UrdfLimits, TakeTheOtherEndForZero) {
  const auto one = limits_of("<limit upper=\"1\"/>", "prismatic");
  ASSERT_TRUE(one);
  EXPECT_EQ(one->lower, 0);
  EXPECT_EQ(one->upper, 1);
  EXPECT_FALSE(one->velocity || one->effort);
}

TEST(UrdfLimits, OfContinuousJointsHaveNoRange) {
  const auto endless = limits_of("<limit lower=\"0\" upper=\"0\" effort=\"7\"/>", "continuous");
  ASSERT_TRUE(endless);
  EXPECT_FALSE(endless->lower || endless->upper);
  EXPECT_EQ(endless->effort, 7);
}

TEST(UrdfLimits, LeaveOutWhatIsNoFiniteNumber) {
  const auto odd = limits_of("<limit lower=\"-inf\" upper=\"1e999\" velocity=\"fast\" effort=\"2 N\"/>");
  EXPECT_FALSE(odd);
  EXPECT_FALSE(limits_of("<limit velocity=\"\" effort=\" \"/>"));
  EXPECT_FALSE(limits_of(""));
  EXPECT_TRUE(read_urdf_limits("no xml <").empty());
  EXPECT_TRUE(read_urdf_limits("").empty());
}

}  // namespace
}  // namespace jourdain::model
