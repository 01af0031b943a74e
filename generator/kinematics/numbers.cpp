#include "kinematics/numbers.hpp"

#include <cln/cln.h>

#include <cmath>
#include <optional>

#include "kinematics/function_calls.hpp"
#include "support/called_function.hpp"
#include "support/check.hpp"
#include "support/function_derivatives.hpp"

namespace jourdain::kinematics {

using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// A number as a float of kDigits digits, whatever GiNaC's global precision is.
cln::cl_F to_float(const Ex& number) {
  return cln::cl_float(cln::realpart(ex_to<numeric>(number).to_cl_N()), cln::float_format(kDigits));
}

/// `function` of a number at kDigits digits.
template <class Function>
Ex numeric_function(const Ex& argument, Function function) {
  return numeric(cln::cl_N(function(to_float(argument))));
}

/// The number among 0, 1 and −1 that is nearer than `tolerance` to a numeric entry, otherwise the entry.
Ex snapped(const Ex& entry, const numeric& tolerance) {
  if (!is_number(entry)) return entry;
  for (int target : {0, 1, -1})
    if (GiNaC::abs(ex_to<numeric>(Ex(entry - target))) < tolerance) return target;
  return entry;
}

/// How many twelfths of π a number is but for rounding, from 0 to 23, where that is a multiple of π/6 or π/4.
std::optional<int> simple_turn(const Ex& angle) {
  if (!is_number(angle)) return {};
  const cln::cl_F value = to_float(angle), twelfth = cln::pi(value) / 12;
  const cln::cl_I count = cln::round1(value / twelfth);
  const cln::cl_RA quarters = cln::max(cln::cl_RA(cln::abs(count)) / 6, cln::cl_RA(1));
  if (cln::abs(value - count * twelfth) > quarters * cln::rational(cln::cl_DF(model::kAngleRounding)))
    return {};
  const int twelfths = cln::cl_I_to_int(cln::mod(count, 24));
  return twelfths % 2 == 0 || twelfths % 3 == 0 ? std::optional(twelfths) : std::nullopt;
}

/// Of a multiple of π/6 or π/4.
Ex cosine_of_twelfths(int count) {
  const int below_half = count <= 12 ? count : 24 - count;
  const int acute = below_half <= 6 ? below_half : 12 - below_half;
  const Ex half = numeric(1, 2);
  const Ex cosine = acute == 0   ? Ex(1)
                    : acute == 2 ? square_root(3) / 2
                    : acute == 3 ? square_root(2) / 2
                    : acute == 4 ? half
                                 : Ex(0);
  return below_half <= 6 ? cosine : -cosine;
}

/// A bound value with the functions that Expression::evaluate looks up by argument.
struct Symbolic {
  Ex value;
  Statements* statements;

  Symbolic bound(const Ex& result) const { return {statements->bind("expression", result), statements}; }
  friend Symbolic operator-(const Symbolic& a) { return a.bound(-a.value); }
  friend Symbolic operator+(const Symbolic& a, const Symbolic& b) { return a.bound(a.value + b.value); }
  friend Symbolic operator-(const Symbolic& a, const Symbolic& b) { return a.bound(a.value - b.value); }
  friend Symbolic operator*(const Symbolic& a, const Symbolic& b) { return a.bound(a.value * b.value); }
  friend Symbolic operator/(const Symbolic& a, const Symbolic& b) { return a.bound(a.value / b.value); }
  friend Symbolic sqrt(const Symbolic& a) { return a.bound(square_root(a.value)); }
  friend Symbolic sin(const Symbolic& a) { return a.bound(sine(a.value)); }
  friend Symbolic cos(const Symbolic& a) { return a.bound(cosine(a.value)); }
  friend Symbolic value_of(support::Function function, const Symbolic& a, const Symbolic& b) {
    return a.bound(applied(function, a.value, b.value));
  }
};

/// A Taylor with the functions that Expression::evaluate looks up by argument.
struct Jet {
  Taylor at;
  Statements* statements;
  std::vector<Taylor> arguments = {};  ///< of a list that an external function is called with

