#include "dynamics/link_forces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dynamics/free_root.hpp"
#include "dynamics/wrenches.hpp"

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::Matrix3;

namespace {

/// Of the field a + U x on mass moments about the origin of x: force m a + U h, moment h × a + Σ x × U x.
Wrench inertia_wrench(const kinematics::MassMoments& moments, const Vector3& a, const Matrix3& U) {
  const Matrix3& S = moments.second;
  Wrench wrench{moments.mass * a + U * moments.first, cross(moments.first, a)};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    wrench.moment[i] = wrench.moment[i] + (S[i][j] * U[k][i] - S[i][k] * U[j][i]) +
                       S[j][k] * (U[k][k] - U[j][j]) + (S[j][j] * U[k][j] - S[k][k] * U[j][k]);
  }
  return wrench;
}

}  // namespace

bool has_forces_by_links(const Scene& scene) {
  return std::none_of(scene.tree.links.begin(), scene.tree.links.end(), is_free);
}

std::vector<std::vector<Ex>> derive_forces_by_links(const Scene& scene,
                                                    const JointAccelerations& accelerations,
                                                    const std::vector<Wrench>& applied,
                                                    const std::string& name) {
  const std::vector<Twist> motion = link_accelerations(scene, accelerations, name, OriginField::kGradient);
  std::vector<Wrench> own;
  for (std::size_t i = 0; i < scene.link_count(); ++i) {
    const std::string at = fmt::format("{}L{}", name, i);
    const Vector3 omega = scene.frames.to_link(i, scene.omega.own[i], at + "w");
    const Vector3 alpha = scene.frames.to_link(i, motion[i].angular, at + "al");
    const Vector3 a = scene.frames.to_link(i, motion[i].linear, at + "a");
    const Matrix3 U = acceleration_gradient(omega, alpha, at, scene.statements);
    const Wrench wrench = bound(scene, at, inertia_wrench(scene.tree.links[i].moments, a, U));
    own.push_back(bound(scene, fmt::format("{}e{}", name, i),
                        {scene.frames.to_working(i, wrench.force, at + "F") - applied[i].force,
                         scene.frames.to_working(i, wrench.moment, at + "N") - applied[i].moment}));
  }
  const std::vector<Wrench> totals = accumulate_wrenches(scene, own, name);
  std::vector<std::vector<Ex>> forces(totals.size());
  for (std::size_t i = 0; i < totals.size(); ++i)
    for (std::size_t c = 0; c < scene.columns[i].size(); ++c)
      forces[i].push_back(scene.statements.bind(fmt::format("{}Q{}_{}", name, i, c),
                                                power(totals[i], scene.columns[i][c].twist)));
  return forces;
}

}  // namespace jourdain::dynamics
