// MJCF files that are damaged or too large are read or refused, in time.
#include <gtest/gtest.h>

#include <filesystem>

#include "agreement/shared_data.hpp"
#include "model/read/read.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

/// The messages for a text, which is taken exactly where they have no error.
std::string messages(const std::string& text) {
  support::Diagnostics diagnostics("m.mjcf", text);
  const bool taken = read_mechanism(diagnostics).has_value();
  EXPECT_NE(taken, diagnostics.has_errors()) << text;
  return diagnostics.format();
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

std::string in_body(const std::string& elements) {
  return R"(<mujoco><worldbody><body name="b"><joint name="j"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)" +
         elements + "</body></worldbody></mujoco>";
}

TEST(HostileMjcf, DamagedFiles) {
  for (const auto& file : std::filesystem::directory_iterator(tests::data_path("mjcf"))) {
    const std::string text = support::read_file(file.path().string());
    for (std::size_t i = 0; i < text.size(); i += 3) messages(text.substr(0, i));
    for (std::size_t i = 0; i < text.size(); ++i) {
      std::string damaged = text;
      damaged[i] = "x\"<9- ="[i % 7];
      messages(damaged);
    }
  }
}

TEST(HostileMjcf, NumbersOfAnySize) {
  for (const char* number : {"1e308", "-1e308", "1e-308", "0", "-1", "1e400", "nan", "inf"})
    for (const char* attribute :
         {"size", "mass", "density", "pos", "fromto", "quat", "euler", "axisangle", "zaxis"})
      messages(in_body("<body><joint/><geom type=\"capsule\" size=\"1 1\" " + std::string(attribute) + "=\"" +
                       repeated(std::string(number) + " ", 3) + "\"/></body>"));
}

TEST(HostileMjcf, TooManyOfAKind) {
  const auto refused = [](const std::string& text, const std::string& why) {
    EXPECT_NE(messages(text).find(why), std::string::npos) << why;
  };
  refused(in_body(repeated("<joint/>", 10'000)), "more than 1000 bodies and joints");
  refused(in_body(repeated("<body/>", 10'000)), "more than 1000 bodies and joints");
  refused(in_body(repeated("<geom/>", 60'000)), "more than 50000");
  refused(in_body(repeated("<frame>", 40) + repeated("</frame>", 40)), "nested deeper than 32 levels");
  const auto with = [](const std::string& section) { return in_body("").insert(8, section); };
  refused(with(repeated("<default><geom/></default>", 10'000)), "<default> stands there more than 100 times");
  refused(with("<actuator>" + repeated("<motor joint=\"j\"/>", 10'000) + "</actuator>"),
          "more than 1000 actuators");
  refused(with("<equality>" + repeated("<joint joint1=\"j\"/>", 10'000) + "</equality>"),
          "more than 1000 equalities");
  std::string attributes;
  for (int i = 0; i < 100'000; ++i) attributes += " a" + std::to_string(i) + "='1'";
  refused(in_body("<geom" + attributes + "/>"), "more than 1000");
}

}  // namespace
}  // namespace jourdain::model
