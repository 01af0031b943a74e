// Closed forms in space: suspensions, struts and points between three spheres of random shape, whatever row
// comes first.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loops/closed_form/position_blocks.hpp"
#include "loops/closed_form/scalar.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {
namespace {

using ir::LeafKind;
using loops::ClosedForm;
using loops::ClosedFormRequest;
using loops::Matrix3;
using loops::Scalar;
using loops::Vector3;
using ::testing::HasSubstr;

constexpr std::uint64_t kSeeds = 40;
/// m, mechanisms of 1 m: some roundings, times what the condition of a solution at a margin of 0.05 makes of them.
constexpr double kResidual = 2e-14;
constexpr double kNearDeadPositions = 1e-11;
constexpr int kSteps = 100;
constexpr double kRange = 0.15;

using Numbers = std::array<double, 3>;

/// Rows of one mechanism as formulas; y[0] is independent.
class Sketch {
 public:
  explicit Sketch(std::uint64_t seed) : random(seed) {}

  Scalar number(double value) { return {&builder_, builder_.literal(value)}; }
  Scalar y(std::size_t k) { return {&builder_, builder_.leaf(LeafKind::kPosition, k)}; }
  Vector3 vector(const Numbers& v) { return {number(v[0]), number(v[1]), number(v[2])}; }
  Vector3 drawn(double size) {
    return vector({random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)});
  }

  /// Of the quaternion that starts at y[k], as the compiler writes it.
  Matrix3 rotation(std::size_t k) {
    const Scalar w = y(k), v[] = {y(k + 1), y(k + 2), y(k + 3)};
    const auto twice = [&](Scalar a, Scalar b) { return (2.0 * a) * b; };
    const Scalar xx = twice(v[0], v[0]), yy = twice(v[1], v[1]), zz = twice(v[2], v[2]),
                 xy = twice(v[0], v[1]), xz = twice(v[0], v[2]), yz = twice(v[1], v[2]), wx = twice(v[0], w),
                 wy = twice(v[1], w), wz = twice(v[2], w), one = number(1);
    return {{{one - yy - zz, xy + wz, xz - wy},
             {xy - wz, one - xx - zz, yz + wx},
             {xz + wy, yz - wx, one - xx - yy}}};
  }

  /// About the x axis.
  Vector3 turned(Scalar angle, Vector3 v) {
    const Scalar c = cosine(angle), s = sine(angle);
    return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
  }

  /// A fixed rotation that is askew, or none.
  Matrix3 skew(bool is_askew) {
    const double a = is_askew ? random.uniform(-0.5, 0.5) : 0, b = is_askew ? random.uniform(-0.5, 0.5) : 0;
    const double c = std::cos(a), s = std::sin(a), d = std::cos(b), e = std::sin(b);
    return {{vector({c, s, 0}), vector({-s * d, c * d, e}), vector({s * e, -c * e, d})}};
  }

