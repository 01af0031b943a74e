// Arithmetic modulo a prime near 2^61, where nothing is rounded.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace jourdain::ir {

/// An integer modulo p = 2^61 − c. −1 is no square there (p ≡ 3 modulo 4): 1 + t² is never 0. c has digits of π:
/// numbers that people write (powers of 2 and of 10, the largest integers) are far from multiples of p, near which they
/// would be taken for small ones.
class Residue {
 public:
  static constexpr int kBits = 61;
  /// c, the first from 314159265 that makes such a prime
  static constexpr std::uint64_t kMissing = 314159385;
  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << kBits) - kMissing;

  constexpr Residue() = default;
  constexpr explicit Residue(std::uint64_t value) : value_(value % kPrime) {}
  /// A finite double as the fraction that it is.
  static Residue of(double value);

  std::uint64_t value() const { return value_; }
  bool is_zero() const { return value_ == 0; }
  /// Of a residue and its negative, one is negative (unless both are 0).
  bool is_negative() const { return value_ > kPrime / 2; }
  Residue power(std::uint64_t exponent) const;
  /// 1 over it; of 0: 0.
  Residue inverse() const { return power(kPrime - 2); }

  friend Residue operator+(Residue a, Residue b) { return reduced(a.value_ + b.value_); }
  friend Residue operator-(Residue a, Residue b) { return reduced(a.value_ + (kPrime - b.value_)); }
  friend Residue operator-(Residue a) { return Residue() - a; }
  friend Residue operator*(Residue a, Residue b) {
    // Below 2^122, folded below 2^90, again below 2^61 + 2^58.
    const Wide product = static_cast<Wide>(a.value_) * b.value_;
    return reduced(static_cast<std::uint64_t>(fold(fold(product))));
  }
  friend bool operator==(Residue, Residue) = default;

 private:
  __extension__ using Wide = unsigned __int128;

  /// The same modulo p: 2^61 is c.
  static Wide fold(Wide value) {
    constexpr Wide kLow = (Wide{1} << kBits) - 1;
    return (value >> kBits) * kMissing + (value & kLow);
  }
  /// Of a number below 2p.
  static Residue reduced(std::uint64_t value) {
    Residue result;
    result.value_ = value >= kPrime ? value - kPrime : value;
    return result;
  }

  std::uint64_t value_ = 0;
};

inline Residue Residue::power(std::uint64_t exponent) const {
  Residue result(1);
  for (Residue square = *this; exponent > 0; exponent >>= 1, square = square * square)
    if (exponent & 1) result = result * square;
  return result;
}

inline Residue Residue::of(double value) {
  constexpr int kDigits = 53;  // of 2
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  const Residue digits(static_cast<std::uint64_t>(std::ldexp(fraction, kDigits)));
  exponent -= kDigits;
  const Residue size = Residue(2).power(static_cast<std::uint64_t>(std::abs(exponent)));
  const Residue result = digits * (exponent < 0 ? size.inverse() : size);
  return value < 0 ? -result : result;
}

/// 1 over each, with one division for all (Montgomery 1987, section 10.3.1); of 0: 0.
inline std::vector<Residue> inverses(std::vector<Residue> residues) {
  std::vector<Residue> before;  // product of those before each
  Residue product(1);
  for (const Residue residue : residues) {
    before.push_back(product);
    if (!residue.is_zero()) product = product * residue;
  }
  Residue rest = product.inverse();  // 1 over the product of those up to each
  for (std::size_t i = residues.size(); i-- > 0;) {
    if (residues[i].is_zero()) continue;
    const Residue inverse = rest * before[i];
    rest = rest * residues[i];
    residues[i] = inverse;
  }
  return residues;
}

}  // namespace jourdain::ir
