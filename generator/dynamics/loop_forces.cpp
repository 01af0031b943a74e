#include "dynamics/loop_forces.hpp"

#include <fmt/format.h>

#include "model/loop_kinds.hpp"

namespace jourdain::dynamics {

namespace {

class LoopForces {
 public:
  LoopForces(const Scene& scene, AppliedForces applied)
      : scene_(scene), statements_(scene.statements), forces_(std::move(applied)) {}

  void add(const model::Loop& loop, const LoopClosure& closure, std::size_t first_row) {
    Vector3 force = kinematics::zero_vector(), on_from = force, on_to = force, on_carrier = force;
    for (std::size_t r = 0; r < closure.gradients.size(); ++r) {
      const Ex push = -scene_.leaves.lambda[first_row + r];
      const RowGradient& gradient = closure.gradients[r];
      const std::string name = fmt::format("{}r{}", loop.name, r);
      force = statements_.bind(name + "f", force + push * gradient.place);
      on_from = statements_.bind(name + "nf", on_from + push * gradient.turn_from);
      on_to = statements_.bind(name + "nt", on_to + push * gradient.turn_to);
      on_carrier = statements_.bind(name + "nc", on_carrier + push * gradient.turn_carrier);
    }
    const model::Frame &from = scene_.mechanism.frames[loop.from.value],
                       &to = scene_.mechanism.frames[loop.to.value];
    const std::size_t ancestor =
        common_ancestor(scene_.tree, scene_.tree.link_of(from.body), scene_.tree.link_of(to.body));
    act_at(from, ancestor, {Ex(-1) * force, on_from}, loop.name + "lf");
    act_at(to, ancestor, {force, on_to}, loop.name + "lt");
    if (const auto carrier = model::carrier(scene_.mechanism, from.body, to.body))
      forces_.on_bodies.push_back({*carrier, {kinematics::zero_vector(), on_carrier}});
  }

  AppliedForces result() { return std::move(forces_); }

 private:
  /// A wrench about the frame's origin, in W of the ancestor: its share along each column on the way, and on the body.
  void act_at(const model::Frame& frame, std::size_t ancestor, const Wrench& wrench,
              const std::string& name) {
    if (!frame.body) return;
    const kinematics::BodyPose pose = frame_pose(scene_, frame);
    const PointPath path = follow_point(scene_, pose.link, pose.r_LB, ancestor, name);
    const auto about = [&](const Vector3& lever, const Vector3& f, const Vector3& n) {
      return Wrench{f, statements_.bind(name + "m", n + kinematics::cross(lever, f))};
    };
    if (path.links.empty()) {
      forces_.on_bodies.push_back({*frame.body, about(path.position, wrench.force, wrench.moment)});
      return;
    }
    const std::vector<Vector3> forces = carry_outward(scene_, path, wrench.force, name + "f"),
                               moments = carry_outward(scene_, path, wrench.moment, name + "n");
    for (std::size_t k = 0; k < path.links.size(); ++k) {
      const Wrench here = about(path.levers[k], forces[k], moments[k]);
      if (k == 0) forces_.on_bodies.push_back({*frame.body, here});
      std::vector<Ex>& along = forces_.along[path.links[k]];
      for (std::size_t c = 0; c < along.size(); ++c)
        along[c] =
            statements_.bind(name + "p", along[c] + power(here, scene_.columns[path.links[k]][c].twist));
    }
  }

  const Scene& scene_;
  kinematics::Statements& statements_;
  AppliedForces forces_;
};

}  // namespace

AppliedForces with_loop_forces(const Scene& scene, AppliedForces applied,
                               const std::vector<LoopClosure>& closures) {
  LoopForces forces(scene, std::move(applied));
  std::size_t row = 0;
  for (std::size_t k = 0; k < closures.size(); ++k) {
    const model::Loop& loop = scene.mechanism.loops[k];
    if (model::loop_kind(loop).has_ends()) forces.add(loop, closures[k], row);
    row += model::row_count(loop.type);
  }
  return forces.result();
}

}  // namespace jourdain::dynamics
