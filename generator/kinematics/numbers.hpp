// From the doubles of a model file to exact symbolic numbers.
#pragma once

#include <functional>
#include <span>

#include "kinematics/statements.hpp"
#include "model/mechanism.hpp"

namespace jourdain::kinematics {

/// Digits of the floats that sin, cos and sqrt of numbers become; everything else is an exact rational.
inline constexpr long kDigits = 60;

/// The rational number that a finite double is.
Ex exact(double value);

/// Elementary functions of a number at kDigits digits, exact where that is possible (of a symbol: unevaluated).
Ex square_root(const Ex& value);
Ex sine(const Ex& angle);
Ex cosine(const Ex& angle);

/// Expressions of the model as symbols. Every operation on parameters is bound: GiNaC would pull the common denominator
/// of all numbers out of a power of a sum, which leaves factors like 1e-49 and 1e49 behind.
Ex to_symbolic(const model::Expression& expression, std::span<const Ex> parameters, Statements& statements);
Vector3 to_symbolic(const model::Vector3& vector, std::span<const Ex> parameters, Statements& statements);

/// Value of a variable of an expression.
using VariableValue = std::function<Ex(const model::Variable&)>;
Ex to_symbolic(const model::Expression& expression, std::span<const Ex> parameters, Statements& statements,
               const VariableValue& variable);

/// A function of one variable with its first two derivatives.
struct Taylor {
  Ex value, first, second;
};

/// A variable of an expression that is differentiated.
using VariableTaylor = std::function<Taylor(const model::Variable&)>;
/// Every operation is bound, derivatives follow the rules of differentiation operation by operation; external functions
/// have their partial derivatives called.
Taylor differentiated(const model::Expression& expression, std::span<const Ex> parameters,
                      Statements& statements, const VariableTaylor& variable);

/// As a function of its only variable, whose value is `variable`.
Taylor differentiated(const model::Expression& expression, const Ex& variable, std::span<const Ex> parameters,
                      Statements& statements);

/// Rotation matrix of roll, pitch, yaw. With `snap`, each constant angle that is a multiple of π/6 or π/4 but for
/// model::kAngleRounding is that multiple: the matrix stays orthonormal, and equal entries are equal to the last digit.
Matrix3 rotation_matrix(const model::Rotation& rotation, std::span<const Ex> parameters, bool snap,
                        Statements& statements);

/// Removes what only the rounding of kDigits-digit floats left: a float within 1e-45 of 0, 1 or −1 becomes that.
Ex settled(const Ex& value);
Vector3 settled(const Vector3& value);
Matrix3 settled(const Matrix3& value);

/// The unit vector along a non-zero vector of doubles; exact where the vector lies on an axis.
Vector3 unit_vector(const std::array<double, 3>& direction);

}  // namespace jourdain::kinematics
