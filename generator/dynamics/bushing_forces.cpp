// Bushings between two frames. With a_i and b_i the axes of the frames and G_i = ½ Σ k − k_i of the torsional
// stiffnesses k, ½ Σ k_i θ_i² = ½ Σ G_i |b_i − a_i|², whose moment is Σ G_i b_i × a_i.
#include <fmt/format.h>

#include "dynamics/element_forces.hpp"

namespace jourdain::dynamics {

namespace {

/// A frame as the common ancestor sees it, in W of that.
struct End {
  PointPath path;  // of its origin
  Vector3 axes[3];
  Vector3 spin;
};

End end_of(const Scene& scene, const kinematics::BodyPose& pose, std::size_t ancestor,
           const std::string& name) {
  End end{follow_point(scene, pose.link, pose.r_LB, ancestor, name), {}, kinematics::zero_vector()};
  for (std::size_t k = 0; k < 3; ++k)
    end.axes[k] = scene.frames.to_working(pose.link, transpose(pose.R_LB)[k], fmt::format("{}e{}", name, k));
  for (const std::size_t link : end.path.links) {
    const std::string at = fmt::format("{}_{}", name, link);
    for (Vector3& axis : end.axes) axis = scene.frames.to_parent(link, axis, at + "e");
    end.spin = scene.statements.bind(at + "w", end.spin + scene.relative_twist(link).angular);
    end.spin = scene.frames.to_parent(link, end.spin, at + "wp");
  }
  return end;
}

struct Ends {
  End from, to;
  Vector3 difference;  // between the origins
};

Ends ends_of(const model::Bushing& bushing, const Scene& scene) {
  const std::vector<model::Frame>& frames = scene.mechanism.frames;
  const kinematics::BodyPose from = frame_pose(scene, frames[bushing.from.value]),
                             to = frame_pose(scene, frames[bushing.to.value]);
  const std::size_t ancestor = common_ancestor(scene.tree, from.link, to.link);
  Ends ends{
      end_of(scene, from, ancestor, bushing.name + "a"), end_of(scene, to, ancestor, bushing.name + "b"), {}};
  ends.difference =
      scene.statements.bind(bushing.name + "d", ends.to.path.position - ends.from.path.position);
  return ends;
}

/// Σ stiffness_i x_i + damping_i rate_i along the axes.
Vector3 resistance(const Scene& scene, const Ends& ends, const model::Vector3& stiffness,
                   const model::Vector3& damping, const Vector3& x, const Vector3& rate,
                   const std::string& name) {
  Vector3 sum = kinematics::zero_vector();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& axis = ends.from.axes[k];
    const Ex along = scene.statements.bind(name + "_x", dot(axis, x)),
             speed = scene.statements.bind(name + "_v", dot(axis, rate));
    const Ex d = scene.value("damping", damping[k]), c = scene.value("stiffness", stiffness[k]);
    const Ex force = scene.statements.bind(name + "_f", c * along + d * speed);
    sum = scene.statements.bind(name, sum + force * axis);
  }
  return sum;
}

/// G_i.
Vector3 torsional_weights(const model::Bushing& bushing, const Scene& scene) {
  Vector3 k;
  for (std::size_t i = 0; i < 3; ++i) k[i] = scene.value("torsional", bushing.torsional_stiffness[i]);
  const Ex half = scene.statements.bind(bushing.name + "_hk", (k[0] + k[1] + k[2]) / 2);
  return scene.statements.bind(bushing.name + "_G", Vector3{half - k[0], half - k[1], half - k[2]});
}

/// On the end `to`.
Wrench wrench_of(const model::Bushing& bushing, const Scene& scene, const Ends& ends) {
  kinematics::Statements& statements = scene.statements;
  const std::string& name = bushing.name;
  const Vector3 carried = statements.bind(name + "c", cross(ends.from.spin, ends.difference));
  const Vector3 velocity =
      statements.bind(name + "v", ends.to.path.velocity - ends.from.path.velocity - carried);
  const Vector3 force =
      resistance(scene, ends, bushing.stiffness, bushing.damping, ends.difference, velocity, name + "f");
  const Vector3 zero = kinematics::zero_vector();
  const Vector3 spin = statements.bind(name + "w", ends.to.spin - ends.from.spin);
  Vector3 moment = Ex(-1) * resistance(scene, ends, {}, bushing.torsional_damping, zero, spin, name + "n");
  const Vector3 weights = torsional_weights(bushing, scene);
  for (std::size_t k = 0; k < 3; ++k)
    moment = statements.bind(name + "m", moment + weights[k] * cross(ends.to.axes[k], ends.from.axes[k]));
  return {Ex(-1) * force, moment};
}

}  // namespace

void add_forces(const model::Bushing& bushing, ForceSum& sum) {
  const Scene& scene = sum.scene;
  const Ends ends = ends_of(bushing, scene);
  const auto& [force, moment] = wrench_of(bushing, scene, ends);
  const Vector3 at_from = scene.statements.bind(bushing.name + "l", moment + cross(ends.difference, force));
  const std::vector<model::Frame>& frames = scene.mechanism.frames;
  sum.act(frames[bushing.to.value], ends.to.path, {force, moment}, bushing.name + "fb");
  sum.act(frames[bushing.from.value], ends.from.path, {Ex(-1) * force, Ex(-1) * at_from},
          bushing.name + "fa");
}

Ex potential(const model::Bushing& bushing, const Scene& scene) {
  const Ends ends = ends_of(bushing, scene);
  const Vector3 weights = torsional_weights(bushing, scene);
  Ex energy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Ex along = scene.statements.bind(bushing.name + "_x", dot(ends.from.axes[k], ends.difference));
    const Vector3 turned = scene.statements.bind(bushing.name + "_t", ends.to.axes[k] - ends.from.axes[k]);
    const Ex stiffness = scene.value("half_stiffness", bushing.stiffness[k]) / 2;
    energy = energy + stiffness * along * along + weights[k] / 2 * dot(turned, turned);
  }
  return energy;
}

}  // namespace jourdain::dynamics
