// Implementation of Reference: bushings. For minimal.cpp only.
#pragma once

#include "reference/minimal_elements.hpp"

namespace jourdain::reference {

/// With R the rotation from `from` to `to` and G_i = ½ Σ k − k_i, ½ Σ k_i θ_i² = Σ G_i (1 − R_ii), and its moment on
/// `to`, in the axes of `from`, is the axial vector of (R G)ᵀ − R G.
template <class Scalar>
auto Reference<Scalar>::effect(const model::Bushing& bushing, const Forces& at) const -> Effect {
  using B = Bounded<Scalar>;
  using Components = typename Effect::Components;
  const FrameMotion &from = at.frames[bushing.from.value], &to = at.frames[bushing.to.value];
  const auto entry = [](const FrameMotion& frame, std::size_t i, std::size_t j) {
    return B(frame.R(Eigen::Index(i), Eigen::Index(j)), Scalar(1));
  };
  const auto numbers = [this](const model::Vector3& v) {
    return Components{B(value(v[0])), B(value(v[1])), B(value(v[2]))};
  };
  const auto cross = [](const Components& a, const Components& b) {
    return Components{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto in_from = [&](const Components& v) {
    Components result;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[i] = result[i] + entry(from, j, i) * v[j];
    return result;
  };
  Components difference, velocity, spin_from, spin;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = Eigen::Index(k);
    difference[k] = B(to.p[i], to.p_scale[i]) - B(from.p[i], from.p_scale[i]);
    velocity[k] = at.velocity(bushing.to.value, i) - at.velocity(bushing.from.value, i);
    spin_from[k] = B(from.omega[i], from.omega_scale[i]);
    spin[k] = B(to.omega[i], to.omega_scale[i]) - spin_from[k];
  }
  const Components carried = cross(spin_from, difference);
  for (std::size_t k = 0; k < 3; ++k) velocity[k] = velocity[k] - carried[k];
  B R[3][3];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) R[i][j] = R[i][j] + entry(from, k, i) * entry(to, k, j);

  const Components d = in_from(difference), rate = in_from(velocity), turning = in_from(spin);
  const Components k = numbers(bushing.stiffness), c = numbers(bushing.damping),
                   kt = numbers(bushing.torsional_stiffness), ct = numbers(bushing.torsional_damping);
  const B half = (kt[0] + kt[1] + kt[2]) / B(2);
  Components G, force, moment;
  B energy;
  for (std::size_t i = 0; i < 3; ++i) {
    G[i] = half - kt[i];
    force[i] = -(k[i] * d[i] + c[i] * rate[i]);
    energy = energy + k[i] * d[i] * d[i] / B(2) + G[i] * (B(1) - R[i][i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    moment[i] = G[l] * R[j][l] - G[j] * R[l][j] - ct[i] * turning[i];
  }
  force = Effect::turned(from.R, force);
  moment = Effect::turned(from.R, moment);
  Components on_from = cross(difference, force);
  for (std::size_t i = 0; i < 3; ++i) on_from[i] = on_from[i] + moment[i];
  return {.at_frames = {{bushing.to, force, moment},
                        {bushing.from, Effect::negative(force), Effect::negative(on_from)}},
          .energy = energy};
}

}  // namespace jourdain::reference