  Jet bound(const Ex& value, const Ex& first, const Ex& second) const {
    const Ex v = statements->bind("expression", value);
    const Ex d = statements->bind("derivative", first);
    return {{v, d, statements->bind("derivative", second)}, statements};
  }
  /// f(this) for a function with value f and derivatives df, ddf there, all bound.
  Jet chained(const Ex& f, const Ex& df, const Ex& ddf) const {
    const Ex square = statements->bind("derivative", at.first * at.first);
    return bound(f, df * at.first, ddf * square + df * at.second);
  }
  /// The list of arguments `before` with this one more.
  Jet behind(const Jet& before) const {
    const Ex list = applied(support::Function::kArgument, at.value, before.at.value);
    Jet longer{{statements->bind("expression", list), 0, 0}, statements, before.arguments};
    longer.arguments.push_back(at);
    return longer;
  }
  /// The function of that number of this list.
  Jet called(const Ex& which) const {
    const auto of_list = [this](std::uint32_t function) {
      return statements->bind("call", applied(support::Function::kCall, at.value, Ex(function)));
    };
    const auto number = static_cast<std::uint32_t>(ex_to<numeric>(which).to_int());
    Ex first = 0, second = 0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const auto& [value, rate, rate_of_rate] = arguments[i];
      if (rate.is_zero() && rate_of_rate.is_zero()) continue;
      const std::uint32_t slope = support::number_of_slope(number, i);
      const Ex by_i = of_list(slope);
      first += by_i * rate;
      second += by_i * rate_of_rate;
      for (std::size_t k = 0; k < arguments.size(); ++k)
        if (!rate.is_zero() && !arguments[k].first.is_zero())
          second += of_list(support::number_of_slope(slope, k)) * rate * arguments[k].first;
    }
    return bound(of_list(number), first, second);
  }
  /// function(this, b), where pieces of curves meet without a kink: of each the derivatives of its own.
  Jet with_kinks(support::Function function, const Jet& b) const {
    using support::Function;
    const Ex value = applied(function, at.value, b.at.value);
    const auto chosen = [](const Ex& sign, const Ex& negative, const Ex& other) {
      return applied(Function::kWhereNegative, sign, negative) +
             applied(Function::kWhereNotNegative, sign, other);
    };
    const auto where = [&](const Ex& sign, const Taylor& negative, const Taylor& other) {
      const Ex bound_sign = statements->bind("expression", sign);
      return bound(value, chosen(bound_sign, negative.first, other.first),
                   chosen(bound_sign, negative.second, other.second));
    };
    switch (function) {
      case Function::kAbs:
        return where(at.value, {{}, -at.first, -at.second}, at);
      case Function::kMin:
        return where(b.at.value - at.value, b.at, at);
      case Function::kMax:
        return where(at.value - b.at.value, b.at, at);
      case Function::kWhereNegative:
        return where(at.value, b.at, {0, 0, 0});
      case Function::kWhereNotNegative:
        return where(at.value, {0, 0, 0}, b.at);
      default:  // steps between constants
        return bound(value, 0, 0);
    }
  }
  friend Jet operator-(const Jet& a) { return a.bound(-a.at.value, -a.at.first, -a.at.second); }
  friend Jet operator+(const Jet& a, const Jet& b) {
    return a.bound(a.at.value + b.at.value, a.at.first + b.at.first, a.at.second + b.at.second);
  }
  friend Jet operator-(const Jet& a, const Jet& b) {
    return a.bound(a.at.value - b.at.value, a.at.first - b.at.first, a.at.second - b.at.second);
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return a.bound(a.at.value * b.at.value, a.at.first * b.at.value + a.at.value * b.at.first,
                   a.at.second * b.at.value + 2 * a.at.first * b.at.first + a.at.value * b.at.second);
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const Ex inverse = a.statements->bind("inverse", 1 / b.at.value);
    const Ex square = a.statements->bind("inverse", inverse * inverse);
    const Ex cube = a.statements->bind("inverse", 2 * square * inverse);
    return a * b.chained(inverse, -square, cube);
  }
  friend Jet sqrt(const Jet& a) {
    const Ex root = a.statements->bind("root", square_root(a.at.value));
    const Ex slope = a.statements->bind("root", Ex(GiNaC::numeric(1, 2)) / root);
    const Ex curvature = a.statements->bind("root", -slope / (2 * a.at.value));
    return a.chained(root, slope, curvature);
  }
  friend Jet sin(const Jet& a) {
    const Ex s = a.statements->bind("s", sine(a.at.value));
    const Ex c = a.statements->bind("c", cosine(a.at.value));
    return a.chained(s, c, -s);
  }
  friend Jet cos(const Jet& a) {
    const Ex s = a.statements->bind("s", sine(a.at.value));
    const Ex c = a.statements->bind("c", cosine(a.at.value));
    return a.chained(c, -s, -c);
  }
  friend Jet value_of(support::Function function, const Jet& a, const Jet& b) {
    using support::Function;
    if (function == Function::kArgument) return a.behind(b);
    if (function == Function::kCall) return a.called(b.at.value);
    const support::FunctionFacts& facts = support::facts_of(function);
    if (facts.has_kinks) return a.with_kinks(function, b);
    const auto symbolic = [&a](const Ex& value) { return Symbolic{value, a.statements}; };
    const Symbolic x = symbolic(a.at.value), y = symbolic(b.at.value), one = symbolic(1);
    const bool is_curve = facts.operands == 1 ||
                          (function == Function::kPower && b.at.first.is_zero() && b.at.second.is_zero());
    if (is_curve) {
      const support::Curve<Symbolic> f =
          facts.operands == 1 ? support::curve_of(function, x, one) : support::power_of(x, y, one);
      return a.chained(f.value.value, f.slope.value, f.curvature.value);
    }
    const support::Surface<Symbolic> f = support::surface_of(function, x, y, one);
    const Symbolic da = symbolic(a.at.first), db = symbolic(b.at.first), mixed = f.by_ab * da * db;
    const Symbolic square = f.by_aa * (da * da) + (mixed + mixed) + f.by_bb * (db * db);
    return a.bound(f.value.value, f.by_a.value * a.at.first + f.by_b.value * b.at.first,
                   square.value + f.by_a.value * a.at.second + f.by_b.value * b.at.second);
  }
};

}  // namespace

