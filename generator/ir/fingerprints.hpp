// Which values of a program are equal, whatever its leaves are: their exact values at random points of a prime field.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "ir/prime_field.hpp"
#include "ir/program.hpp"

namespace jourdain::ir {

/// A value at random points. Leaves are independent random residues, literals the numbers that they stand for. The
/// sine and cosine of an angle are 2t/(1 + t²) and (1 − t²)/(1 + t²) with a random t, opposite angles having opposite
/// t; roots and other functions are random, the same for equal arguments. So nothing is known of functions but
/// sin² + cos² = 1, sin(−x) = −sin x and cos(−x) = cos x, and nothing is assumed of leaves: quaternions have any
/// length, loops are open.
///
/// Values that are equal as functions of all leaves have equal fingerprints. Others, quotients of polynomials of degree
/// d, have equal ones with a probability below (2d/p)^4 over the points (Schwartz and Zippel), and seem to be related
/// by two constants with one below (4d/p)^2: with d = 10^6 and all pairs of 10^5 values below 10^−13. That is so unless
/// they differ by what is 0 modulo p at all points, as two literals do that are p apart. The prime and the points are
/// the same in every run.
struct Fingerprint {
  static constexpr std::size_t kPoints = 4;
  std::array<Residue, kPoints> at;

  bool is_zero() const { return *this == Fingerprint(); }
  bool is_negative() const { return at[0].is_negative(); }
  Fingerprint operator-() const { return {{-at[0], -at[1], -at[2], -at[3]}}; }
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

Fingerprint operator+(const Fingerprint& a, const Fingerprint& b);
Fingerprint operator-(const Fingerprint& a, const Fingerprint& b);
Fingerprint operator*(const Fingerprint& a, const Fingerprint& b);

/// What stands for a leaf; nothing: what it has by itself.
using LeafFingerprint = std::function<std::optional<Fingerprint>(LeafKind, std::size_t index)>;

/// Of all values; none where the program divides by what is always 0 or holds a literal that is not finite.
std::optional<std::vector<Fingerprint>> fingerprints(const Program& program,
                                                     const LeafFingerprint& leaf = {});

}  // namespace jourdain::ir
