#include "kinematics/working_frames.hpp"

#include <fmt/format.h>

#include "kinematics/numbers.hpp"

namespace jourdain::kinematics {

namespace {

/// Rotation matrix of a unit quaternion (w, x, y, z) without division: 1 − 2(y² + z²), 2(xy − wz), …
Matrix3 quaternion_matrix(const std::array<Ex, 4>& q, const std::string& name, Statements& statements) {
  Ex doubled[4];
  for (std::size_t a = 1; a < 4; ++a) doubled[a] = statements.bind(fmt::format("{}d{}", name, a), 2 * q[a]);
  const auto twice = [&](std::size_t a, std::size_t b) {
    return statements.bind(fmt::format("{}{}{}", name, a, b), doubled[b] * q[a]);
  };
  const Ex xx = twice(1, 1), yy = twice(2, 2), zz = twice(3, 3);
  const Ex xy = twice(1, 2), xz = twice(1, 3), yz = twice(2, 3);
  const Ex wx = twice(0, 1), wy = twice(0, 2), wz = twice(0, 3);
  const Matrix3 R = {
      {{1 - yy - zz, xy - wz, xz + wy}, {xy + wz, 1 - xx - zz, yz - wx}, {xz - wy, yz + wx, 1 - xx - yy}}};
  return statements.bind(name + "r", R);
}

}  // namespace

WorkingFrames::WorkingFrames(const LinkTree& tree, const std::vector<LinkState>& states,
                             Statements& statements)
    : tree_(tree), statements_(statements) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    set_angle(i, states[i]);
    R_CW_.push_back(link.R_PL);
    if (link.has_quaternion()) {
      const Matrix3 R_LW = quaternion_matrix(states[i].quaternion, fmt::format("q{}", i), statements);
      R_CW_[i] = statements.bind(fmt::format("R{}_", i), link.R_PL * R_LW);
    }
    set_translation(i, states[i]);
  }
}

void WorkingFrames::set_angle(std::size_t i, const LinkState& state) {
  const Link& link = tree_.links[i];
  const Ex previous = link.parallel ? angle_[link.parent] : Ex(0);
  const Ex turned = link.turns_about_z() ? state.position : Ex(0);
  angle_.push_back(statements_.bind(fmt::format("angle{}", i), previous + turned));
  if (!link.turns_about_z() && link.parallel) {
    cosine_.push_back(cosine_[link.parent]);
    sine_.push_back(sine_[link.parent]);
  } else if (!link.parallel && link.sign < 0) {
    cosine_.push_back(statements_.bind(fmt::format("c{}", i), kinematics::cosine(-angle_[i])));
    sine_.push_back(-statements_.bind(fmt::format("s{}", i), kinematics::sine(-angle_[i])));
  } else {
    cosine_.push_back(statements_.bind(fmt::format("c{}", i), kinematics::cosine(angle_[i])));
    sine_.push_back(statements_.bind(fmt::format("s{}", i), kinematics::sine(angle_[i])));
  }
}

void WorkingFrames::set_translation(std::size_t i, const LinkState& state) {
  const Link& link = tree_.links[i];
  const std::string name = fmt::format("r{}", i);
  Vector3 offset = link.r_PL;
  Vector3 direction = zero_vector(), curvature = zero_vector();
  if (link.kind == LinkKind::kCurve) {
    offset = statements_.bind(name + "c", offset + link.R_PJ * state.place);
    direction = statements_.bind(name + "d", link.R_PJ * state.slope);
    curvature = statements_.bind(name + "dd", link.R_PJ * state.curvature);
  }
  if (link.kind == LinkKind::kFree) offset = state.origin + R_CW_[i] * link.shift;
  if (link.parallel) offset = to_working(link.parent, offset, name);
  if (link.moves_along_z()) {
    direction[2] = link.kind == LinkKind::kScrew ? link.pitch : Ex(1);
    const Ex travel = statements_.bind(name + "t", direction[2] * state.position);
    for (std::size_t k = 0; k < 3; ++k) offset[k] = offset[k] + link.R_PL[k][2] * travel;
  }
  r_CW_.push_back(statements_.bind(name, offset));
  direction_.push_back(direction);
  curvature_.push_back(curvature);
}

Vector3 WorkingFrames::to_working(std::size_t link, const Vector3& v, const std::string& name) const {
  if (link == kGround) return v;
  const Ex &c = cosine_[link], &s = sine_[link];
  return statements_.bind(name, Vector3{c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]});
}

Vector3 WorkingFrames::to_link(std::size_t link, const Vector3& v, const std::string& name) const {
  if (link == kGround) return v;
  const Ex &c = cosine_[link], &s = sine_[link];
  return statements_.bind(name, Vector3{c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]});
}

Vector3 WorkingFrames::point_to_parent(std::size_t link, const Vector3& x, const std::string& name) const {
  const bool in_parent = meets_in_W(link) || parent(link) == kGround;
  const Vector3 x_C = statements_.bind(in_parent ? name : name + "p", R_CW_[link] * x + r_CW_[link]);
  return from_C_to_parent(link, x_C, name);
}

}  // namespace jourdain::kinematics
