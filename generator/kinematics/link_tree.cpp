#include "kinematics/link_tree.hpp"

#include <fmt/format.h>

#include <optional>

#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::kinematics {

using model::JointType;
using model::Mechanism;

MassMoments operator+(const MassMoments& a, const MassMoments& b) {
  return {a.mass + b.mass, a.first + b.first, a.second + b.second};
}

MassMoments moved(const MassMoments& moments, const Matrix3& R, const Vector3& r, Statements& statements) {
  const Vector3 h = statements.bind("h", settled(R * moments.first));
  const Vector3 mr = statements.bind("mr", moments.mass * r);
  Matrix3 SR = moments.second * transpose(R);
  for (Vector3& row : SR.rows) row = statements.bind("SR", settled(row));
  const Matrix3 turned = statements.bind_symmetric("S", settled(R * SR));
  Matrix3 shift = symmetric_outer(r, h);
  for (std::size_t i = 0; i < 3; ++i) shift[i] = shift[i] + mr[i] * r;
  return {moments.mass, statements.bind("h", h + mr), statements.bind_symmetric("S", turned + shift)};
}

namespace {

MassMoments bind_moments(Statements& statements, const std::string& name, const MassMoments& moments) {
  return {statements.bind(name + "_m", moments.mass), statements.bind(name + "_h", settled(moments.first)),
          statements.bind_symmetric(name + "_S", settled(moments.second))};
}

/// Where a body's frame B sits: rigidly in link frame L of `link` (or in the inertial frame).
struct BodyPose {
  std::size_t link = kGround;
  Matrix3 R_LB = identity_matrix();
  Vector3 r_LB = zero_vector();
};

/// Orientation of a frame with z along the unit vector `z`: a permutation of the axes where z lies on one, otherwise
/// x in the parent's xy plane (one entry of the matrix is zero).
Matrix3 frame_along(const Vector3& z) {
  if (z[2].is_equal(1)) return identity_matrix();
  if (z[0].is_equal(1)) return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  if (z[1].is_equal(1)) return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
  const Ex rho = square_root(z[0] * z[0] + z[1] * z[1]);
  const Vector3 x = {-z[1] / rho, z[0] / rho, 0};
  const Vector3 y = cross(z, x);
  return transpose(Matrix3{{x, y, z}});
}

class Builder {
 public:
  Builder(const Mechanism& mechanism, std::span<const Ex> parameters, Statements& statements,
          const LinkTreeOptions& options)
      : mechanism_(mechanism), parameters_(parameters), statements_(statements), options_(options) {}

  LinkTree build() {
    tree_.gravity = to_symbolic(mechanism_.gravity, parameters_, statements_);
    poses_.resize(mechanism_.bodies.size());
    for (model::JointIndex index : model::depth_first(mechanism_))
      place_child(mechanism_.joints[index.value]);
    for (std::size_t i = 0; i < mechanism_.bodies.size(); ++i) add_body(mechanism_.bodies[i], poses_[i]);
    if (options_.regroup)
      for (std::size_t i = tree_.links.size(); i-- > 0;) regroup(tree_.links[i]);
    return std::move(tree_);
  }

 private:
  MassMoments& moments_of(std::size_t link) {
    return link == kGround ? tree_.ground : tree_.links[link].moments;
  }

  Matrix3 rotation(const model::Rotation& rotation, const std::string& name) {
    return bound(name, rotation_matrix(rotation, parameters_, mechanism_.snap, statements_));
  }

  Vector3 bound(const std::string& name, const Vector3& value) {
    return statements_.bind(name, settled(value));
  }

  Matrix3 bound(const std::string& name, const Matrix3& value) {
    return {{bound(name + "_x", value[0]), bound(name + "_y", value[1]), bound(name + "_z", value[2])}};
  }

  void place_child(const model::Joint& joint) {
    const BodyPose parent = joint.parent ? poses_[joint.parent->value] : BodyPose{};
    const Matrix3 R_LJ =
        bound("R_" + joint.name, parent.R_LB * rotation(joint.placement.rotation, "R_" + joint.name));
    const Vector3 r_LJ =
        bound("r_" + joint.name,
              parent.r_LB + parent.R_LB * to_symbolic(joint.placement.position, parameters_, statements_));
    BodyPose& child = poses_[joint.child.value];
    if (joint.type == JointType::kFixed) {
      child = {parent.link, R_LJ, r_LJ};
      return;
    }
    const Link link = make_link(joint, parent.link, R_LJ, r_LJ);
    child.link = tree_.links.size();
    child.R_LB = bound("R_" + joint.name, transpose(link.R_PL) * R_LJ);
    child.r_LB = bound("r_" + joint.name, transpose(link.R_PL) * (r_LJ - link.r_PL));
    tree_.links.push_back(link);
  }

