// Loop joints of the descriptor form: constraint rows over the absolute velocities of all bodies, and which
// combinations of them say something that the tree's joints and the other rows do not.
#pragma once

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/descriptor_forces.hpp"
#include "reference/descriptor_joints.hpp"

namespace jourdain::reference::descriptor {

/// A loop joint. Directions are unit vectors, in the frame that model::Loop says.
template <class Scalar>
struct Loop {
  model::LoopType type = model::LoopType::kBall;
  std::size_t from = 0, to = 0;        ///< frames
  std::optional<std::size_t> carrier;  ///< body; none: the world
  Vector3<Scalar> axis, to_axis;       ///< n and w
  Vector3<Scalar> normals[2];          ///< a₁, a₂; of a pin c₁, c₂
  Vector3<Scalar> to_normals[2];       ///< b₁, b₂
  model::Expression length, residual;  ///< m; any unit
  model::Vector3 radii;                ///< m
  model::Expression height;            ///< m
};

template <class Scalar>
std::vector<Loop<Scalar>> read_loops(const model::Mechanism& mechanism);

/// A mechanism's parts at given parameter values, all in the order of model::Mechanism.
template <class Scalar>
struct Parts {
  const std::vector<Body<Scalar>>& bodies;
  const std::vector<Joint<Scalar>>& joints;
  const std::vector<Frame<Scalar>>& frames;
  const std::vector<Loop<Scalar>>& loops;
  std::span<const Scalar> parameters;
};

/// Rows of all loops in order, over the absolute velocities x = (v_C, ω) of all bodies: ġ = jacobian x + g_t and
/// g̈ = jacobian ẋ + gamma.
template <class Scalar>
struct LoopRows {
  Eigen::MatrixX<Scalar> jacobian;            ///< rows × 6 nb
  Eigen::VectorX<Scalar> value, rate, gamma;  ///< g, ġ and g̈ − jacobian ẋ at the given state
};

/// Rows at time `t` (s); `near` are the joints' scalar coordinates approximately, by joint (see `measure`):
/// residuals see coordinates as the bodies' poses have them.
template <class Scalar>
LoopRows<Scalar> loop_rows(const Parts<Scalar>& parts, Scalar t,
                           const std::vector<AbsoluteBody<Scalar>>& motions,
                           const std::vector<std::vector<Scalar>>& near);

/// Share of the largest singular value below which a combination of loop rows counts as dependent. A model's
/// numbers are rounded to double, so that rows which are dependent on paper differ by 1e-16 times a condition number.
inline constexpr double kDependent = 1e-11;

/// Combinations of loop rows, each divided by its length, that are independent of each other on the motions that
/// `joint_rows` (of full rank) allow: orthonormal left singular vectors times those scales, of singular values
/// above the share `dependent` of the largest. Shape rank × rows.
template <class Scalar>
Eigen::MatrixX<Scalar> independent_combinations(const Eigen::MatrixX<Scalar>& joint_rows,
                                                const Eigen::MatrixX<Scalar>& loop_rows,
                                                double dependent = kDependent);

}  // namespace jourdain::reference::descriptor
