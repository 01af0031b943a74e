// Planar linkages as constraint programs: what closed forms are tested with.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "loops/closed_form/position_blocks.hpp"
#include "loops/closed_form/scalar.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

/// A plane vector of numbers.
struct Point {
  double x = 0, y = 0;
};

/// Constraint rows written as formulas of positions; axes of joints may point down, which turns their angles round.
class Rows {
 public:
  loops::Scalar y(std::size_t entry) { return {&builder_, builder_.leaf(ir::LeafKind::kPosition, entry)}; }
  loops::Scalar parameter(std::size_t k) { return {&builder_, builder_.leaf(ir::LeafKind::kParameter, k)}; }
  loops::Scalar time() { return {&builder_, builder_.leaf(ir::LeafKind::kTime, 0)}; }
  loops::Scalar number(double value) { return {&builder_, builder_.literal(value)}; }
  loops::Vector2 point(Point p) { return {number(p.x), number(p.y)}; }

  /// A vector of the frame at `angle`, in the plane's frame.
  loops::Vector2 turned(loops::Scalar angle, loops::Vector2 v) {
    const loops::Vector2 e = {cosine(angle), sine(angle)};
    return v.x * e + v.y * quarter(e);
  }
  /// A bar of that length at that angle.
  loops::Vector2 bar(double length, loops::Scalar angle) {
    return number(length) * loops::Vector2{cosine(angle), sine(angle)};
  }

  void row(loops::Scalar value) { builder_.output("g", rows_++, -1, value.value); }
  void rows(loops::Vector2 value) {
    row(value.x);
    row(value.y);
  }
  /// As the rows of a frame that is askew: combined by a regular matrix.
  void rows_askew(loops::Vector2 value, Random& random) {
    const Point e = {random.uniform(0.5, 2), random.uniform(-0.4, 0.4)},
                f = {random.uniform(-0.4, 0.4), random.uniform(-2, -0.5)};
    rows({number(e.x) * value.x + number(e.y) * value.y, number(f.x) * value.x + number(f.y) * value.y});
  }

  ir::Program finish() { return builder_.finish("g"); }

 private:
  ir::Builder builder_;
  int rows_ = 0;
};

/// A mechanism whose first coordinate drives the others; all are angles but those after `slides_from`.
struct Linkage {
  loops::ClosedFormRequest request;
  double scale = 1;                   ///< sum of its lengths
  bool full_turn = false;             ///< can the first coordinate turn round?
  std::array<double, 2> reachable{};  ///< some interval of it about the initial value, off dead positions
};

/// A four-bar with pins in all ways in which its tree can be cut: both dependent angles on the crank's branch
/// or one on each side, relative or absolute, axes up or down, rows in the ground's, the crank's or a skew
/// frame. Within 0.05 of a change point there is none.
Linkage random_four_bar(std::uint64_t seed);

/// An offset slider-crank, the rod on the crank or on the slide, or (inverted) a rod that slides through a
/// turning block.
Linkage random_slider_crank(std::uint64_t seed, bool inverted);

}  // namespace jourdain::tests
