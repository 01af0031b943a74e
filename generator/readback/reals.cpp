#include "readback/reals.hpp"

#include <cln/integer.h>
#include <cln/rational.h>

#include <cmath>
#include <utility>

#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

const cln::float_format_t kDigits = cln::float_format(70);

}  // namespace

Exact exact(double value) {
  if (value == 0) return cln::cl_float(0, kDigits);
  return cln::cl_float(cln::rational(cln::cl_DF(value)), kDigits);
}

Exact exact(const Fraction& value) {
  return cln::cl_float(cln::cl_RA(cln::cl_I(value.numerator)) / cln::cl_I(value.denominator), kDigits);
}

double rough(const Exact& value) { return cln::double_approx(value); }

Number Reals::add(const Exact& value, bool is_literal) {
  values_.push_back(value);
  is_literal_.push_back(is_literal);
  largest_ = std::max(largest_, std::fabs(rough(value)));
  return static_cast<Number>(values_.size() - 1);
}

Number Reals::literal(double value) {
  if (!std::isfinite(value)) throw Refusal("a literal that is not finite");
  return add(exact(value), true);
}

Number Reals::number(const Exact& value) { return add(value, false); }

Number Reals::apply(ir::Op op, Number left, Number right) {
  const Exact a = values_[left], b = values_[right];
  const bool literal =
      ir::operand_count(op) == 1 ? is_literal_[left] : is_literal_[left] && is_literal_[right];
  switch (op) {
    case ir::Op::kNegate:
      return add(-a, literal);
    case ir::Op::kAdd:
      return add(a + b, literal);
    case ir::Op::kSubtract:
      return add(a - b, literal);
    case ir::Op::kMultiply:
      return add(a * b, literal);
    case ir::Op::kDivide:
      if (cln::zerop(b)) throw Refusal("a division by zero");
      return add(a / b, literal);
    case ir::Op::kSqrt:
      if (cln::minusp(a)) throw Refusal("the root of a negative number");
      return add(cln::cl_float(cln::sqrt(a), kDigits), false);
    default:
      throw Refusal("an angle in a step");
  }
}

std::uint64_t Random::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;  // splitmix64
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

Exact Random::number() {
  cln::cl_I all = 0;
  constexpr int kWords = 8;
  for (int i = 0; i < kWords; ++i)
    all = all * cln::expt_pos(cln::cl_I(2), 31) + cln::cl_I(static_cast<unsigned>(bits() >> 33));
  const cln::cl_I scale = cln::expt_pos(cln::cl_I(2), 31 * kWords - 1);
  return cln::cl_float(cln::cl_RA(all) / scale - 1, kDigits);
}

ExactVector Random::vector(std::size_t count) {
  ExactVector list;
  for (std::size_t i = 0; i < count; ++i) list.push_back(number());
  return list;
}

ExactMatrix zero_matrix(std::size_t rows, std::size_t columns) {
  return ExactMatrix(rows, ExactVector(columns, exact(0.0)));
}

ExactMatrix identity(std::size_t size) {
  ExactMatrix matrix = zero_matrix(size, size);
  for (std::size_t i = 0; i < size; ++i) matrix[i][i] = exact(1.0);
  return matrix;
}

ExactMatrix operator*(const ExactMatrix& a, const ExactMatrix& b) {
  ExactMatrix product = zero_matrix(a.size(), b.empty() ? 0 : b[0].size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      for (std::size_t j = 0; j < b[k].size(); ++j) product[i][j] = product[i][j] + a[i][k] * b[k][j];
  return product;
}

ExactVector operator*(const ExactMatrix& a, const ExactVector& x) {
  ExactVector product(a.size(), exact(0.0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < x.size(); ++k) product[i] = product[i] + a[i][k] * x[k];
  return product;
}

DenseSolver::DenseSolver(ExactMatrix A) : factors_(std::move(A)) {
  const std::size_t n = factors_.size();
  for (std::size_t i = 0; i < n; ++i) order_.push_back(i);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(rough(factors_[i][k])) > std::fabs(rough(factors_[best][k]))) best = i;
    std::swap(factors_[k], factors_[best]);
    std::swap(order_[k], order_[best]);
    if (cln::zerop(factors_[k][k])) throw Refusal("a singular matrix of a random point");
    for (std::size_t i = k + 1; i < n; ++i) {
      if (cln::zerop(factors_[i][k])) continue;
      const Exact factor = factors_[i][k] = factors_[i][k] / factors_[k][k];
      for (std::size_t j = k + 1; j < n; ++j)
        if (!cln::zerop(factors_[k][j])) factors_[i][j] = factors_[i][j] - factor * factors_[k][j];
    }
  }
}

ExactVector DenseSolver::solve(ExactVector b) const {
  const std::size_t n = factors_.size();
  ExactVector x;
  for (std::size_t i = 0; i < n; ++i) {
    x.push_back(b[order_[i]]);
    for (std::size_t j = 0; j < i; ++j) x[i] = x[i] - factors_[i][j] * x[j];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] = x[i] - factors_[i][j] * x[j];
    x[i] = x[i] / factors_[i][i];
  }
  return x;
}

}  // namespace jourdain::readback
