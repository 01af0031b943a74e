// Mechanisms described where they stand: bodies, and joints at points and along axes of the world at the start, so that
// every loop is closed there by construction. Which joints make the tree and which close loops is drawn.
#pragma once

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

#include "model/mechanism.hpp"
#include "properties/random.hpp"
#include "reference/linkage.hpp"

namespace jourdain::tests {

using Point3 = Eigen::Vector3d;  ///< m or a direction, inertial frame, at the start

/// A joint between two bodies, or a body and the world. Types: revolute, prismatic, cylindrical, universal, spherical.
struct PlacedJoint {
  model::JointType type = model::JointType::kRevolute;
  OptionalBody a, b;
  Point3 point = Point3::Zero();
  Point3 axis = Point3::UnitZ();         ///< universal: the one fixed in `a`
  Point3 second_axis = Point3::UnitX();  ///< universal: the one fixed in `b`
  double stiffness = 0;                  ///< of a prismatic one in the tree, N/m
};

/// A massless rod with a ball at each end; it always closes a loop.
struct PlacedRod {
  OptionalBody a, b;
  Point3 from, to;
};

struct SceneOptions {
  bool planar = false;          ///< all moves in the xy plane: bodies' x axes lie along the bars
  bool spatial_closing = true;  ///< planar: revolute joints close loops as such, not as pins of the plane
  bool absolute = false;        ///< every body is free, every joint closes a loop
  bool tunable = false;         ///< lengths are named parameters
};

/// Collects bodies and joints and makes a mechanism of them. Masses, centres of mass and inertias are drawn.
class PlacedScene {
 public:
  explicit PlacedScene(Random& random) : random_(random) {}

  std::size_t add_body() { return bodies_++; }
  /// A body that starts on a free joint.
  std::size_t add_free_body();
  void add(const PlacedJoint& joint) { joints_.push_back(joint); }
  void add_revolute(OptionalBody a, OptionalBody b, const Point3& point,
                    const Point3& axis = Point3::UnitZ()) {
    add({.a = a, .b = b, .point = point, .axis = axis});
  }
  void add(const PlacedRod& rod) { rods_.push_back(rod); }
  /// Turns the scene so far about the origin.
  void turn(const Eigen::Matrix3d& R);

  /// The mechanism at rest. Every body must hang on the world through joints, or be free.
  model::Mechanism mechanism(const SceneOptions& options);

 private:
  struct Pose {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Point3 p = Point3::Zero();
  };

  void grow_tree();
  bool attach_one();
  void attach_free(std::size_t body);
  void attach(const PlacedJoint& joint);
  Pose child_pose(const PlacedJoint& joint, const Pose& parent, std::size_t child) const;
  void add_loops();
  void close(PlacedJoint joint);
  void fill_bodies();
  std::vector<Point3> attachments(std::size_t body) const;
  const Pose& pose(const OptionalBody& body) const;
  model::FrameIndex frame(const OptionalBody& body, const Point3& point);
  model::Vector3 position(const Point3& p);

  Random& random_;
  std::size_t bodies_ = 0;
  std::vector<std::size_t> free_;
  std::vector<PlacedJoint> joints_;
  std::vector<PlacedRod> rods_;
  SceneOptions options_;
  // Of the mechanism that is being made:
  Linkage linkage_;
  std::vector<Pose> poses_;
  std::vector<bool> reached_;
  std::vector<bool> in_tree_;  ///< by joint
};

Eigen::Matrix3d random_rotation(Random& random);

/// Numbers of joints, frames and parameters rounded to so many decimals, as a program or a person writes them.
model::Mechanism rounded(model::Mechanism mechanism, int decimals);

/// The axis of one end of a loop turned by `angle`, rad; itself where no loop has axes.
model::Mechanism tilted(model::Mechanism mechanism, double angle, Random& random);

}  // namespace jourdain::tests
