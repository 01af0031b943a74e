#include "kinematics/link_tree.hpp"

#include <algorithm>
#include <utility>

#include "kinematics/far_joints.hpp"
#include "kinematics/joint_steps.hpp"
#include "kinematics/numbers.hpp"
#include "support/check.hpp"

namespace jourdain::kinematics {

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

bool LinkTree::turns_beside_parent(std::size_t i) const {
  const Link& link = links[i];
  return link.kind == LinkKind::kTurn && link.parallel && links[link.parent].kind == LinkKind::kTurn;
}

namespace {

MassMoments bind_moments(Statements& statements, const std::string& name, const MassMoments& moments) {
  return {statements.bind(name + "_m", moments.mass), statements.bind(name + "_h", settled(moments.first)),
          statements.bind_symmetric(name + "_S", settled(moments.second))};
}

/// Orientation of a frame with z along the unit vector `z`: a permutation of the axes where z lies on one, otherwise
/// x in the parent's xy plane (one entry of the matrix is zero).
bool is_numeric(const Matrix3& A) {
  return std::all_of(std::begin(A.rows), std::end(A.rows), [](const Vector3& row) {
    return is_number(row[0]) && is_number(row[1]) && is_number(row[2]);
  });
}

/// The nearest rotation to a numeric matrix that rounding has moved off one, by a step of Newton's method, A
/// (3 − AᵀA) / 2: without it that rounding doubles from link to link. Others as they are.
Matrix3 orthonormal(const Matrix3& A) {
  if (!is_numeric(A)) return A;
  Matrix3 rest = transpose(A) * A;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) rest[i][j] = ((i == j ? 3 : 0) - rest[i][j]) / 2;
  return A * rest;
}

/// Whether z is sign times the unit vector of an axis. One entry does not tell: beside 1e-24 a component is 1.
bool is_axis(const Vector3& z, std::size_t axis, int sign) {
  return z[axis].is_equal(sign) && z[(axis + 1) % 3].is_zero() && z[(axis + 2) % 3].is_zero();
}

Matrix3 frame_along(const Vector3& z) {
  if (is_axis(z, 2, 1)) return identity_matrix();
  if (is_axis(z, 0, 1)) return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  if (is_axis(z, 1, 1)) return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
  if (is_axis(z, 2, -1)) return {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  const Ex rho = square_root(z[0] * z[0] + z[1] * z[1]);
  const Vector3 x = {-z[1] / rho, z[0] / rho, 0};
  const Vector3 y = cross(z, x);
  return transpose(Matrix3{{x, y, z}});
}

class Builder {
 public:
  Builder(const Mechanism& mechanism, std::span<const Ex> parameters, Statements& statements,
          const LinkTreeOptions& options)
      : mechanism_(mechanism),
        parameters_(parameters),
        statements_(statements),
        options_(options),
        far_(far_joints(mechanism)) {}

  LinkTree build() {
    tree_.gravity = to_symbolic(mechanism_.gravity, parameters_, statements_);
    tree_.bodies.resize(mechanism_.bodies.size());
    for (model::JointIndex index : model::depth_first(mechanism_)) place_child(index);
    for (std::size_t i = 0; i < mechanism_.bodies.size(); ++i)
      add_body(mechanism_.bodies[i], tree_.bodies[i]);
    for (std::size_t i = 0; i < tree_.links.size(); ++i)
      if (tree_.links[i].kind == LinkKind::kFree && is_leaf(i)) move_to_center_of_mass(i);
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

  void place_child(model::JointIndex index) {
    const model::Joint& joint = mechanism_.joints[index.value];
    BodyPose pose = joint.parent ? tree_.bodies[joint.parent->value] : BodyPose{};
    const Matrix3 R_BJ = rotation(joint.placement.rotation, "R_" + joint.name);
    const Vector3 r_BJ = to_symbolic(joint.placement.position, parameters_, statements_);
    pose.r_LB = bound("r_" + joint.name, pose.r_LB + pose.R_LB * r_BJ);
    pose.R_LB = bound("R_" + joint.name, pose.R_LB * R_BJ);
    for (const JointStep& step : joint_steps(joint)) {
      const Link link = make_link(step, index, pose);
      pose.link = tree_.links.size();
      pose.R_LB = link.R_LJ;
      // Not from r_LB − r_PL for a turn: the difference would have the rounding of the parent's dimensions.
      pose.r_LB = link.turns_about_z()
                      ? Vector3{0, 0, link.along}
                      : bound("r_" + link.name, transpose(link.R_PL) * (pose.r_LB - link.r_PL));
      tree_.links.push_back(link);
    }
    tree_.bodies[joint.child.value] = pose;
  }

  /// `pose` is that of the frame that the step moves, in the parent link.
  Link make_link(const JointStep& step, model::JointIndex index, const BodyPose& pose) {
    const model::Joint& joint = mechanism_.joints[index.value];
    Link link;
    link.joint = index;
    link.name = joint.coordinates.empty() ? joint.name : joint.coordinates[step.coordinate].name;
    link.kind = step.kind;
    link.coordinate = step.coordinate;
    link.parent = pose.link;
    link.R_PL = identity_matrix();
    link.R_LJ = pose.R_LB;
    link.r_PL = pose.r_LB;
    switch (step.kind) {
      case LinkKind::kFree:
        break;
      case LinkKind::kBall:
        link.R_PL = pose.R_LB;
        link.R_LJ = identity_matrix();
        break;
      case LinkKind::kCurve:
        link.R_PJ = pose.R_LB;
        break;
      case LinkKind::kTurn:
      case LinkKind::kSlide:
      case LinkKind::kScrew:
        link.pitch = to_symbolic(joint.pitch, parameters_, statements_);
        align(link, step.axis, pose);
        break;
    }
    return link;
  }

  /// Chooses the link frame: z on the axis, pointing along the parent's positive axes where it is aligned with one.
  void align(Link& link, const std::array<double, 3>& axis, const BodyPose& pose) {
    Vector3 z = bound("axis_" + link.name, pose.R_LB * unit_vector(axis));
    if (is_axis(z, 0, -1) || is_axis(z, 1, -1) || is_axis(z, 2, -1)) {
      link.sign = -1;
      z = Ex(-1) * z;
    }
    const bool numeric = is_number(z[0]) && is_number(z[1]) && is_number(z[2]);
    const Matrix3 R_JL = frame_along(unit_vector(axis));
    link.R_PL = bound("R_" + link.name, numeric ? frame_along(z) : pose.R_LB * R_JL);
    link.R_LJ =
        numeric ? bound("R_" + link.name, orthonormal(transpose(link.R_PL) * pose.R_LB)) : transpose(R_JL);
    link.parallel = options_.share_parallel && pose.link != kGround && is_axis(z, 2, 1);
    if (far_[link.joint.value]) return;
    if (link.kind == LinkKind::kSlide) {
      link.r_PL = zero_vector();
      return;
    }
    link.along = statements_.bind("d_" + link.name, settled(dot(z, pose.r_LB)));
    link.r_PL = bound("r_" + link.name, pose.r_LB - link.along * z);
  }

  bool is_leaf(std::size_t i) const {
    return std::none_of(tree_.links.begin(), tree_.links.end(),
                        [i](const Link& link) { return link.parent == i; });
  }

  /// Moves the origin of a link without outward links to its centre of mass, where M is block diagonal.
  void move_to_center_of_mass(std::size_t i) {
    Link& link = tree_.links[i];
    const MassMoments& about_origin = link.moments;
    if (about_origin.mass.is_zero()) return;
    const Ex inverse = statements_.bind("inverse_mass", 1 / about_origin.mass);
    link.shift = bound("c_" + link.name, inverse * about_origin.first);
    Matrix3 second = about_origin.second;
    for (std::size_t k = 0; k < 3; ++k) second[k] = second[k] - about_origin.first[k] * link.shift;
    link.moments = {about_origin.mass, zero_vector(), bind_second(link.name, second)};
    for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
      BodyPose& pose = tree_.bodies[b];
      if (pose.link != i) continue;
      pose.r_LB = bound("r_" + link.name, pose.r_LB - link.shift);
      tree_.body_moments[b] =
          moved(tree_.body_moments[b], identity_matrix(), Ex(-1) * link.shift, statements_);
    }
  }

  Matrix3 bind_second(const std::string& name, const Matrix3& second) {
    return statements_.bind_symmetric(name + "_S", settled(second));
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
    tree_.body_moments.push_back(
        bind_moments(statements_, body.name, moved(moments, pose.R_LB, pose.r_LB, statements_)));
    MassMoments& target = moments_of(pose.link);
    target = bind_moments(statements_, body.name, target + tree_.body_moments.back());
  }

  /// Moves to the parent what the joint's motion does not feel (base inertial parameters): of a turn
  /// about z what is symmetric about z (mass, h_z and S_zz); of a ball the mass at its centre; of a slide or
  /// curve, which turn nothing, the whole second moment; of a screw S_zz.
  void regroup(Link& link) {
    MassMoments kept = link.moments, moving;
    switch (link.kind) {
      case LinkKind::kTurn:
        std::swap(moving.mass, kept.mass);
        std::swap(moving.first[2], kept.first[2]);
        std::swap(moving.second[2][2], kept.second[2][2]);
        break;
      case LinkKind::kScrew:
        std::swap(moving.second[2][2], kept.second[2][2]);
        break;
      case LinkKind::kSlide:
      case LinkKind::kCurve:
        std::swap(moving.second, kept.second);
        break;
      case LinkKind::kBall:
        std::swap(moving.mass, kept.mass);
        break;
      case LinkKind::kFree:
        return;
    }
    link.moments = kept;
    MassMoments& parent = moments_of(link.parent);
    parent = bind_moments(statements_, link.name, parent + moved(moving, link.R_PL, link.r_PL, statements_));
  }

  const Mechanism& mechanism_;
  std::span<const Ex> parameters_;
  Statements& statements_;
  LinkTreeOptions options_;
  std::vector<bool> far_;  // by JointIndex
  LinkTree tree_;
};

}  // namespace

LinkTree build_link_tree(const Mechanism& mechanism, std::span<const Ex> parameters, Statements& statements,
                         const LinkTreeOptions& options) {
  return Builder(mechanism, parameters, statements, options).build();
}

}  // namespace jourdain::kinematics
