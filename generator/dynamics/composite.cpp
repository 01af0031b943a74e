#include "dynamics/composite.hpp"

#include <fmt/format.h>

#include "kinematics/inward_sums.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Link;
using kinematics::LinkTree;
using kinematics::MassMoments;
using kinematics::Matrix3;
using kinematics::Statements;
using kinematics::WorkingFrames;

namespace {

/// R S Rᵀ with its intermediate bound (permutations cost nothing).
Matrix3 rotated(const Matrix3& R, const Matrix3& S, const std::string& name, Statements& statements) {
  return statements.bind_symmetric(name, statements.bind(name + "r", R * S) * transpose(R));
}

/// S and polar turned about z from link to working axes. With d = S_xx − S_yy and t = s d + 2 c S_xy:
/// S'_xx = S_xx − s t, S'_xy = c t − S_xy; the trace of the xy block does not change.
Matrix3 turned(const Matrix3& S, const Ex& polar, const Ex& c, const Ex& s, const std::string& name,
               Statements& statements) {
  if (s.is_zero()) return S;
  const Ex difference = statements.bind(name + "_d", S[0][0] - S[1][1]);
  const Ex twice = statements.bind(name + "_e", 2 * S[0][1]);
  const Ex t = statements.bind(name + "_t", s * difference + c * twice);
  Matrix3 T;
  T[0][0] = S[0][0] - s * t;
  T[0][1] = T[1][0] = c * t - S[0][1];
  T[0][2] = T[2][0] = c * S[0][2] - s * S[1][2];
  T[1][2] = T[2][1] = s * S[0][2] + c * S[1][2];
  T[2][2] = S[2][2];
  T = statements.bind_symmetric(name, T);
  T[1][1] = statements.bind(name + "_yy", polar - T[0][0]);
  return T;
}

bool is_zero(const Matrix3& S) {
  return kinematics::is_zero(S[0]) && kinematics::is_zero(S[1]) && kinematics::is_zero(S[2]);
}

/// Whether a link is nothing but a mass on its x or y axis, and turns about an axis that meets that of a parent without
/// inertia: the pendulum on a universal joint. M is singular where the mass comes to lie on the parent's axis.
bool is_gimballed_point(const LinkTree& tree, std::size_t i) {
  const Link& link = tree.links[i];
  const Matrix3& S = link.moments.second;
  if (!link.turns_about_z() || link.parent == kGround || !is_zero(link.r_PL)) return false;
  if (!is_zero(tree.links[link.parent].moments.second)) return false;
  for (const Link& other : tree.links)
    if (other.parent == i || (other.parent == link.parent && &other != &link)) return false;
  return is_zero(S[2]) && S[0][1].is_zero() && (S[0][0].is_zero() || S[1][1].is_zero());
}

/// `turned` for such a link. The general formula's differences would leave no digit of the moment that
/// vanishes; products take no more operations here.
Matrix3 turned_point(const Matrix3& S, const Ex& c, const Ex& s, const std::string& name,
                     Statements& statements) {
  const bool on_x = S[1][1].is_zero();
  const Ex& moment = on_x ? S[0][0] : S[1][1];
  const Ex &along_x = on_x ? c : s, &along_y = on_x ? s : c;
  const Ex x = statements.bind(name + "_x", along_x * moment);
  const Ex y = statements.bind(name + "_y", along_y * moment);
  Matrix3 T = kinematics::zero_matrix();
  T[0][0] = statements.bind(name + "_xx", along_x * x);
  T[1][1] = statements.bind(name + "_yy", along_y * y);
  T[0][1] = T[1][0] = statements.bind(name + "_xy", on_x ? along_y * x : -along_y * x);
  return T;
}

}  // namespace

