// Principal axes of a link, which some libraries want.
#pragma once

#include <Eigen/Dense>

#include "bench/compare/robot.hpp"

namespace jourdain::compare {

/// Columns of `axes` are the principal axes in the link's frame, right-handed; moments in kg m².
struct Principal {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero(), center = Eigen::Vector3d::Zero();
};

inline Eigen::Vector3d eigen_of(const model::Numbers3& v) { return {v[0], v[1], v[2]}; }

inline Eigen::Matrix3d matrix_of(const model::Matrix3& m) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = eigen_of(m[static_cast<std::size_t>(i)]);
  return matrix;
}

inline Principal principal_of(const Link& link) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix_of(link.inertia));
  Principal principal{solver.eigenvectors(), solver.eigenvalues(), eigen_of(link.center)};
  if (principal.axes.determinant() < 0) principal.axes = -principal.axes;
  return principal;
}

}  // namespace jourdain::compare