  double at_start(Scalar value) {
    ir::Builder copy = builder_;
    copy.output("value", -1, -1, value.value);
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kPosition] = start;
    return ir::interpret(copy.finish("value"), leaves).back();
  }
  Vector3 at_start(Vector3 v) { return vector({at_start(v.x), at_start(v.y), at_start(v.z)}); }

  void hold(Scalar value) { rows_.push_back(value.value); }
  void hold(Vector3 value) {
    hold(value.x);
    hold(value.y);
    hold(value.z);
  }
  /// |difference| as it is at the start.
  void hold_length(Vector3 difference) {
    const Vector3 now = at_start(difference);
    const double l = at_start(square_root(dot(now, now)));
    spans_.emplace(rows_.size(), difference);
    lengths_.push_back(l);
    hold(0.5 * (dot(difference, difference) / number(l) - l));
  }

  /// The blocks' rows in another order; `with_spans`: rods are known to be some.
  ClosedFormRequest request(const loops::PositionBlock& unknowns, bool with_spans) {
    ClosedFormRequest request;
    request.nothing = 1e-13;  // numbers are drawn and placed in double here
    ir::Builder spans = builder_;
    std::size_t rod = 0;
    for (const auto& [row, difference] : spans_) {
      int axis = 0;
      for (const Scalar entry : {difference.x, difference.y, difference.z})
        spans.output("span", static_cast<int>(row), axis++, entry.value);
      spans.output("length", static_cast<int>(row), -1, spans.literal(lengths_[rod++]));
    }
    if (with_spans) request.spans = spans.finish("spans");
    for (std::size_t r = 0; r < rows_.size(); ++r) builder_.output("g", static_cast<int>(r), -1, rows_[r]);
    request.g = builder_.finish("g");
    loops::PositionBlock block = unknowns;
    for (std::size_t r = 0; r < rows_.size(); ++r) block.rows.push_back(r);
    std::rotate(block.rows.begin(), block.rows.begin() + static_cast<long>(random.below(rows_.size())),
                block.rows.end());
    request.blocks = {block};
    request.initial_y = start;
    request.angular.assign(start.size(), false);
    request.angular[0] = true;
    if (!block.dependents.empty()) request.angular[block.dependents[0]] = is_angle;
    request.range.resize(start.size());
    request.range[0] = {{start[0] - kRange, start[0] + kRange}};
    return request;
  }

  Random random;
  std::vector<double> start;
  bool is_angle = true;

 private:
  ir::Builder builder_;
  std::vector<ir::Signed> rows_;
  std::map<std::size_t, Vector3> spans_;
  std::vector<double> lengths_;
};

std::vector<double> random_start(Random& random, bool has_scalar) {
  std::vector<double> y = {random.uniform(-3, 3)};
  double size = 0;
  for (int k = 0; k < 4; ++k) y.push_back(random.uniform(-1, 1));
  for (int k = 1; k < 5; ++k) size += y[std::size_t(k)] * y[std::size_t(k)];
  for (int k = 1; k < 5; ++k) y[std::size_t(k)] /= std::sqrt(size);
  if (has_scalar) y.push_back(random.uniform(-3, 3));
  return y;
}

/// Moves the independent coordinate over its range: rows stay closed, quaternions of unit length, nothing jumps.
void expect_closed(const ClosedFormRequest& request, const ir::Program& close, double residual = kResidual) {
  double worst = 0, farthest = 0;
  for (const double end : *request.range[0]) {
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kPosition] = request.initial_y;
    leaves[LeafKind::kTime] = {0};
    std::vector<double>& y = leaves[LeafKind::kPosition];
    for (int i = 0; i <= kSteps; ++i) {
      const std::vector<double> before = y;
      y[0] = request.initial_y[0] + (end - request.initial_y[0]) * i / kSteps;
      const std::vector<double> found = ir::interpret(close, leaves);
      for (std::size_t k = 0; k < found.size(); ++k)
        if (close.outputs[k].row >= 0) y[std::size_t(close.outputs[k].row)] = found[k];
      for (const double row : ir::interpret(request.g, leaves)) worst = std::max(worst, std::fabs(row));
      for (std::size_t k = 1; k < y.size(); ++k) farthest = std::max(farthest, std::fabs(y[k] - before[k]));
      if (const auto first = request.blocks[0].rotation) {
        double square = -1;
        for (std::size_t k = 0; k < 4; ++k) square += y[*first + k] * y[*first + k];
        worst = std::max(worst, std::fabs(square) / 10);
      }
    }
  }
  EXPECT_LE(worst, residual);
  EXPECT_LE(farthest, 0.2) << "a coordinate jumps";
}