Ex square_root(const Ex& value) {
  if (!is_number(value)) return GiNaC::sqrt(value);
  if (ex_to<numeric>(value).is_negative())
    return applied(support::Function::kPower, value, GiNaC::numeric(1, 2));  // has no value
  Ex exact_root = GiNaC::sqrt(value);
  if (is_number(exact_root)) return exact_root;
  return numeric_function(value, [](const cln::cl_F& x) { return cln::sqrt(x); });
}

Ex exact(double value) {
  JD_CHECK(std::isfinite(value), "{}", value);
  if (value == 0) return 0;
  // As an integer times a power of two: CLN's doubles know no denormal numbers.
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return numeric(cln::cl_N(cln::rational(cln::cl_DF(fraction)) * cln::expt(cln::cl_RA(2), exponent)));
}

Ex sine(const Ex& angle) {
  if (angle.is_zero()) return 0;
  return is_number(angle) ? numeric_function(angle, [](const cln::cl_F& x) { return cln::sin(x); })
                          : GiNaC::sin(angle);
}

Ex cosine(const Ex& angle) {
  if (angle.is_zero()) return 1;
  return is_number(angle) ? numeric_function(angle, [](const cln::cl_F& x) { return cln::cos(x); })
                          : GiNaC::cos(angle);
}