std::vector<CompositeBody> derive_composites(const LinkTree& tree, const WorkingFrames& frames,
                                             Statements& statements,
                                             const std::function<Joins(std::size_t link)>& joins) {
  const std::size_t n = tree.links.size();
  kinematics::InwardSums<MassMoments> sums(frames);
  std::vector<Ex> polar(n, 0);  // S_xx + S_yy of what is in W
  std::vector<CompositeBody> composites(n);
  for (std::size_t i = 0; i < n; ++i) sums.in_L[i] = tree.links[i].moments;
  for (std::size_t i = n; i-- > 0;) {
    const std::size_t parent = tree.links[i].parent;
    const std::string S = fmt::format("S{}", i), h = fmt::format("h{}", i);
    const MassMoments &own = sums.in_L[i], &in_W = sums.in_W[i];
    const Ex own_polar = statements.bind(S + "b_zz", own.second[0][0] + own.second[1][1]);
    const Matrix3 own_second =
        is_gimballed_point(tree, i)
            ? turned_point(own.second, frames.cosine(i), frames.sine(i), S + "b", statements)
            : turned(own.second, own_polar, frames.cosine(i), frames.sine(i), S + "b", statements);
    CompositeBody& body = composites[i];
    body.moments.mass = statements.bind(fmt::format("m{}", i), own.mass + in_W.mass);
    body.moments.first = statements.bind(h, frames.to_working(i, own.first, h + "b") + in_W.first);
    body.J_zz = statements.bind(fmt::format("J{}", i), own_polar + polar[i]);
    body.moments.second = statements.bind_symmetric(S, own_second + in_W.second);
    if (!in_W.second[0][0].is_zero())
      body.moments.second[1][1] = statements.bind(S + "_yy", body.J_zz - body.moments.second[0][0]);
    const Matrix3& second = body.moments.second;
    body.J_xx = statements.bind(fmt::format("Jx{}", i), second[1][1] + second[2][2]);
    body.J_yy = statements.bind(fmt::format("Jy{}", i), second[0][0] + second[2][2]);
    if (parent == kGround || joins(i) == Joins::kNot) continue;

    const Vector3& r = frames.r_CW(i);
    const std::string at_parent = fmt::format("at{}", i);
    const bool as_mass = joins(i) == Joins::kMass;
    MassMoments moved = body.moments;
    if (as_mass) {
      moved.first = kinematics::zero_vector();
      moved.second = kinematics::zero_matrix();
    } else {
      moved.first = frames.from_W_to_C(i, moved.first, h + at_parent);
      moved.second = rotated(frames.R_CW(i), moved.second, S + at_parent, statements);
    }
    const Vector3 mr = statements.bind(h + "r", moved.mass * r);
    const Vector3 middle = statements.bind(h + "k", moved.first + Ex(GiNaC::numeric(1, 2)) * mr);
    MassMoments& target = sums.joined_by(i, frames);
    if (frames.meets_in_W(i)) {
      const Ex shift = statements.bind(fmt::format("D{}", i), r[0] * middle[0] + r[1] * middle[1]);
      const Ex half = as_mass ? shift : statements.bind(fmt::format("E{}", i), body.J_zz + shift);
      polar[parent] = statements.bind(fmt::format("Jc{}", i), polar[parent] + half + shift);
    }
    target.mass = statements.bind(fmt::format("mc{}", i), target.mass + moved.mass);
    target.first = statements.bind(h + "c", target.first + (moved.first + mr));
    target.second = statements.bind_symmetric(
        S + "c", target.second + (moved.second + kinematics::symmetric_outer(r, middle)));
  }
  return composites;
}

std::vector<std::vector<Column>> derive_columns(const LinkTree& tree,
                                                const std::vector<kinematics::LinkState>& states,
                                                const WorkingFrames& frames) {
  std::vector<std::vector<Column>> columns(tree.links.size());
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const Link& link = tree.links[i];
    if (!link.has_quaternion()) {
      const Vector3 turn = {0, 0, link.turns_about_z() ? link.sign : 0};
      columns[i].push_back({{turn, Ex(link.sign) * frames.direction(i)}, states[i].entry});
      continue;
    }
    const std::size_t count = states[i].column_count(link);
    for (std::size_t c = 0; c < count; ++c) {
      Column& column = columns[i].emplace_back();
      column.entry = *states[i].entry + c;
      (c + 3 < count ? column.twist.linear : column.twist.angular)[c % 3] = 1;
    }
  }
  return columns;
}

Wrench momentum(const CompositeBody& body, const Twist& twist) {
  const Vector3& h = body.moments.first;
  const Matrix3& S = body.moments.second;
  const Vector3 &w = twist.angular, &v = twist.linear;
  const Vector3 spin = {body.J_xx * w[0] - S[0][1] * w[1] - S[0][2] * w[2],
                        body.J_yy * w[1] - S[0][1] * w[0] - S[1][2] * w[2],
                        body.J_zz * w[2] - S[0][2] * w[0] - S[1][2] * w[1]};
  return {body.moments.mass * v + kinematics::cross(w, h), kinematics::cross(h, v) + spin};
}

Ex power(const Wrench& wrench, const Twist& twist) {
  return kinematics::dot(wrench.force, twist.linear) + kinematics::dot(wrench.moment, twist.angular);
}

}  // namespace jourdain::dynamics
