#include "extremes/extreme_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "extremes/extreme_chains.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {

namespace {

/// A chain with each of its links changed.
template <class Change>
std::string changed(std::vector<Segment> links, const Change& change) {
  for (std::size_t i = 0; i < links.size(); ++i) change(links[i], i);
  return chain(links);
}

std::string alternating_masses(const std::vector<Segment>& links, double v) {
  return changed(links, [v](Segment& s, std::size_t i) { s.mass = i % 2 ? v : 1; });
}

std::string alternating_lengths(const std::vector<Segment>& links, double v) {
  return changed(links, [v](Segment& s, std::size_t i) { s.length = i % 2 ? v : 1; });
}

/// Masses from 1 to v, geometrically; v is a cube.
std::string graded_masses(double v) {
  return changed(spatial_links(), [v](Segment& s, std::size_t i) { s.mass = std::pow(std::cbrt(v), i); });
}

std::string scaled_lengths(double v) {
  return changed(spatial_links(), [v](Segment& s, std::size_t) { s.length = v; });
}

std::string scaled_moments(double v) {
  return changed(spatial_links(), [v](Segment& s, std::size_t) {
    for (double& moment : s.moments) moment *= v * v;
  });
}

std::string scaled_throughout(double v) {
  return changed(spatial_links(), [v](Segment& s, std::size_t) {
    s.length = v;
    s.mass = v * v;
  });
}

std::string twelve_links(double v) {
  std::vector<Segment> links;
  for (std::size_t i = 0; i < 12; ++i) links.push_back({revolute("zxyz"[i % 4])});
  return alternating_masses(links, v);
}

void keep(double, Sample&) {}

void scale_rates(double v, Sample& sample) {
  for (double& z : sample.z) z *= v;
}

void scale_positions(double v, Sample& sample) {
  for (double& y : sample.y) y *= v;
}

void scale_state(double v, Sample& sample) {
  scale_positions(v, sample);
  scale_rates(v, sample);
}

void scale_first_rate(double v, Sample& sample) { sample.z[0] *= v; }

/// The second link nearly stands still in the inertial frame.
void counter_rotate(double v, Sample& sample) {
  sample.z[0] *= v;
  sample.z[1] = 0x1p-10 - sample.z[0];
}

/// Puts the second coordinate `v` before `angle`.
auto second_near(double angle) {
  return [angle](double v, Sample& sample) { sample.y[1] = angle - v; };
}

auto always(const std::string& text) {
  return [text](double) { return text; };
}

using std::numbers::pi;

std::vector<Family> scene_families() {
  const auto spatial = spatial_links(), planar = planar_links();
  return {
      {"double pendulum", "m2/m1", -40, 40, 2, [](double v) { return double_pendulum(1, v); }, keep},
      {"spatial links, alternating masses", "m2/m1", -40, 40, 2,
       [spatial](double v) { return alternating_masses(spatial, v); }, keep},
      {"planar links, alternating masses", "m2/m1", -40, 40, 2,
       [planar](double v) { return alternating_masses(planar, v); }, keep},
      {"spatial links, graded masses", "m4/m1", -42, 42, 3, graded_masses, keep},
      {"twelve links, alternating masses", "m2/m1", -40, 40, 8, twelve_links, keep},
      {"free body with an arm", "m_base/m_arm", -40, 40, 2, [](double v) { return flying_arm(v, 1); }, keep},
      {"plates and rods", "thickness/length", -20, 0, 1, thin_bodies, keep},
      {"compound pendulums", "gyration/lever", -20, 20, 1, scaled_moments, keep},
      {"tunable body", "lever, m", -20, 20, 1, tunable_body, keep},
      {"spatial links, all lengths", "length, m", -20, 20, 1, scaled_lengths, keep},
      {"spatial links, alternating lengths", "l2/l1", -20, 20, 1,
       [spatial](double v) { return alternating_lengths(spatial, v); }, keep},
      {"planar links, alternating lengths", "l2/l1", -20, 20, 1,
       [planar](double v) { return alternating_lengths(planar, v); }, keep},
      {"distant arm", "distance/length", -20, 20, 1, distant_arm, keep},
      {"distant arm, tunable", "distance/length", -20, 20, 1, tunable_distant_arm, keep},
      {"all at once", "length, rates, sqrt(mass)", -40, 40, 4, scaled_throughout, scale_rates},
      {"screw, hinge and slide", "pitch, m/rad", -20, 20, 1, screw_hinge_slide, keep},
      {"geared hinge", "gear ratio", -20, 20, 1, geared_hinge, keep},
      {"springs", "stiffness, N/m, N m/rad", -20, 40, 2, springs, keep},
      {"spatial links", "g, m/s^2", -40, 20, 2, [spatial](double v) { return chain(spatial, v); }, keep},
      {"driven hinge", "rate, rad/s", -20, 30, 2, driven_links, keep, true, Loss::kLargeAngle},
      {"gimballed rotor", "ring moment, kg m^2", -40, 0, 2, gimballed_rotor, keep},
  };
}

std::vector<Family> state_families() {
  const auto spatial = always(chain(spatial_links())), planar = always(chain(planar_links()));
  const auto free = always(chain({{free_joint()}}));
  const auto balls = always(chain({{ball_joint()}, {ball_joint()}}));
  const auto universals = always(chain({{universal()}, {universal()}}));
  return {
      {"spatial links", "rates", -20, 20, 1, spatial, scale_rates, false},
      {"spatial links", "first rate", -20, 20, 1, spatial, scale_first_rate, false},
      {"spatial links, no gravity", "rates", -20, 20, 1, always(chain(spatial_links(), 0)), scale_rates,
       false},
      {"planar links, counter-rotating", "rates", -20, 20, 1, planar, counter_rotate, false},
      {"free body", "rates", -20, 20, 1, free, scale_rates, false},
      {"ball joints", "rates", -20, 20, 1, balls, scale_rates, false},
      {"Panda", "rates", -20, 20, 4, always(panda()), scale_rates, false},
      {"spatial links", "angles", -20, 30, 1, spatial, scale_positions, false},
      {"universal joints", "angles", -20, 30, 1, universals, scale_positions, false},
      {"Panda", "angles", -20, 30, 5, always(panda()), scale_positions, false},
      {"planar links", "angles", -20, 30, 1, planar, scale_positions, false},
      {"screw, hinge and slide", "angles, travel", -20, 20, 1, always(screw_hinge_slide(0.25)),
       scale_positions, false, Loss::kSmallMoment},
      {"mass in a gimbal, on the shaft", "from lock, rad", -40, 0, 1, always(gimballed_mass(0, 0, 1)),
       second_near(0), false},
      {"mass in a gimbal, across", "from lock, rad", -40, 0, 1, always(gimballed_mass(0, 1, 0)),
       second_near(pi / 2), false},
      {"mass in a gimbal, between", "from lock, rad", -40, 0, 1, always(gimballed_mass(0, 1, 1)),
       second_near(pi / 4), false, Loss::kSmallMoment},
      {"gimballed rotor, light rings", "from lock, rad", -40, 0, 1, always(gimballed_rotor(0x1p-30)),
       second_near(0), false},
      {"double pendulum, m1/m2 = 1e-12", "from stretched, rad", -40, 0, 1,
       always(double_pendulum(0x1p-40, 1)), second_near(0), false},
      {"bob on a spring", "distance, m", -40, 20, 2, always(bob_on_spring()),
       [](double v, Sample& sample) {
         for (std::size_t i = 0; i < 3; ++i) sample.y[i] *= v;
       },
       false},
      {"spatial links, denormal", "angles, rates", -1074, -1000, 10, spatial, scale_state, false},
  };
}

}  // namespace

const std::vector<Family>& extreme_families() {
  static const std::vector<Family> families = [] {
    std::vector<Family> all = scene_families();
    for (Family& family : state_families()) all.push_back(std::move(family));
    return all;
  }();
  return families;
}

std::vector<int> exponents(const Family& family) {
  std::vector<int> list;
  for (int e = family.first; e <= family.last; e += family.step) list.push_back(e);
  return list;
}

std::vector<int> exponents(const Family& family, int count) {
  const std::vector<int> all = exponents(family);
  std::vector<int> chosen;
  const int last = int(all.size()) - 1;
  for (int i = 0; i < count; ++i) chosen.push_back(all[std::size_t(last * i / std::max(count - 1, 1))]);
  return chosen;
}

model::Mechanism read_scene(const std::string& toml) {
  support::Diagnostics diagnostics("scene.toml", toml);
  const auto mechanism = model::read_mechanism(diagnostics);
  if (!mechanism) throw std::runtime_error(diagnostics.format() + "\n" + toml);
  return *mechanism;
}

}  // namespace jourdain::tests
