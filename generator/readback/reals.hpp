// Numbers of 70 digits as a domain, and the dense algebra that definitions of methods need.
#pragma once

#include <cln/float.h>
#include <cln/real.h>

#include <cstdint>
#include <string>
#include <vector>

#include "readback/domain.hpp"
#include "readback/methods.hpp"

namespace jourdain::readback {

using Exact = cln::cl_F;
using ExactVector = std::vector<Exact>;
using ExactMatrix = std::vector<ExactVector>;

Exact exact(double value);
Exact exact(const Fraction& value);
double rough(const Exact& value);

class Reals : public Domain {
 public:
  Number literal(double value) override;
  Number number(const Exact& value);
  const Exact& operator[](Number number) const { return values_[number]; }
  /// Largest absolute value so far.
  double largest() const { return largest_; }

 protected:
  Number apply(ir::Op op, Number a, Number b) override;
  bool is_literal(Number a) const override { return is_literal_[a]; }

 private:
  Number add(const Exact& value, bool is_literal);

  std::vector<Exact> values_;
  std::vector<bool> is_literal_;
  double largest_ = 1;
};

/// Seeded numbers from −1 to 1 with all their digits random.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  Exact number();
  ExactVector vector(std::size_t count);

 private:
  std::uint64_t bits();
  std::uint64_t state_;
};

ExactMatrix zero_matrix(std::size_t rows, std::size_t columns);
ExactMatrix identity(std::size_t size);
ExactMatrix operator*(const ExactMatrix& a, const ExactMatrix& b);
ExactVector operator*(const ExactMatrix& a, const ExactVector& x);

/// Solves A x = b by Gaussian elimination with row exchanges.
class DenseSolver {
 public:
  explicit DenseSolver(ExactMatrix A);
  ExactVector solve(ExactVector b) const;

 private:
  ExactMatrix factors_;
  std::vector<std::size_t> order_;
};

}  // namespace jourdain::readback
