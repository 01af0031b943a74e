#include "emit/rotations.hpp"

#include "emit/parameters.hpp"

namespace jourdain::emit {

namespace {

using Access = Parameter::Access;

Parameter slice(const char* name, Access access) { return {kRealType, name, access, {}, true}; }

/// A vector product's entries, with what is added to each.
Expression cross(const Expression& a, const Expression& b, int row) {
  const int next = (row + 1) % 3, last = (row + 2) % 3;
  return a[next] * b[last] - a[last] * b[next];
}

/// Halves of a vector as constants g0, g1, g2.
Statement halves(const Expression& of) {
  Declare declare{kRealType, Declare::Change::kConstant, {}};
  for (int axis = 0; axis < 3; ++axis)
    declare.variables.push_back({"g" + std::to_string(axis), {}, 0.5 * of[axis]});
  return {declare};
}

Function turn() {
  const Expression from = name("from"), to = name("to"), g0 = name("g0"), g1 = name("g1"), g2 = name("g2");
  return {"turn",
          "Unit quaternion `from` times (1, theta/2), brought to unit length.",
          {slice("from", Access::kRead), slice("theta", Access::kRead), slice("to", Access::kWrite)},
          {},
          {halves(name("theta")),
           set(to[0], from[0] - from[1] * g0 - from[2] * g1 - from[3] * g2),
           set(to[1], from[1] + from[0] * g0 + from[2] * g2 - from[3] * g1),
           set(to[2], from[2] + from[0] * g1 + from[3] * g0 - from[1] * g2),
           set(to[3], from[3] + from[0] * g2 + from[1] * g1 - from[2] * g0),
           {Call{"normalise", {to}, true}}}};
}

Function turning_rate() {
  const Expression omega = name("omega"), rate = name("rate");
  const std::vector<Expression> g = {name("g0"), name("g1"), name("g2")};
  Statements body = {halves(name("theta")),
                     constant("along", g[0] * omega[0] + g[1] * omega[1] + g[2] * omega[2])};
  for (std::size_t row = 0; row < 3; ++row) {
    const std::size_t next = (row + 1) % 3, last = (row + 2) % 3;
    body.push_back(set(
        rate[row], omega[row] + (g[next] * omega[last] - g[last] * omega[next]) + name("along") * g[row]));
  }
  return {"turning_rate",
          "Rate of theta: omega + g x omega + g (g . omega) with g = theta/2.",
          {slice("theta", Access::kRead), slice("omega", Access::kRead), slice("rate", Access::kWrite)},
          {},
          body};
}

/// With e = half ω and e[3] = 1 / (1 + |e|²).
Function half_rotation() {
  const Expression e = name("e"), i = name("i");
  return {"half_rotation",
          "e = half omega, and e[3] = 1 / (1 + |e|^2).",
          {{kRealType, "half"}, slice("omega", Access::kRead), slice("e", Access::kWrite)},
          {},
          {loop("i", 3, {set(e[i], name("half") * name("omega")[i])}),
           set(e[3], 1.0 / (1.0 + (e[0] * e[0] + e[1] * e[1] + e[2] * e[2])))}};
}

Function rotate() {
  const Expression e = name("e"), x = name("x");
  Statements body = {constant("along", e[0] * x[0] + e[1] * x[1] + e[2] * x[2])};
  for (int row = 0; row < 3; ++row)
    body.push_back(constant("x" + std::to_string(row), x[row] - cross(e, x, row) + name("along") * e[row]));
  for (int row = 0; row < 3; ++row) body.push_back(set(x[row], e[3] * name("x" + std::to_string(row))));
  return {"rotate",
          "(1 + [e])^-1 x with e[3] = 1 / (1 + |e|^2); its transpose is that of -e.",
          {slice("e", Access::kRead), slice("x", Access::kWrite)},
          {},
          body};
}

/// Rows are turned back by the transpose.
Function rotate_back() {
  const Expression e = name("e"), back = name("back");
  return {"rotate_back",
          "x (1 + [e])^-1.",
          {slice("e", Access::kRead), slice("x", Access::kWrite)},
          {},
          {{Declare{kRealType, Declare::Change::kConstant, {{"back", {4}, {}, {-e[0], -e[1], -e[2], e[3]}}}}},
           {Call{"rotate", {back, name("x")}, true}}}};
}

}  // namespace

std::vector<Function> rotation_functions() {
  return {turn(), turning_rate(), half_rotation(), rotate(), rotate_back()};
}

}  // namespace jourdain::emit
