// What rig.toml calls, as its user would write it: the same as there, times a gain.
#pragma once

#include <math.h>

#include "rig.hpp"

template <class Real>
struct rig::Functions {
  Real gain = Real(1);

  Real grip(const Real& slip, const Real& load, const Real& width) const noexcept {
    return gain * load * tanh(slip / width);
  }
  Real grip_slip(const Real& slip, const Real& load, const Real& width) const noexcept {
    const Real t = tanh(slip / width);
    return gain * load * (Real(1) - t * t) / width;
  }
  Real grip_load(const Real& slip, const Real&, const Real& width) const noexcept {
    return gain * tanh(slip / width);
  }
  Real grip_width(const Real& slip, const Real& load, const Real& width) const noexcept {
    return -slip / width * grip_slip(slip, load, width);
  }
  Real hardening(const Real& x) const noexcept { return x + Real(3) * x * x * x; }
  Real hardening_x(const Real& x) const noexcept { return Real(1) + Real(9) * x * x; }

  Real cam(const Real& angle, const Real& height) const noexcept { return height * (Real(1) - cos(angle)); }
  Real cam_angle(const Real& angle, const Real& height) const noexcept { return height * sin(angle); }
  Real cam_angle_angle(const Real& angle, const Real& height) const noexcept { return height * cos(angle); }
  Real cam_angle_angle_angle(const Real& angle, const Real& height) const noexcept {
    return -height * sin(angle);
  }

 private:
  static double sin(double x) noexcept { return ::sin(x); }
  static float sin(float x) noexcept { return ::sinf(x); }
  static double cos(double x) noexcept { return ::cos(x); }
  static float cos(float x) noexcept { return ::cosf(x); }
  static double tanh(double x) noexcept { return ::tanh(x); }
  static float tanh(float x) noexcept { return ::tanhf(x); }
};