/// Many mechanisms are closed over the range, the others are refused for want of a proof.
void expect_family(const std::function<ClosedFormRequest(std::uint64_t, bool with_spans)>& draw) {
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const ClosedFormRequest request = draw(seed, seed % 2 == 0);
    const auto result = closed_form(request);
    if (const auto* form = std::get_if<ClosedForm>(&result)) {
      ++solved;
      EXPECT_GT(form->smallest_margin, 0);
      expect_closed(request, form->close);
      continue;
    }
    EXPECT_THAT(std::get<std::string>(result),
                testing::AnyOf(HasSubstr("not proven"), HasSubstr("dead position")));
  }
  EXPECT_GE(solved, kSeeds / 4);
}

constexpr std::size_t kRotation = 1, kScalar = 5;

/// P + R c of an upright whose ball joint sits on a wishbone.
struct Upright {
  Scalar angle;
  Vector3 ball;
  Matrix3 fixed, R;

  Upright(Sketch& sketch, bool is_askew, std::size_t wishbone = 0)
      : angle(sketch.y(wishbone)),
        ball(sketch.turned(angle, sketch.drawn(0.4))),
        fixed(sketch.skew(is_askew)),
        R(sketch.rotation(kRotation)) {}
  Vector3 at(Sketch& sketch, Vector3 point) const { return ball + sketch.turned(angle, fixed * (R * point)); }
};

void add_rod(Sketch& sketch, const Upright& upright) {
  const Vector3 end = upright.at(sketch, sketch.drawn(0.3));
  sketch.hold_length(end - (sketch.at_start(end) + sketch.drawn(0.5)));
}

TEST(SpatialForm, OfDoubleWishbones) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, true);
    const Upright upright(sketch, seed % 3 == 0);
    const Vector3 top = upright.at(sketch, sketch.drawn(0.4)),
                  arm = sketch.skew(seed % 5 != 0) * sketch.turned(sketch.y(kScalar), sketch.drawn(0.5));
    sketch.hold(top - arm - sketch.at_start(top - arm));
    add_rod(sketch, upright);
    return sketch.request({{}, {kScalar}, kRotation}, with_spans);
  });
}

TEST(SpatialForm, OfUprightsOnTheWishboneThatFollows) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, true);
    const Upright upright(sketch, seed % 3 == 0, kScalar);
    const Vector3 lower = upright.at(sketch, sketch.drawn(0.4)),
                  arm = sketch.turned(sketch.y(0), sketch.drawn(0.5));
    sketch.hold(lower - arm - sketch.at_start(lower - arm));
    add_rod(sketch, upright);
    return sketch.request({{}, {kScalar}, kRotation}, with_spans);
  });
}

TEST(SpatialForm, OfUprightsOnASlide) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, true);
    sketch.is_angle = false;
    const Upright upright(sketch, seed % 3 == 0);
    const Vector3 top = upright.at(sketch, sketch.drawn(0.4)), along = sketch.y(kScalar) * sketch.drawn(1);
    sketch.hold(top - along - sketch.at_start(top - along));
    add_rod(sketch, upright);
    return sketch.request({{}, {kScalar}, kRotation}, with_spans);
  });
}

TEST(SpatialForm, OfStrutsWithACoordinate) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, true);
    sketch.is_angle = false;
    const Upright upright(sketch, seed % 3 == 0);
    const Vector3 top = upright.at(sketch, sketch.drawn(0.2) + sketch.y(kScalar) * sketch.drawn(1));
    sketch.hold(top - sketch.at_start(top));
    add_rod(sketch, upright);
    return sketch.request({{}, {kScalar}, kRotation}, with_spans);
  });
}

TEST(SpatialForm, OfStrutsThatSlideThroughAPoint) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, false);
    const Upright upright(sketch, seed % 3 == 0);
    const Vector3 on_axis = sketch.drawn(0.3), first = sketch.drawn(1), second = sketch.drawn(1);
    const Vector3 lower = upright.at(sketch, on_axis),
                  top = sketch.at_start(upright.at(sketch, on_axis + cross(first, second)));
    for (const Vector3& across : {first, second})
      sketch.hold(dot(upright.at(sketch, across) - upright.ball, top - lower));
    add_rod(sketch, upright);
    return sketch.request({{}, {}, kRotation}, with_spans);
  });
}

