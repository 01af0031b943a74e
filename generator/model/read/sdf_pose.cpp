#include "model/read/sdf_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jourdain::model {

namespace {

double largest(const Numbers3& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

}  // namespace

SdfPose operator*(const SdfPose& a, const SdfPose& b) {
  return {product(a.rotation, b.rotation), sum(product(a.rotation, b.position), a.position)};
}

Numbers3 turned_back(const Matrix3& R, const Numbers3& v) { return product(transposed(R), v); }

SdfPose relative(const SdfPose& a, const SdfPose& b) {
  constexpr double kRounding = 2 * std::numeric_limits<double>::epsilon();
  const Numbers3 between{b.position[0] - a.position[0], b.position[1] - a.position[1],
                         b.position[2] - a.position[2]};
  SdfPose result{product(transposed(a.rotation), b.rotation), turned_back(a.rotation, between)};
  if (a.rotation == b.rotation) result.rotation = kIdentity3;
  const double scale = largest(a.position) + largest(b.position);
  for (double& x : result.position)
    if (std::abs(x) <= kRounding * scale) x = 0;
  return result;
}

Placement placement_of(const SdfPose& pose, double tolerance, SourceRange where) {
  const Numbers3 rpy = pose.rotation == kIdentity3 ? Numbers3{} : rpy_of(pose.rotation, tolerance);
  const Numbers3& p = pose.position;
  return {{p[0], p[1], p[2]}, {{rpy[0], rpy[1], rpy[2]}, where}};
}

}  // namespace jourdain::model