  /// Chooses the link frame: z on the axis, pointing along the parent's positive axes where it is aligned with one.
  Link make_link(const model::Joint& joint, std::size_t parent, const Matrix3& R_LJ, const Vector3& r_LJ) {
    Link link;
    link.name = joint.name;
    link.revolute = joint.type == JointType::kRevolute;
    link.parent = parent;
    Vector3 z = bound("axis_" + joint.name, R_LJ * unit_vector(joint.axis));
    if (mechanism_.snap) z = aligned(z);
    if (z[0].is_equal(-1) || z[1].is_equal(-1) || z[2].is_equal(-1)) {
      link.sign = -1;
      z = Ex(-1) * z;
    }
    const bool numeric = is_number(z[0]) && is_number(z[1]) && is_number(z[2]);
    link.R_PL = numeric ? frame_along(z) : R_LJ * frame_along(unit_vector(joint.axis));
    link.R_PL = bound("R_" + joint.name, link.R_PL);
    link.parallel = options_.share_parallel && parent != kGround && z[2].is_equal(1);
    if (link.revolute) {
      const Ex along = statements_.bind("d_" + joint.name, dot(z, r_LJ));
      link.r_PL = bound("r_" + joint.name, r_LJ - along * z);
    } else {
      link.r_PL = zero_vector();
    }
    return link;
  }

  void add_body(const model::Body& body, const BodyPose& pose) {
    const Vector3 c = to_symbolic(body.center_of_mass, parameters_, statements_);
    const Ex mass = to_symbolic(body.mass, parameters_, statements_);
    const auto entry = [&](const model::Expression& e) { return to_symbolic(e, parameters_, statements_); };
    const model::Inertia& I = body.inertia;
    const Ex xx = entry(I.xx), yy = entry(I.yy), zz = entry(I.zz);
    const Ex xy = -entry(I.xy), xz = -entry(I.xz), yz = -entry(I.yz);
    Matrix3 second = {
        {{(yy + zz - xx) / 2, xy, xz}, {xy, (xx + zz - yy) / 2, yz}, {xz, yz, (xx + yy - zz) / 2}}};
    second = statements_.bind_symmetric(body.name + "_S", second);
    const Matrix3 R_BI = rotation(body.inertia_axes, "R_" + body.name);
    MassMoments moments = moved({mass, zero_vector(), second}, R_BI, zero_vector(), statements_);
    if (body.inertia_point == model::InertiaPoint::kCenterOfMass)
      moments = moved(moments, identity_matrix(), c, statements_);
    else
      moments.first = mass * c;
    moments = bind_moments(statements_, body.name, moments);
    MassMoments& target = moments_of(pose.link);
    target = bind_moments(statements_, body.name, target + moved(moments, pose.R_LB, pose.r_LB, statements_));
  }

  /// A revolute joint about z does not move what is symmetric about z: the mass, h_z and S_zz. A prismatic joint does
  /// not turn anything: its whole second moment counts as the parent's (design section 2, base inertial parameters).
  void regroup(Link& link) {
    MassMoments kept = link.moments, symmetric;
    if (link.revolute) {
      symmetric.mass = kept.mass;
      symmetric.first[2] = kept.first[2];
      symmetric.second[2][2] = kept.second[2][2];
      kept.mass = kept.first[2] = kept.second[2][2] = 0;
    } else {
      std::swap(symmetric.second, kept.second);
    }
    link.moments = kept;
    MassMoments& parent = moments_of(link.parent);
    parent =
        bind_moments(statements_, link.name, parent + moved(symmetric, link.R_PL, link.r_PL, statements_));
  }

  const Mechanism& mechanism_;
  std::span<const Ex> parameters_;
  Statements& statements_;
  LinkTreeOptions options_;
  std::vector<BodyPose> poses_;
  LinkTree tree_;
};

}  // namespace

LinkTree build_link_tree(const Mechanism& mechanism, std::span<const Ex> parameters, Statements& statements,
                         const LinkTreeOptions& options) {
  return Builder(mechanism, parameters, statements, options).build();
}

}  // namespace jourdain::kinematics
