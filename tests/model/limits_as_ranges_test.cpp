// Limits of robot files are ranges of what is proven of loops, where a description adds loop joints.
#include <gtest/gtest.h>

#include "model/read/read.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::model {
namespace {

/// Two bars on the world; the first may turn from -1 to 2 rad, the second, from 0.5, not to zero.
constexpr const char* kBars = R"(<robot name="bars"><link name="base"/>
  <link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="left" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="right" type="revolute"><origin xyz="1 0 0"/><parent link="base"/><child link="b"/><axis xyz="0 1 0"/>
    <limit lower="0.5" upper="2" effort="1" velocity="1"/></joint>
</robot>)";

constexpr const char* kRod = R"(
[[frame]]
name = "tip_a"
body = "a"
position = [0, 0, 1]
[[frame]]
name = "tip_b"
body = "b"
position = [0, 0, 1]
[[loop]]
name = "coupler"
type = "rod"
from = "tip_a"
to = "tip_b"
length = 1
)";

Mechanism read_with(const std::string& more) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/model.toml";
  support::write_file(folder.path() + "/bars.urdf", kBars);
  support::write_file(model, "[model]\nname = \"m\"\n[[import]]\nfile = \"bars.urdf\"\n" + more);
  support::Diagnostics diagnostics(model, support::read_file(model));
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

std::optional<std::array<double, 2>> range(const Mechanism& mechanism, std::size_t joint) {
  return mechanism.joints.at(joint).coordinates.at(0).range;
}

TEST(Limits, AreRangesWhereLoopsAreAndTheStartLiesWithin) {
  const Mechanism closed = read_with(kRod);
  EXPECT_EQ(range(closed, 0), (std::array<double, 2>{-1, 2}));
  EXPECT_FALSE(range(closed, 1));  // it starts at 0
}

TEST(Limits, AreNoRangesOfTreesAndCouplers) {
  EXPECT_FALSE(range(read_with(""), 0));
  EXPECT_FALSE(
      range(read_with("[[coupler]]\nname = \"c\"\ncoordinate = \"right\"\nfollows = \"left\"\n"), 0));
}

TEST(Limits, GiveWayToWhatAnOverrideSays) {
  const std::string start = "[[override]]\njoint = \"left\"\n";
  EXPECT_EQ(range(read_with(std::string(kRod) + start + "range = [-0.5, 0.5]\n"), 0),
            (std::array<double, 2>{-0.5, 0.5}));
  EXPECT_FALSE(range(read_with(std::string(kRod) + start + "initial_position = 2.5\n"), 0));
}

}  // namespace
}  // namespace jourdain::model
