#include "model/read/import_attach.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/expression_sums.hpp"

namespace jourdain::model {

namespace {

using Op = Expression::Op;

bool is_zero(const Vector3& v) {
  return std::all_of(v.begin(), v.end(), [](const Expression& e) { return e.is_zero(); });
}

bool is_turned(const Placement& placement) { return !is_zero(placement.rotation.rpy); }
bool is_identity(const Placement& placement) { return is_zero(placement.position) && !is_turned(placement); }

Vector3 sum(const Vector3& a, const Vector3& b) {
  Vector3 result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = plus(a[k], b[k]);
  return result;
}

/// `inner` in the frame that `outer` places; nothing where its angles would have to be computed.
std::optional<Placement> together(const Placement& outer, const Placement& inner) {
  if (is_identity(inner)) return outer;
  if (is_turned(outer)) return {};
  return Placement{sum(outer.position, inner.position), inner.rotation};
}

/// About axis k by an angle.
Vector3 turned(const Vector3& v, std::size_t k, const Expression& angle) {
  if (angle.is_zero()) return v;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  const Expression s = Expression::unary(Op::kSin, angle), c = Expression::unary(Op::kCos, angle);
  Vector3 result = v;
  result[i] = minus(times(c, v[i]), times(s, v[j]));
  result[j] = plus(times(s, v[i]), times(c, v[j]));
  return result;
}

Vector3 turned(Vector3 v, const Vector3& rpy) {
  for (std::size_t k = 0; k < 3; ++k) v = turned(v, k, rpy[k]);
  return v;
}

/// The quaternion of a turn about axis k, then q before it: (cos, e_k sin) of half the angle times q.
std::array<Expression, 4> turned(const std::array<Expression, 4>& q, std::size_t k, const Expression& angle) {
  if (angle.is_zero()) return q;
  const Expression half = Expression::binary(Op::kMultiply, 0.5, angle);
  const Expression s = Expression::unary(Op::kSin, half), c = Expression::unary(Op::kCos, half);
  const std::size_t x = 1 + k, y = 1 + (k + 1) % 3, z = 1 + (k + 2) % 3;
  const auto row = [&](const Expression& a, Op op, const Expression& b) {
    return Expression::binary(op, Expression::binary(Op::kMultiply, c, a),
                              Expression::binary(Op::kMultiply, s, b));
  };
  std::array<Expression, 4> result;
  result[0] = row(q[0], Op::kSubtract, q[x]);
  result[x] = row(q[x], Op::kAdd, q[0]);
  result[y] = row(q[y], Op::kSubtract, q[z]);
  result[z] = row(q[z], Op::kAdd, q[y]);
  return result;
}

/// Its start is given in the world that is imported.
void move_start(Joint& joint, const Placement& placement) {
  const Vector3& rpy = placement.rotation.rpy;
  joint.initial_origin = sum(placement.position, turned(joint.initial_origin, rpy));
  joint.initial_origin_velocity = turned(joint.initial_origin_velocity, rpy);
  for (std::size_t k = 0; k < 3; ++k)
    joint.initial_orientation = turned(joint.initial_orientation, k, rpy[k]);
}

class Attaching {
 public:
  Attaching(Mechanism& mechanism, const MergedRange& range, const Attachment& place)
      : mechanism_(mechanism), range_(range), place_(place), body_(place.body) {
    const std::optional<Placement> one = together(place.outer, place.inner);
    if (one)
      chain_ = {*one};
    else
      chain_ = {place.outer, place.inner};
    std::erase_if(chain_, is_identity);
    // The axis of such a loop is in the axes of the body that carries both ends, which may be the place.
    const auto pin = [](const Loop& loop) { return loop.type == LoopType::kPlanarPin; };
    const bool has_pin = std::any_of(loop_at(range.first_loop), loop_at(range.last_loop), pin);
    if (has_pin && std::any_of(chain_.begin(), chain_.end(), is_turned)) add_mount();
  }

  std::optional<JointIndex> run() {
    const bool is_world = !body_ && chain_.empty();
    std::optional<JointIndex> refused;
    for (std::size_t j = range_.first_joint; j < range_.last_joint; ++j) {
      if (mechanism_.joints[j].parent) continue;
      if (mechanism_.joints[j].type != JointType::kFree) {
        const auto [body, placement] = placed(mechanism_.joints[j].placement);
        mechanism_.joints[j].parent = body;
        mechanism_.joints[j].placement = placement;
      } else if (!place_.body) {
        move_start(mechanism_.joints[j], place_.inner);
        move_start(mechanism_.joints[j], place_.outer);
      } else if (!refused) {
        refused = JointIndex(j);
      }
    }
    for (std::size_t f = range_.first_frame; f < range_.last_frame; ++f) {
      if (mechanism_.frames[f].body || is_world) continue;
      if (mechanism_.frames[f].name == "world") mechanism_.frames[f].name = new_name(place_.prefix + "world");
      const auto [body, placement] = placed(mechanism_.frames[f].placement);
      mechanism_.frames[f].body = body;
      mechanism_.frames[f].placement = placement;
    }
    return refused;
  }

 private:
  struct Placed {
    std::optional<BodyIndex> body;
    Placement placement;
  };

  std::vector<Loop>::const_iterator loop_at(std::size_t i) const {
    return mechanism_.loops.begin() + static_cast<std::ptrdiff_t>(i);
  }

  Placed placed(Placement own) {
    if (chain_.size() == 1)
      if (const std::optional<Placement> one = together(chain_[0], own)) return {body_, *one};
    if (!chain_.empty()) add_mount();
    return {body_, std::move(own)};
  }

  /// From now on everything hangs on bodies of their own at the place.
  void add_mount() {
    for (const Placement& placement : chain_) {
      Body mount;
      mount.name = new_name(place_.prefix + "mount");
      mount.where = place_.where;
      Joint joint;
      joint.name = mount.name;
      joint.parent = body_;
      joint.child = BodyIndex(mechanism_.bodies.size());
      joint.placement = placement;
      joint.where = place_.where;
      body_ = joint.child;
      mechanism_.bodies.push_back(std::move(mount));
      mechanism_.joints.push_back(std::move(joint));
    }
    chain_.clear();
  }

  std::string new_name(std::string name) const {
    const auto has_name = [&name](const auto& element) { return element.name == name; };
    while (std::any_of(mechanism_.bodies.begin(), mechanism_.bodies.end(), has_name) ||
           std::any_of(mechanism_.joints.begin(), mechanism_.joints.end(), has_name) ||
           std::any_of(mechanism_.frames.begin(), mechanism_.frames.end(), has_name))
      name += '_';
    return name;
  }

  Mechanism& mechanism_;
  const MergedRange& range_;
  const Attachment& place_;
  std::optional<BodyIndex> body_;
  std::vector<Placement> chain_;  ///< that are not the identity
};

}  // namespace

std::optional<JointIndex> attach(Mechanism& mechanism, const MergedRange& range, const Attachment& place) {
  return Attaching(mechanism, range, place).run();
}

}  // namespace jourdain::model
