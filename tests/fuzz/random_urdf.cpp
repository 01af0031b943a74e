#include "fuzz/random_urdf.hpp"

#include <fmt/format.h>

#include <vector>

#include "fuzz/hostile_values.hpp"
#include "fuzz/xml_mutation.hpp"

namespace jourdain::tests {

namespace {

std::string triple(double size, Random& random) {
  static const std::vector<double> kAngles = {0, 1.5707963267948966, 1.5708, -1.57, 3.14159};
  if (random.chance(0.3)) return fmt::format("{} 0 {}", one_of(kAngles, random), one_of(kAngles, random));
  return fmt::format("{:.4f} {:.4f} {:.4f}", random.uniform(-size, size), random.uniform(-size, size),
                     random.uniform(-size, size));
}

/// Moments that satisfy the triangle inequality, small products.
std::string link(const std::string& name, Random& random) {
  const double base = random.uniform(0.01, 0.5);
  return fmt::format(
      "  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n      <mass "
      "value=\"{:.3f}\"/>\n"
      "      <inertia ixx=\"{:.4f}\" ixy=\"{:.4f}\" ixz=\"0\" iyy=\"{:.4f}\" iyz=\"0\" izz=\"{:.4f}\"/>\n    "
      "</inertial>\n"
      "{}  </link>\n",
      name, triple(0.3, random), random.uniform(0.2, 20), base, 0.05 * base, 1.2 * base, 1.3 * base,
      random.chance(0.3) ? "    <visual><geometry><box size=\"1 1 1\"/></geometry></visual>\n" : "");
}

std::string joint(std::size_t index, const std::string& parent, const std::string& type, Random& random) {
  static const std::vector<std::string> kAxes = {"1 0 0", "0 1 0", "0 0 1", "0 0 -1", "0.6 0 0.8", "1 2 3"};
  const std::string dynamics = random.chance(0.4) ? "    <dynamics damping=\"0.5\" friction=\"0\"/>\n" : "";
  return fmt::format(
      "  <joint name=\"joint{0}\" type=\"{1}\">\n    <parent link=\"{2}\"/>\n    <child link=\"link{0}\"/>\n"
      "    <origin xyz=\"{3}\" rpy=\"{4}\"/>\n    <axis xyz=\"{5}\"/>\n"
      "    <limit lower=\"-2\" upper=\"2\" effort=\"10\" velocity=\"3\"/>\n{6}  </joint>\n",
      index, type, parent, triple(0.5, random), triple(3, random), one_of(kAxes, random), dynamics);
}

}  // namespace

std::string random_urdf(Random& random) {
  static const std::vector<std::string> kTypes = {"revolute", "continuous", "prismatic", "fixed", "revolute"};
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"robot\">\n" + link("link0", random);
  const std::size_t count = 1 + random.below(5);
  for (std::size_t i = 1; i <= count; ++i) {
    text += link(fmt::format("link{}", i), random);
    text += joint(i, fmt::format("link{}", random.below(i)), i == 1 ? "revolute" : one_of(kTypes, random),
                  random);
  }
  if (random.chance(0.3)) text += "  <transmission name=\"drive\"><type>simple</type></transmission>\n";
  return text + "</robot>\n";
}

std::string mutated_urdf(const std::string& text, int times, Random& random) {
  static const XmlWords kWords{
      .elements = {"link", "joint", "robot", "inertial", "mass", "axis", "origin", "mimic", "xacro:macro",
                   "gazebo:x", "transmission", "Link", "linkk", "parent"},
      .values = {"", " ", "1 2", "1 2 3 4", "1,2,3", "${x}", "nan nan nan", "1e999 0 0", "0 0 0",
                 "1e308 1e308 1e308", "1e-320 0 0", "0x10", "floating", "planar", "fixed", "prismatic",
                 "continuous", "world", "1 0 1e-17"}};
  return mutated_xml(text, kWords, times, random);
}

}  // namespace jourdain::tests