Ex to_symbolic(const model::Expression& expression, std::span<const Ex> parameters, Statements& statements) {
  return to_symbolic(expression, parameters, statements, [](const model::Variable&) -> Ex {
    throw support::InternalError("a variable where only parameters may be");
  });
}

Ex to_symbolic(const model::Expression& expression, std::span<const Ex> parameters, Statements& statements,
               const VariableValue& variable) {
  const auto symbolic = [&statements](const Ex& value) { return Symbolic{value, &statements}; };
  std::vector<Symbolic> values;
  for (const Ex& parameter : parameters) values.push_back(symbolic(parameter));
  return expression
      .evaluate<Symbolic>(
          values, [&](double v) { return symbolic(exact(v)); },
          [&](const model::Variable& v) { return symbolic(variable(v)); })
      .value;
}

Taylor differentiated(const model::Expression& expression, std::span<const Ex> parameters,
                      Statements& statements, const VariableTaylor& variable) {
  const auto constant = [&statements](const Ex& value) { return Jet{{value, 0, 0}, &statements}; };
  std::vector<Jet> values;
  for (const Ex& parameter : parameters) values.push_back(constant(parameter));
  return expression
      .evaluate<Jet>(
          values, [&](double v) { return constant(exact(v)); },
          [&](const model::Variable& v) {
            return Jet{variable(v), &statements};
          })
      .at;
}

Taylor differentiated(const model::Expression& expression, const Ex& variable, std::span<const Ex> parameters,
                      Statements& statements) {
  return differentiated(expression, parameters, statements, [&variable](const model::Variable&) {
    return Taylor{variable, 1, 0};
  });
}

Vector3 to_symbolic(const model::Vector3& vector, std::span<const Ex> parameters, Statements& statements) {
  return {to_symbolic(vector[0], parameters, statements), to_symbolic(vector[1], parameters, statements),
          to_symbolic(vector[2], parameters, statements)};
}

Matrix3 rotation_matrix(const model::Rotation& rotation, std::span<const Ex> parameters, bool snap,
                        Statements& statements) {
  Vector3 c, s;
  for (std::size_t i = 0; i < 3; ++i) {
    const Ex angle = to_symbolic(rotation.rpy[i], parameters, statements);
    const std::optional<int> turn = snap ? simple_turn(angle) : std::nullopt;
    c[i] = statements.bind("c", turn ? cosine_of_twelfths(*turn) : cosine(angle));
    s[i] = statements.bind("s", turn ? cosine_of_twelfths((*turn + 18) % 24) : sine(angle));
  }
  const Matrix3 Rx = {{{1, 0, 0}, {0, c[0], -s[0]}, {0, s[0], c[0]}}};
  const Matrix3 Ry = {{{c[1], 0, s[1]}, {0, 1, 0}, {-s[1], 0, c[1]}}};
  const Matrix3 Rz = {{{c[2], -s[2], 0}, {s[2], c[2], 0}, {0, 0, 1}}};
  return settled(Rz * (Ry * Rx));
}

Ex settled(const Ex& value) {
  static const numeric kRounding = numeric(1, 10).power(45);
  return is_number(value) && !ex_to<numeric>(value).is_rational() ? snapped(value, kRounding) : value;
}

Vector3 settled(const Vector3& value) { return {settled(value[0]), settled(value[1]), settled(value[2])}; }

Matrix3 settled(const Matrix3& value) { return {{settled(value[0]), settled(value[1]), settled(value[2])}}; }

Vector3 unit_vector(const std::array<double, 3>& direction) {
  Vector3 v = {exact(direction[0]), exact(direction[1]), exact(direction[2])};
  const Ex length = square_root(dot(v, v));
  JD_CHECK(!length.is_zero(), "zero axis");
  for (Ex& entry : v.entries) entry = entry / length;
  return v;
}

}  // namespace jourdain::kinematics
