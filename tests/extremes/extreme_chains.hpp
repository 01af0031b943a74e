// Descriptions of mechanisms whose every number is one of double and of float, as texts a user might write: what the
// families of extreme scenes vary.
#pragma once

#include <string>
#include <vector>

namespace jourdain::tests {

/// 9.81 m/s² as a number of float.
inline constexpr double kGravity = 9.8125;

/// A body and the joint that it hangs on; dimensions are multiples of its length.
struct Segment {
  std::string joint;                       ///< keys of the joint
  double mass = 1;                         ///< kg
  double length = 1;                       ///< m
  double moments[3] = {0.25, 0.375, 0.5};  ///< principal, about the centre of mass, of mass·length²
  double center[3] = {0.5, 0.125, -0.25};  ///< centre of mass, of length
  double next[3] = {1, 0, 0.25};           ///< the next joint, of length
};

/// Keys of joints.
std::string revolute(char axis);
std::string universal();
std::string ball_joint();
std::string free_joint();

/// Segments in a row, the first one on the world; gravity along −y.
std::string chain(const std::vector<Segment>& segments, double gravity = kGravity);

/// Four hinges, no two neighbours parallel; and four parallel ones.
std::vector<Segment> spatial_links();
std::vector<Segment> planar_links();

/// Two point masses on massless bars.
std::string double_pendulum(double m1, double m2);

/// A free body that carries two links.
std::string flying_arm(double base, double link);

/// Bodies of thickness `t` on a ball joint, a hinge and a universal joint: with moments 1, t², 1 + t² a plate,
/// with t², 1, 1 a rod; both are at the bound of what a rigid body may have.
std::string thin_bodies(double t);

/// A point mass at `center` on a universal joint about z and then x.
std::string gimballed_mass(double x, double y, double z);

/// A rotor in a universal joint, its axis on the first one where the second angle is zero; only the moment of
/// the rings, kg m², keeps M regular there.
std::string gimballed_rotor(double moment);

/// Spatial links with a joint spring and a spring to the world.
std::string springs(double stiffness);
/// A free body on a spring that starts at its centre.
std::string bob_on_spring();

std::string screw_hinge_slide(double pitch);
std::string geared_hinge(double ratio);
/// Two links under a hinge that a motor turns at 1.25 times `rate`, rad/s: the angle is a product that is rounded.
std::string driven_links(double rate);

/// A free body whose mass, centre of mass (at `lever`) and moments are tunable, so that nothing is folded
/// before the run.
std::string tunable_body(double lever);

/// Three links of length 1 on oblique axes, the first of which is `distance` away from the inertial origin;
/// with another selection of joints, distance and axes tunable.
std::string distant_arm(double distance);
std::string tunable_distant_arm(double distance);

/// models/panda.toml. Its numbers are not those of float.
std::string panda();

}  // namespace jourdain::tests
