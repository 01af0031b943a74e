#include "dynamics/rolling_ground.hpp"

#include <fmt/format.h>

#include "dynamics/element_forces.hpp"
#include "kinematics/numbers.hpp"
#include "model/expression_derivative.hpp"

namespace jourdain::dynamics {

namespace {

using kinematics::Matrix3;
using model::Expression;
using model::LoopType;
using model::Variable;

/// A height as a function of a point (p₁, p₂) of the plane, with its derivatives.
class Surface {
 public:
  Surface(const Scene& scene, const Expression& height, const std::array<Vector3, 2>& axes, std::string name)
      : scene_(scene), axes_(axes), name_(std::move(name)), height_(height) {
    for (std::size_t i = 0; i < 3; ++i) {
      first_[i] = model::derivative(height, argument(i));
      for (std::size_t j = 0; j <= i; ++j)
        second_[i][j] = second_[j][i] = model::derivative(first_[i], argument(j));
    }
  }

  struct Slopes {
    Ex value;
    std::array<Ex, 2> first;                  ///< h₁, h₂
    std::array<std::array<Ex, 2>, 2> second;  ///< h₁₁, …
  };
  Slopes at(const std::array<Ex, 2>& p, const std::string& step) const {
    const Point point{*this, p, name_ + step};
    Slopes slopes;
    slopes.value = point.value(height_, "h");
    for (std::size_t i = 0; i < 2; ++i) {
      Ex sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += axes_[i][k] * point.value(first_[k], "s");
      slopes.first[i] = scene_.statements.bind(point.name + "s", sum);
      for (std::size_t j = 0; j <= i; ++j) {
        Ex bend = 0;
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t l = 0; l < 3; ++l)
            bend += axes_[i][k] * axes_[j][l] * point.value(second_[k][l], "b");
        slopes.second[i][j] = slopes.second[j][i] = scene_.statements.bind(point.name + "b", bend);
      }
    }
    return slopes;
  }

 private:
  static Variable argument(std::size_t k) { return {.kind = Variable::Kind::kArgument, .component = k}; }

  struct Point {
    const Surface& of;
    const std::array<Ex, 2>& p;
    std::string name;

    Ex value(const Expression& expression, const char* what) const {
      if (expression.is_zero()) return 0;
      kinematics::Statements& statements = of.scene_.statements;
      return statements.bind(name + what,
                             kinematics::to_symbolic(
                                 expression, of.scene_.leaves.parameters, statements, [&](const Variable& v) {
                                   return statements.bind(name + "x", of.axes_[0][v.component] * p[0] +
                                                                          of.axes_[1][v.component] * p[1]);
                                 }));
    }
  };

  const Scene& scene_;
  const std::array<Vector3, 2>& axes_;
  std::string name_;
  Expression height_;
  std::array<Expression, 3> first_;
  std::array<std::array<Expression, 3>, 3> second_;
};

/// The farthest point against m, and how it changes with m.
struct Farthest {
  Ex root, inverse;  ///< sqrt(m·E m), 1 over it
  Vector3 q;         ///< E m/sqrt(m·E m)
};

class Approach {
 public:
  Approach(const Scene& scene, const Vector3& centre, const RoundShape& round, std::string name)
      : scene_(scene), centre_(centre), round_(round), name_(std::move(name)) {}

  Farthest farthest(const Surface::Slopes& slopes, const std::string& step) const {
    const std::string name = name_ + step;
    const Vector3 m = {-slopes.first[0], -slopes.first[1], 1};
    const Vector3 weighed = scene_.statements.bind(name + "e", round_.shape * m);
    const Ex root = scene_.statements.bind(
        name + "r", kinematics::square_root(scene_.statements.bind(name + "u", dot(m, weighed))));
    const Ex inverse = scene_.statements.bind(name + "i", 1 / root);
    return {root, inverse, scene_.statements.bind(name + "q", inverse * weighed)};
  }

  /// What is zero where p is the point, and −1 over its derivative by p.
  struct Step {
    std::array<Ex, 2> misfit;
    std::array<std::array<Ex, 2>, 2> inverse;
    Ex determinant, trace;
  };

