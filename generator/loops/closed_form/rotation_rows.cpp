#include "loops/closed_form/rotation_rows.hpp"

#include <algorithm>
#include <cmath>

#include "passes/rewrite.hpp"

namespace jourdain::loops {

namespace {

Vector3 row_of(const RotationCoefficients& m, std::size_t i) { return {m[i][0], m[i][1], m[i][2]}; }

}  // namespace

RotationCoefficients transposed(const RotationCoefficients& m) {
  RotationCoefficients t;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = m[j][i];
  return t;
}

Scalar RotationRows::coefficient(const Polynomial& row, const Monomial& powers) const {
  const auto it = row.find(powers);
  return it == row.end() ? number(0) : it->second;
}

RotationCoefficients RotationRows::coefficients(const Polynomial& row, const Monomial& factor) const {
  RotationCoefficients W;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) W[i][j] = coefficient(row, rotation_entry(i, j) * factor);
  return W;
}

bool RotationRows::only(const Polynomial& row, const std::vector<Monomial>& factors_of_rotation,
                        const std::vector<Monomial>& others) {
  std::vector<Monomial> allowed = others;
  for (const Monomial& factor : factors_of_rotation)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) allowed.push_back(rotation_entry(i, j) * factor);
  return std::all_of(row.begin(), row.end(), [&](const auto& term) {
    return std::find(allowed.begin(), allowed.end(), term.first) != allowed.end();
  });
}

RotationRows::Multiple RotationRows::multiple(Scalar a) const {
  const ir::Node& node = builder_.program()[a.value.value];
  const Scalar sign = number(a.value.negative ? -1 : 1);
  if (node.op == ir::Op::kLiteral) return {a, number(1)};
  if (node.op == ir::Op::kMultiply)
    for (const auto& [factor, other] : {std::pair{node.a, node.b}, std::pair{node.b, node.a}})
      if (const ir::Node& part = builder_.program()[factor]; part.op == ir::Op::kLiteral)
        return {sign * Scalar{&builder_, {factor, false}}, {&builder_, {other, false}}};
  return {sign, {&builder_, {a.value.value, false}}};
}

Scalar RotationRows::ratio(Scalar a, Scalar b) const {
  const Multiple x = multiple(a), y = multiple(b);
  if (x.of.value.value == y.of.value.value) return x.number / y.number;
  if (loops::is_literal(y.of)) return x.number / y.number * x.of;
  return a / b;
}

Vector3 RotationRows::without_common_factor(const Vector3& v) const {
  std::optional<Scalar> common;
  Scalar numbers[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const Multiple entry = multiple(v[k]);
    numbers[k] = entry.number;
    if (loops::is_zero(v[k])) continue;
    if (common && common->value.value != entry.of.value.value) return v;
    common = entry.of;
  }
  return {numbers[0], numbers[1], numbers[2]};
}

std::optional<Factors> RotationRows::factored(const std::vector<RotationCoefficients>& list) const {
  std::size_t from = 0, row = 0, column = 0;
  double largest = 0;
  for (std::size_t k = 0; k < list.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (const double size = std::fabs(at_start(list[k][i][j])); size > largest) {
          largest = size;
          from = k, row = i, column = j;
        }
  if (!(largest > 0)) return std::nullopt;
  Factors factors{{}, without_common_factor(row_of(list[from], row))};
  const Scalar scale = factors.right[column];
  for (const RotationCoefficients& W : list) {
    factors.left.push_back(
        {ratio(W[0][column], scale), ratio(W[1][column], scale), ratio(W[2][column], scale)});
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (!agree(W[i][j], factors.left.back()[i] * factors.right[j], list[from][row][column], samples_))
          return std::nullopt;
  }
  return factors;
}

Scalar RotationRows::folded(Scalar value) const {
  ir::Builder copy = builder_;
  copy.output("value", -1, -1, value.value);
  const ir::Program program = passes::remove_dead_code(copy.finish("value"));
  const bool varies = std::any_of(program.nodes.begin(), program.nodes.end(),
                                  [](const ir::Node& node) { return node.op == ir::Op::kLeaf; });
  if (varies) return value;
  const auto exact = ir::interpret(program, ir::LeafValues<support::ScaledReal>());
  return {&builder_, builder_.literal(cln::cl_R(exact[0].value()))};
}

Scalar RotationRows::constant(Scalar value) const {
  const Scalar number_or_not = folded(value);
  return loops::is_literal(number_or_not) ? number_or_not : number(at_start(value));
}

Factors RotationRows::scaled(Factors factors, Scalar length) const {
  ir::Builder copy = builder_;
  for (const Vector3& v : factors.left)
    for (std::size_t k = 0; k < 3; ++k) copy.output("left", -1, -1, v[k].value);
  for (const ir::Node& node : passes::remove_dead_code(copy.finish("left")).nodes)
    if (node.op == ir::Op::kLeaf && node.leaf == ir::LeafKind::kParameter) return factors;
  const Scalar at_start = constant(length);
  if (std::fabs(this->at_start(at_start) - 1) < 4e-16) return factors;
  factors.right = at_start * factors.right;
  const Scalar inverse = number(1) / at_start;
  for (Vector3& v : factors.left) v = inverse * v;
  return factors;
}

bool RotationRows::is_orthonormal(const std::vector<Vector3>& B) const {
  const Scalar one = number(1);
  for (std::size_t i = 0; i < B.size(); ++i)
    for (std::size_t j = i; j < B.size(); ++j)
      if (const Scalar product = dot(B[i], B[j]); !agree(product, number(i == j), one, samples_))
        return false;
  return true;
}

std::vector<RotationCoefficients> RotationRows::coefficients(const std::vector<Polynomial>& rows,
                                                             const Monomial& factor) const {
  std::vector<RotationCoefficients> list;
  for (const Polynomial& row : rows) list.push_back(coefficients(row, factor));
  return list;
}

Vector3 RotationRows::column(const std::vector<Polynomial>& rows, const Monomial& m) const {
  return {coefficient(rows[0], m), coefficient(rows[1], m), coefficient(rows[2], m)};
}

}  // namespace jourdain::loops