TEST(SpatialForm, OfPointsBetweenThreeSpheres) {
  expect_family([](std::uint64_t seed, bool with_spans) {
    Sketch sketch(seed);
    sketch.start = {sketch.random.uniform(-3, 3), sketch.random.uniform(-1, 1), sketch.random.uniform(-1, 1),
                    sketch.random.uniform(-1, 1)};
    sketch.is_angle = false;
    const Vector3 x = {sketch.y(1), sketch.y(2), sketch.y(3)};
    for (int k = 0; k < 3; ++k) {
      const Vector3 knee = sketch.turned(sketch.y(0), sketch.drawn(0.4));
      sketch.hold_length(x + sketch.drawn(0.1) - knee - sketch.drawn(1));
    }
    return sketch.request({{}, {1, 2, 3}, {}}, with_spans);
  });
}

/// What the forms must not take: the same rows with a point that is not where the formulas need it.
TEST(SpatialForm, RefusesWhatItDoesNotSolve) {
  const auto why = [](const std::function<void(Sketch&, const Upright&)>& add, bool has_scalar) {
    Sketch sketch(7);
    sketch.start = random_start(sketch.random, has_scalar);
    const Upright upright(sketch, false);
    add(sketch, upright);
    loops::PositionBlock block{{}, {}, kRotation};
    if (has_scalar) block.dependents = {kScalar};
    const auto result = closed_form(sketch.request(block, true));
    const auto* failure = std::get_if<std::string>(&result);
    return failure ? *failure : "";
  };
  // A point on an ellipse in place of a wishbone's circle.
  EXPECT_THAT(
      why(
          [](Sketch& sketch, const Upright& upright) {
            const Scalar c = cosine(sketch.y(kScalar)), s = sine(sketch.y(kScalar));
            const Vector3 gap = upright.at(sketch, sketch.drawn(0.4)) - Vector3{c, 1.1 * s, sketch.number(0)};
            sketch.hold(gap - sketch.at_start(gap));
            add_rod(sketch, upright);
          },
          true),
      HasSubstr("none of those that determine a rotation"));
  // Three rods and no ball joint.
  EXPECT_THAT(why(
                  [](Sketch& sketch, const Upright& upright) {
                    for (int k = 0; k < 3; ++k) add_rod(sketch, upright);
                  },
                  false),
              HasSubstr("none of those that determine a rotation"));
}

/// A range that passes the dead position of the rod is refused, half of it is not: the proof looks at all of it.
TEST(SpatialForm, IsProvenOverTheRangeAndNoFurther) {
  std::size_t limited = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Sketch sketch(seed);
    sketch.start = random_start(sketch.random, true);
    const Upright upright(sketch, false);
    const Vector3 top = upright.at(sketch, sketch.drawn(0.4)),
                  arm = sketch.turned(sketch.y(kScalar), sketch.drawn(0.5));
    sketch.hold(top - arm - sketch.at_start(top - arm));
    add_rod(sketch, upright);
    ClosedFormRequest request = sketch.request({{}, {kScalar}, kRotation}, true);
    std::optional<double> proven, refused;
    for (const double half : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 1.5}) {
      request.range[0] = {{request.initial_y[0] - half, request.initial_y[0] + half}};
      const auto result = closed_form(request);
      if (std::holds_alternative<ClosedForm>(result)) {
        EXPECT_FALSE(refused) << "proven over more than was refused";
        expect_closed(request, std::get<ClosedForm>(result).close, kNearDeadPositions);
        proven = half;
      } else {
        refused = half;
      }
    }
    limited += proven && refused;
  }
  EXPECT_GE(limited, kSeeds / 4);
}

}  // namespace
}  // namespace jourdain::tests