  Step step(const std::array<Ex, 2>& p, const Surface::Slopes& slopes, const Farthest& far,
            const std::string& number) const {
    kinematics::Statements& statements = scene_.statements;
    const std::string name = name_ + number;
    const Ex scale = statements.bind(name + "l", round_.size * far.inverse);
    Ex give[2][2], J[2][2];
    Step result;
    for (std::size_t i = 0; i < 2; ++i) {
      result.misfit[i] = statements.bind(name + "f", centre_[i] - p[i] - round_.size * far.q[i]);
      for (std::size_t k = 0; k <= i; ++k)
        give[i][k] = give[k][i] = statements.bind(name + "p", round_.shape[i][k] - far.q[i] * far.q[k]);
    }
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const Ex sum =
            statements.bind(name + "k", give[i][0] * slopes.second[0][j] + give[i][1] * slopes.second[1][j]);
        J[i][j] = statements.bind(name + "j", (i == j ? 1 : 0) - scale * sum);
      }
    result.trace = J[0][0] + J[1][1];
    result.determinant = statements.bind(name + "t", J[0][0] * J[1][1] - J[0][1] * J[1][0]);
    const Ex inverse = statements.bind(name + "d", 1 / result.determinant);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        result.inverse[i][j] =
            statements.bind(name + "a", i == j ? inverse * J[1 - i][1 - i] : -inverse * J[i][j]);
    return result;
  }

 private:
  const Scene& scene_;
  const Vector3& centre_;
  const RoundShape& round_;
  std::string name_;
};

}  // namespace

RoundShape round_shape(const Scene& scene, const model::Loop& loop,
                       const std::function<Vector3(const Vector3&)>& seen) {
  const auto number = [&](const Expression& given) {
    return general_value(scene, loop.name + "l", given, Inputs::kZero);
  };
  if (loop.type == LoopType::kRollingBall) return {number(loop.length), kinematics::identity_matrix()};
  const auto bound = [&](const Matrix3& E) { return scene.statements.bind_symmetric(loop.name + "gs", E); };
  const auto add = [](Matrix3& E, const Ex& weight, const Vector3& e) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) E[i][j] += weight * e[i] * e[j];
  };
  if (loop.type == LoopType::kRollingWheel) {
    Matrix3 E = kinematics::identity_matrix();
    add(E, -1, seen(kinematics::unit_vector(loop.to_axis)));
    return {number(loop.length), bound(E)};
  }
  Matrix3 E = kinematics::zero_matrix();
  for (std::size_t k = 0; k < 3; ++k) {
    const Ex radius = number(loop.radii[k]),
             square = scene.statements.bind(loop.name + "rr", radius * radius);
    add(E, square, seen(kinematics::identity_matrix()[k]));
  }
  return {1, bound(E)};
}

GroundTouch touch_ground(const Scene& scene, const model::Loop& loop, const std::array<Vector3, 2>& axes,
                         const Vector3& centre, const RoundShape& round) {
  const std::string name = loop.name + "g";
  kinematics::Statements& statements = scene.statements;
  const Surface surface(scene, loop.height, axes, name);
  const Approach approach(scene, centre, round, name);
  std::array<Ex, 2> p = {centre[0], centre[1]};
  GroundTouch touch;
  for (int i = 0; i < loop.approaches; ++i) {
    const std::string number = fmt::format("{}", i);
    const Surface::Slopes there = surface.at(p, number);
    const Approach::Step step = approach.step(p, there, approach.farthest(there, number), number);
    const auto along = [&](std::size_t k) {
      return statements.bind(name + "m",
                             step.inverse[k][0] * step.misfit[0] + step.inverse[k][1] * step.misfit[1]);
    };
    const std::array<Ex, 2> change = {along(0), along(1)};
    for (std::size_t k = 0; k < 2; ++k) p[k] = statements.bind(name + "c", p[k] + change[k]);
    touch.search.missed = statements.bind(name + "m", change[0] * change[0] + change[1] * change[1]);
  }
  for (std::size_t k = 0; k < 2; ++k) p[k] = touch.search.found[k] = statements.hold(name + "h", p[k]);
  const Surface::Slopes slopes = surface.at(p, "g");
  const Ex &s = slopes.first[0], &t = slopes.first[1];
  const Farthest far = approach.farthest(slopes, "g");
  const Approach::Step here = approach.step(p, slopes, far, "g");
  touch.search.misfit = here.misfit;
  touch.search.inverse = here.inverse;
  touch.search.determinant = here.determinant;
  touch.search.trace = here.trace;
  const Ex over = statements.bind(name + "o", 1 + t * t), square = statements.bind(name + "o", over + s * s);
  const Ex inverse = statements.bind(name + "o", 1 / kinematics::square_root(square)),
           across = statements.bind(name + "o", 1 / kinematics::square_root(over));
  const Ex above = statements.bind(name + "v", centre[2] - slopes.value - s * (centre[0] - p[0]) -
                                                   t * (centre[1] - p[1]) - round.size * far.root);
  touch.height = above * inverse;
  touch.normal = statements.bind(name + "w", inverse * Vector3{-s, -t, 1});
  touch.lever = Ex(-round.size) * far.q;
  const Ex both = statements.bind(name + "o", inverse * across);
  touch.along = {statements.bind(name + "y", both * Vector3{over, -s * t, s}),
                 statements.bind(name + "z", across * Vector3{0, 1, t})};
  return touch;
}

}  // namespace jourdain::dynamics
