// Dimensions of expressions as they are written, and the units that their places need.
//
// An expression is judged where a parameter with a unit stands in it. Such parameters and variables have dimensions.
// A bare number and a parameter without a unit take the one that their place needs: a product with such a factor fits
// everywhere, and so does t without a parameter with a unit as a factor. Beside one, pi, deg and counts (1, 2, 3, 4, 5,
// 6, 8, 12, 0.5, 0.25, 0.75, 1.5, as they are spelt) are pure numbers, unless
//   - the product is a ratio otherwise ("2*alpha", "2*l1/l2"),
//   - t is a factor of it, or stands inside one ("2*speed*t"),
//   - a variable is and the count is neither a divisor nor 1 or one of the fractions ("2*k*length").
// A count that has a unit after all is written with a point ("4.0*m"), or as a parameter. What is not refused need not
// be right.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "model/units.hpp"

namespace jourdain::model {

/// Any of these units, written as messages show them; none: whatever stands there.
struct Needed {
  std::array<std::string_view, 3> units{};
};

std::string in_words(const Needed& needed);

namespace needed {
inline constexpr Needed kAnything{};
inline constexpr Needed kPure{{"1"}};
inline constexpr Needed kTime{{"s"}};
inline constexpr Needed kAngle{{"rad"}};
inline constexpr Needed kAngularRate{{"rad/s"}};
inline constexpr Needed kLength{{"m"}};
inline constexpr Needed kSpeed{{"m/s"}};
inline constexpr Needed kAcceleration{{"m/s^2"}};
inline constexpr Needed kMass{{"kg"}};
inline constexpr Needed kDensity{{"kg/m^3"}};
inline constexpr Needed kInertia{{"kg m^2"}};
inline constexpr Needed kForce{{"N"}};
inline constexpr Needed kMoment{{"N m"}};
inline constexpr Needed kEnergy{{"J"}};
inline constexpr Needed kStiffness{{"N/m"}};
inline constexpr Needed kDamping{{"N s/m"}};
inline constexpr Needed kAngularStiffness{{"N m/rad"}};
inline constexpr Needed kAngularDamping{{"N m s/rad"}};
inline constexpr Needed kPitch{{"m/rad"}};
inline constexpr Needed kPerTime{{"1/s"}};
/// A gear may turn a rotation into a displacement, or the other way round.
inline constexpr Needed kGearRatio{{"1", "m", "1/m"}};
inline constexpr Needed kRotorInertia{{"kg m^2", "kg"}};
}  // namespace needed

/// What is known of the dimension of a part of an expression.
class Measure {
 public:
  /// Takes the dimension that its place needs.
  static Measure open();
  /// pi; deg.
  static Measure count();
  static Measure degree();
  /// A bare number as it is spelt.
  static Measure literal(std::string_view written);
  /// Open where the unit is empty or none.
  static Measure parameter(std::string_view unit);
  /// In the first unit; open where that is missing.
  static Measure variable(const Needed& unit);
  /// t, s.
  static Measure time();
  /// Of sin, cos, tan.
  static Measure ratio_of(const Measure& argument);

  bool is_known() const;
  /// A parameter with a unit is a factor.
  bool is_anchored() const { return anchored_; }
  bool has_counts() const { return divisors_ || multiples_; }
  bool has_degrees() const { return degrees_; }
  bool is_pure() const { return exponents_ == Exponents{}; }
  bool fits(const Dimension& dimension) const;
  bool fits(const Needed& needed) const;
  /// "kg m^2", "N/m", "rad or 1"; of one that is known.
  std::string unit() const;

  Measure times(const Measure& other) const;
  Measure over(const Measure& other) const;
  Measure power(int exponent) const;
  /// Open where an exponent is no whole 64th any more.
  Measure power(double exponent) const;
  Measure square_root() const;
  /// Of a sum or difference; nothing where the dimensions are known and differ.
  std::optional<Measure> plus(const Measure& other) const;

 private:
  /// Of m, kg, s, A, in 64ths: roots of roots.
  using Exponents = std::array<int, 4>;
  static Measure of(const Dimension& dimension);
  Measure scaled(int factor, int divisor) const;
  void take_flags(const Measure& other);

  Exponents exponents_{};
  bool open_ = false;
  bool anchored_ = false;
  bool moving_ = false;     ///< a variable is
  bool timed_ = false;      ///< t is a factor, or stands inside one
  bool divisors_ = false;   ///< counts that divide, 1 and fractions are factors
  bool multiples_ = false;  ///< other counts are
  bool degrees_ = false;    ///< deg stands in it
};

}  // namespace jourdain::model
