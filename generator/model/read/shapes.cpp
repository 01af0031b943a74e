#include "model/read/shapes.hpp"

#include <numbers>

namespace jourdain::model {

namespace {

using Op = Expression::Op;

Expression operator+(const Expression& a, const Expression& b) { return Expression::binary(Op::kAdd, a, b); }
Expression operator*(const Expression& a, const Expression& b) {
  return Expression::binary(Op::kMultiply, a, b);
}
Expression operator/(const Expression& a, const Expression& b) {
  return Expression::binary(Op::kDivide, a, b);
}
Expression squared(const Expression& a) { return Expression::power(a, 2); }

Inertia diagonal(const Expression& xx, const Expression& yy, const Expression& zz) {
  return {xx, yy, zz, 0.0, 0.0, 0.0};
}

/// `axial` about the shape's axis, `lateral` about the two others.
Inertia symmetric(std::size_t axis, const Expression& axial, const Expression& lateral) {
  return diagonal(axis == 0 ? axial : lateral, axis == 1 ? axial : lateral, axis == 2 ? axial : lateral);
}

}  // namespace

Expression volume(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return shape.size[0] * shape.size[1] * shape.size[2];
    case Shape::Kind::kCylinder:
      return std::numbers::pi * squared(shape.radius) * shape.length;
    case Shape::Kind::kSphere:
      return Expression(4 * std::numbers::pi / 3) * Expression::power(shape.radius, 3);
    case Shape::Kind::kRod:
      return 0.0;
  }
  return 0.0;
}

Inertia shape_inertia(const Shape& shape, const Expression& mass) {
  switch (shape.kind) {
    case Shape::Kind::kBox: {
      const Expression x2 = squared(shape.size[0]), y2 = squared(shape.size[1]), z2 = squared(shape.size[2]);
      return diagonal(mass * (y2 + z2) / 12, mass * (x2 + z2) / 12, mass * (x2 + y2) / 12);
    }
    case Shape::Kind::kCylinder: {
      const Expression r2 = squared(shape.radius);
      return symmetric(shape.axis, mass * r2 / 2, mass * (Expression(3.0) * r2 + squared(shape.length)) / 12);
    }
    case Shape::Kind::kSphere: {
      const Expression all = Expression(2.0) * mass * squared(shape.radius) / 5;
      return diagonal(all, all, all);
    }
    case Shape::Kind::kRod:
      return symmetric(shape.axis, 0.0, mass * squared(shape.length) / 12);
  }
  return {};
}

}  // namespace jourdain::model
