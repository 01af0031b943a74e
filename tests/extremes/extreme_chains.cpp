#include "extremes/extreme_chains.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "support/files.hpp"

namespace jourdain::tests {

namespace {

std::string body(const std::string& name, const Segment& s) {
  const double l = s.length, square = s.mass * l * l;
  return fmt::format(
      "[[body]]\nname = \"{}\"\nmass = {}\ncenter_of_mass = [{}, {}, {}]\ninertia = [{}, {}, {}]\n", name,
      s.mass, s.center[0] * l, s.center[1] * l, s.center[2] * l, s.moments[0] * square, s.moments[1] * square,
      s.moments[2] * square);
}

Segment with_moments(Segment segment, double x, double y, double z) {
  const double moments[] = {x, y, z};
  std::copy_n(moments, 3, segment.moments);
  return segment;
}

Segment with_center(Segment segment, double x, double y, double z) {
  const double center[] = {x, y, z};
  std::copy_n(center, 3, segment.center);
  return segment;
}

/// A mass at the end of a massless bar along x.
Segment point_mass(const std::string& joint, double mass) {
  return {joint, mass, 1, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
}

}  // namespace

std::string revolute(char axis) {
  return fmt::format("type = \"revolute\"\naxis = [{}, {}, {}]\n", int(axis == 'x'), int(axis == 'y'),
                     int(axis == 'z'));
}

std::string universal() { return "type = \"universal\"\naxis = [0, 0, 1]\nsecond_axis = [1, 0, 0]\n"; }
std::string ball_joint() { return "type = \"spherical\"\n"; }
std::string free_joint() { return "type = \"free\"\n"; }

std::string chain(const std::vector<Segment>& segments, double gravity) {
  std::string text = fmt::format("[model]\nname = \"chain\"\ngravity = [0, {}, 0]\n", -gravity);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    text += body(fmt::format("body{}", i), segments[i]);
    text += fmt::format("[[joint]]\nname = \"joint{}\"\nchild = \"body{}\"\n{}", i, i, segments[i].joint);
    if (i == 0) {
      text += "parent = \"world\"\n";
      continue;
    }
    const Segment& inner = segments[i - 1];
    text += fmt::format("parent = \"body{}\"\nposition = [{}, {}, {}]\n", i - 1, inner.next[0] * inner.length,
                        inner.next[1] * inner.length, inner.next[2] * inner.length);
  }
  return text;
}

std::vector<Segment> spatial_links() {
  return {{revolute('z')}, {revolute('x')}, {revolute('y')}, {revolute('z')}};
}

std::vector<Segment> planar_links() {
  return {{revolute('z')}, {revolute('z')}, {revolute('z')}, {revolute('z')}};
}

std::string double_pendulum(double m1, double m2) {
  return chain({point_mass(revolute('z'), m1), point_mass(revolute('z'), m2)});
}

std::string flying_arm(double base, double link) {
  return chain({{free_joint(), base}, {revolute('z'), link}, {revolute('x'), link}});
}

std::string thin_bodies(double t) {
  const double small = t * t;
  return chain({with_moments({ball_joint()}, 0.25, 0.25 * small, 0.25 + 0.25 * small),
                with_moments({revolute('x')}, 0.25 * small, 0.25, 0.25),
                with_moments({universal()}, small, 1, 1 + small)});
}

std::string gimballed_mass(double x, double y, double z) {
  // It starts out of the lock: a start in it is refused.
  return chain(
      {with_center(point_mass(universal() + "second = { initial_position = 0.375 }\n", 1), x, y, z)});
}

std::string gimballed_rotor(double moment) {
  Segment rings = with_moments(with_center({universal()}, 0, 0, 0), moment, moment, moment);
  std::fill_n(rings.next, 3, 0.0);
  return chain({rings, with_moments(with_center({revolute('z')}, 0, 0, 0.5), 0.25, 0.25, 0.5)});
}

std::string springs(double stiffness) {
  std::vector<Segment> links = spatial_links();
  links[1].joint += fmt::format("stiffness = {}\nrest = 0.25\n", stiffness);
  return chain(links) +
         fmt::format("[[spring]]\nfrom = \"world\"\nto = \"body3\"\nstiffness = {}\nfree_length = 0.5\n",
                     stiffness);
}

std::string bob_on_spring() {
  return chain({with_center({free_joint()}, 0, 0, 0)}) +
         "[[spring]]\nfrom = \"world\"\nto = \"body0\"\nstiffness = 4096\nfree_length = 0.5\n";
}

std::string screw_hinge_slide(double pitch) {
  const std::string screw = fmt::format("type = \"screw\"\naxis = [0, 0, 1]\npitch = {}\n", pitch);
  return chain({{screw}, {revolute('x')}, {"type = \"prismatic\"\naxis = [0, 1, 0]\n"}});
}

std::string geared_hinge(double ratio) {
  return chain(spatial_links()) +
         fmt::format("[[actuator]]\njoint = \"joint1\"\ngear_ratio = {}\nrotor_inertia = 0.0009765625\n",
                     ratio);
}

std::string driven_links(double rate) {
  return chain(
      {{revolute('y') + fmt::format("motion = \"{}*t\"\n", 1.25 * rate)}, {revolute('z')}, {revolute('x')}});
}

std::string tunable_body(double lever) {
  return fmt::format(
      "[model]\nname = \"body\"\n[parameters]\nm = 2\nc = {}\nJ = 0.5\n[[body]]\nname = \"b\"\nmass = \"m\"\n"
      "center_of_mass = [\"c\", \"c/2\", \"-c/4\"]\ninertia = [\"J\", \"2*J\", \"2.5*J\"]\n"
      "[[joint]]\nname = \"j\"\nparent = \"world\"\nchild = \"b\"\n{}",
      lever, free_joint());
}

std::string distant_arm(double distance) {
  const std::string oblique = "rpy = [0.5, 0.25, -0.75]\n";
  std::vector<Segment> links = {{revolute('x')}, {revolute('y') + oblique}, {revolute('x') + oblique}};
  links[0].joint += fmt::format("position = [{}, {}, {}]\n", distance, distance / 2, -distance) + oblique;
  return chain(links);
}

std::string tunable_distant_arm(double distance) {
  const std::string oblique = "rpy = [\"a\", \"a/2\", -0.75]\n";
  std::vector<Segment> links = {{revolute('x') + oblique},
                                {revolute('y') + oblique},
                                {"type = \"cylindrical\"\naxis = [0, 0, 1]\n" + oblique}};
  links[0].joint += "position = [\"d\", \"d/2\", \"-d\"]\n";
  return chain(links) + fmt::format("[parameters]\nd = {}\na = 0.5\n", distance);
}

std::string panda() { return support::read_file(std::string(JOURDAIN_SOURCE_DIR) + "/models/panda.toml"); }

}  // namespace jourdain::tests
