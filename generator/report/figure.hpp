// What a page shows of a mechanism: bodies, whose poses the emitted outputs give, and what is fixed to them.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/matrix3.hpp"
#include "model/mechanism.hpp"

namespace jourdain::report {

/// Fixed to a body, or to the world.
struct FigurePoint {
  std::optional<std::size_t> body = {};
  model::Numbers3 position = {};  ///< m, in the body's frame
};

enum class LineKind { kBody, kSlide, kSpring };

struct FigureLine {
  LineKind kind = LineKind::kBody;
  FigurePoint from, to;
};

struct FigureShape {
  std::size_t body = 0;
  model::Shape::Kind kind = model::Shape::Kind::kBox;
  model::Numbers3 center = {};              ///< m, in the body's frame
  model::Matrix3 R_BS = model::kIdentity3;  ///< the shape's axes in the body's, columns
  model::Numbers3 size = {};                ///< m: edges of a box
  double radius = 0, length = 0;            ///< m
  std::size_t axis = 2;                     ///< of the length
};

/// A joint, or the place where a loop closes.
struct FigureJoint {
  FigurePoint at;
  model::Numbers3 axis = {};  ///< unit vector in the axes of `at`; zero where there is none
  bool turns = false, slides = false;
  std::optional<std::size_t> child = {};  ///< none where a loop closes
};

/// Ground that bodies touch: point + a along[0] + b along[1] + height(a, b) normal, fixed to a body or to the world.
struct FigureGround {
  std::optional<std::size_t> body = {};
  model::Numbers3 point = {}, normal = {};  ///< m; of unit length, as `along`, in the body's frame
  std::array<model::Numbers3, 2> along = {};
  std::function<double(double a, double b)> height;  ///< m; none: 0
  std::vector<std::size_t> touching;                 ///< bodies
};

struct FigureBody {
  std::string name;
  double mass = 0;              ///< kg
  model::Numbers3 center = {};  ///< of mass, m, in the body's frame
};

/// The pose of body i, position (m, inertial frame) and rotation matrix (body to inertial) row by row, is at
/// entries 12 i to 12 i + 11 of the outputs of `mechanism`.
struct Figure {
  model::Mechanism mechanism;    ///< the given one with the bodies' poses as its only outputs
  model::Numbers3 gravity = {};  ///< m/s², inertial frame
  std::vector<FigureBody> bodies;
  std::vector<FigureLine> lines;
  std::vector<FigureShape> shapes;
  std::vector<FigureJoint> joints;
  std::vector<FigureGround> grounds;
  bool flies = false;  ///< some body is free, or hangs on a spherical joint
};

/// `parameters` in the mechanism's order.
Figure make_figure(const model::Mechanism& mechanism, const std::vector<double>& parameters);

}  // namespace jourdain::report
