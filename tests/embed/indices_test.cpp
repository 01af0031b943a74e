// Names for entries of y, z and u in programs of users.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "agreement/compiled_batch.hpp"
#include "embed/emitted_models.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

TEST(Indices, StandWhereTheNamesStand) {
  for (int i = 0; i < panda::Model<>::position_count; ++i)
    EXPECT_EQ(panda::position_names[i], fmt::format("joint{}", i + 1));
  static_assert(panda::index::y_joint1 == 0 && panda::index::z_joint7 == 6 && panda::index::u_joint3 == 2);
  EXPECT_STREQ(quadrotor::position_names[quadrotor::index::y_root_qw], "root_qw");
  EXPECT_STREQ(quadrotor::velocity_names[quadrotor::index::z_root_wx], "root_wx");
  EXPECT_STREQ(quadrotor::input_names[quadrotor::index::u_thrust4], "thrust4");
  EXPECT_STREQ(four_bar::position_names[four_bar::index::y_rocker], "rocker");
  EXPECT_STREQ(four_bar::velocity_names[four_bar::index::z_crank], "crank");
}

TEST(Indices, MoveTheCoordinateThatTheyName) {
  const cart_pole::Model<> model;
  cart_pole::State<> state = cart_pole::initial_state(model);
  state.y[cart_pole::index::y_hinge] = 0;
  cart_pole::Input<> input = {};
  input.u[cart_pole::index::u_push] = 1;
  double zdot[2];
  cart_pole::forward_dynamics(model, state, input, zdot);
  EXPECT_GT(zdot[cart_pole::index::z_slide], 0);
  EXPECT_LT(zdot[cart_pole::index::z_hinge], 0);
}

/// Links in a row, joined by joints of these names.
std::string chain(const std::vector<std::string>& joints) {
  std::string text = "<robot name=\"names\">\n  <link name=\"link0\"/>\n";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    text += fmt::format(
        "  <link name=\"link{0}\"><inertial><mass value=\"1\"/>"
        "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>\n"
        "  <joint name=\"{1}\" type=\"continuous\"><origin xyz=\"0 0 1\"/><parent link=\"link{2}\"/>"
        "<child link=\"link{0}\"/><axis xyz=\"0 1 0\"/></joint>\n",
        i + 1, joints[i], i);
  }
  return text + "</robot>\n";
}

TEST(Indices, CompileWhateverJointsAreCalled) {
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/names.urdf", program = folder.path() + "/program";
  support::write_file(
      model, chain({"EOF", "I", "class", "M_PI", "sin", "left arm", "left-arm", "3", "手", "index"}));
  const support::ProcessResult compiled = support::run_process(
      {JOURDAIN_BINARY, "compile", model, "-o", folder.path(), "--functions", "initial_state,mass_matrix"});
  ASSERT_EQ(compiled.status, 0) << compiled.output;
  support::write_file(program + ".cpp", R"(#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <strings.h>
#include "names.hpp"
int main() {
  using namespace names;
  static_assert(index::y_EOF == 0 && index::z_I == 1 && index::u_class == 2 && index::y_M_PI == 3, "");
  static_assert(index::y_sin == 4 && index::y_left_arm == 5 && index::y_left_arm_2 == 6, "");
  static_assert(index::y_3 == 7 && index::y_ == 8 && index::y_index == 9, "");
  return 0;
}
)");
  std::vector<std::string> command = {"g++", "-fsyntax-only", "-I" + folder.path()};
  for (const std::string& flag : strict_flags()) command.push_back(flag);
  command.push_back(program + ".cpp");
  const support::ProcessResult built = support::run_process(command);
  EXPECT_EQ(built.status, 0) << built.output;
}

}  // namespace
}  // namespace jourdain::tests
