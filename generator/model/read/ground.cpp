#include "model/read/ground.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/callable.hpp"
#include "model/coordinates.hpp"
#include "model/expression_derivative.hpp"
#include "model/expression_sums.hpp"
#include "model/read/pushing.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

Variable argument(std::size_t k) { return {.kind = Variable::Kind::kArgument, .component = k}; }

/// x, y, z and t.
Scope scope_of_height() {
  Scope scope = scope_of_places();
  scope.insert(scope.end(), time_scope().begin(), time_scope().end());
  return scope;
}

Expression reciprocal_root(const Expression& square) {
  return Expression::binary(Expression::Op::kDivide, 1.0, Expression::unary(Expression::Op::kSqrt, square));
}

Vector3 constant(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Scope scope_of_places() {
  Scope scope;
  constexpr const char* kNames[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k)
    scope.push_back({kNames[k], argument(k), Measure::variable(needed::kLength)});
  return scope;
}

std::optional<int> read_approaches(const TomlTable& table, int least) {
  const char* key = "approaches";
  if (!table.has(key)) return {};
  if (!table.has("height")) {
    table.error(key, fmt::format("{} has no 'height'", table.what()), "a plane is touched at once");
    return {};
  }
  const std::size_t mark = table.file().error_count();
  const double number = table.file().constant(*table.find(key), {table.quoted(key), needed::kPure});
  if (table.file().error_count() != mark) return {};
  if (number >= least && number <= 20 && number == std::floor(number)) return static_cast<int>(number);
  table.error(key, fmt::format("{} is not a whole number from {} to 20", table.quoted(key), least));
  return {};
}

Ground::Ground(const TomlTable& table, std::string hint_for_normal)
    : n_(unit_direction(table, "normal", {0, 0, 1}, std::move(hint_for_normal))),
      o_(table.vector("point", needed::kLength, {0.0, 0.0, 0.0})),
      a_(constant(slide_directions(n_)[0])),
      b_(constant(slide_directions(n_)[1])) {
  written_ = table.function("height", needed::kLength, scope_of_height());
  refuse_calls(table, "height", written_);
  if (written_.calls(support::Function::kCall)) written_ = 0.0;
  const Vector3 n = constant(n_);
  const Expression level = dot(n, o_);
  Vector3 place;
  for (std::size_t k = 0; k < 3; ++k)
    place[k] = plus(times(n[k], level), plus(times(a_[k], Expression::variable(argument(0))),
                                             times(b_[k], Expression::variable(argument(1)))));
  height_ = with_arguments(written_, place);
  slope_a_ = derivative(height_, argument(0));
  slope_b_ = derivative(height_, argument(1));
  rise_ = derivative(height_, Variable{.kind = Variable::Kind::kTime});
  approaches_ = read_approaches(table, 0).value_or(approaches_);
}

Vector3 Ground::normal_at(const std::array<Expression, 2>& place) const {
  const Expression a = with_arguments(slope_a_, place), b = with_arguments(slope_b_, place);
  const Expression length = reciprocal_root(plus(1.0, plus(times(a, a), times(b, b))));
  return times(length, minus(minus(constant(n_), times(a, a_)), times(b, b_)));
}

Ground::Plane Ground::touched(const Vector3& centre, const Reach& reach) const {
  const Vector3 n = constant(n_);
  if (is_plane()) return {n, dot(n, minus(o_, centre)), {0.0, 0.0, 0.0}};
  const std::array<Expression, 2> below = {dot(a_, centre), dot(b_, centre)};
  std::array<Expression, 2> step, place = below;
  for (int i = 0; i < approaches_; ++i) {
    const Vector3 to = reach(normal_at(place));
    step = {dot(a_, to), dot(b_, to)};
    place = {plus(below[0], step[0]), plus(below[1], step[1])};
  }
  const Vector3 normal = normal_at(place);
  // From the centre to the surface's point, along a, b, n.
  const Expression down = minus(with_arguments(height_, place), dot(n, minus(centre, o_)));
  const Expression behind = plus(times(down, dot(normal, n)),
                                 plus(times(step[0], dot(normal, a_)), times(step[1], dot(normal, b_))));
  return {normal, behind, times(with_arguments(rise_, place), n)};
}

std::array<Vector3, 2> Ground::along(const Plane& plane) const {
  if (is_plane()) return {a_, b_};
  const Vector3 level = minus(a_, times(dot(plane.normal, a_), plane.normal));
  const Vector3 first = times(reciprocal_root(dot(level, level)), level);
  return {first, cross(plane.normal, first)};
}

}  // namespace jourdain::model
