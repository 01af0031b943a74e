// Values of the symbolic statements in high precision: what everything emitted is compared with.
#pragma once

#include <functional>
#include <unordered_map>
#include <vector>

#include "kinematics/statements.hpp"
#include "model/taylor.hpp"
#include "support/scaled_real.hpp"

namespace jourdain::dynamics {

using support::ScaledReal;
/// A number with its first and second derivative by one variable, each in high precision.
using MovingReal = model::Taylor<ScaledReal>;

/// A number with its first derivative by one variable. What does not move has no derivative, whatever is made of it.
struct SlopeReal {
  ScaledReal value, first = {};

  bool moves() const { return first != ScaledReal(); }

  friend SlopeReal operator+(const SlopeReal& a, const SlopeReal& b) {
    return {a.value + b.value, a.first + b.first};
  }
  friend SlopeReal operator*(const SlopeReal& a, const SlopeReal& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first};
  }
  friend SlopeReal operator/(const SlopeReal& a, const SlopeReal& b) {
    const ScaledReal ratio = a.value / b.value;
    return {ratio, (a.first - ratio * b.first) / b.value};
  }
  friend SlopeReal sqrt(const SlopeReal& a) {
    const ScaledReal root = sqrt(a.value);
    return {root, a.moves() ? a.first / (ScaledReal(2) * root) : ScaledReal()};
  }
  friend SlopeReal sin(const SlopeReal& a) { return {sin(a.value), cos(a.value) * a.first}; }
  friend SlopeReal cos(const SlopeReal& a) { return {cos(a.value), -(sin(a.value) * a.first)}; }
  friend SlopeReal value_of(support::Function function, const SlopeReal& a, const SlopeReal& b);
};

/// A number with its first derivatives by several variables, of which it depends on few.
struct GradientReal {
  struct Slope {
    std::size_t variable;
    ScaledReal by;
  };

  ScaledReal value;
  std::vector<Slope> slopes = {};  ///< in the order of the variables; what is missing is zero

  friend GradientReal operator+(const GradientReal& a, const GradientReal& b);
  friend GradientReal operator*(const GradientReal& a, const GradientReal& b);
  friend GradientReal operator/(const GradientReal& a, const GradientReal& b);
  friend GradientReal sqrt(const GradientReal& a);
  friend GradientReal sin(const GradientReal& a);
  friend GradientReal cos(const GradientReal& a);
  friend GradientReal value_of(support::Function function, const GradientReal& a, const GradientReal& b);
};

/// A number as a constant.
inline ScaledReal at_rest(const ScaledReal& number) { return number; }
inline MovingReal at_rest(const MovingReal& number) { return {number.value}; }
inline SlopeReal at_rest(const SlopeReal& number) { return {number.value}; }
inline GradientReal at_rest(const GradientReal& number) { return {number.value}; }

/// The statements evaluated at one state. No lowering, no pass, no program takes part.
template <class Number>
class Evaluation {
 public:
  using LeafValue = std::function<Number(kinematics::LeafKind, std::size_t index)>;

  /// What Statements::hold binds is at rest, or as `held` has it.
  using HeldValue = std::function<Number(std::size_t index, const Number& at_rest)>;

  Evaluation(const kinematics::Statements& statements, const LeafValue& leaf, const HeldValue& held = {});

  /// Value of a leaf, a bound name, a number or an expression of these.
  Number value(const kinematics::Ex& expression) const;
  std::vector<Number> values(const std::vector<kinematics::Ex>& expressions) const;

 private:
  Number power(const kinematics::Ex& base, const kinematics::Ex& exponent) const;

  struct Hash {
    std::size_t operator()(const GiNaC::symbol& s) const { return s.gethash(); }
  };
  struct Same {
    bool operator()(const GiNaC::symbol& a, const GiNaC::symbol& b) const { return a.is_equal(b); }
  };
  std::unordered_map<GiNaC::symbol, Number, Hash, Same> values_;
};

using HighPrecision = Evaluation<ScaledReal>;
using MovingPrecision = Evaluation<MovingReal>;
using SlopePrecision = Evaluation<SlopeReal>;
using GradientPrecision = Evaluation<GradientReal>;
using LeafValue = HighPrecision::LeafValue;

extern template class Evaluation<ScaledReal>;
extern template class Evaluation<MovingReal>;
extern template class Evaluation<SlopeReal>;
extern template class Evaluation<GradientReal>;

inline double to_double(const ScaledReal& value) { return static_cast<double>(value); }

}  // namespace jourdain::dynamics
