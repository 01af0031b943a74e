// The field that programs are evaluated in: doubles are the fractions that they are.
#include "ir/prime_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace jourdain::ir {
namespace {

TEST(PrimeField, AddsAndMultipliesDoublesAsTheFractionsThatTheyAre) {
  EXPECT_EQ(Residue::of(0.75) * Residue(4), Residue(3));
  EXPECT_EQ(Residue::of(-2.5) + Residue::of(4.75), Residue::of(2.25));
  EXPECT_EQ(Residue::of(0.1) * Residue(std::uint64_t{1} << 55), Residue(3602879701896397));
  EXPECT_NE(Residue::of(0.1) + Residue::of(0.2), Residue::of(0.3));
  EXPECT_EQ(Residue::of(0), Residue());
}

TEST(PrimeField, TakesTheSmallestAndTheLargestDoubles) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(Residue::of(least) * Residue::of(std::ldexp(1.0, 537)) * Residue::of(std::ldexp(1.0, 537)),
            Residue(1));
  EXPECT_EQ(Residue::of(most / 2) + Residue::of(most / 2), Residue::of(most));
}

TEST(PrimeField, DividesByAllButZero) {
  for (std::uint64_t k = 1; k < 1000; ++k) {
    const Residue x(k * 0x9e3779b97f4a7c15u);
    EXPECT_EQ(x * x.inverse(), Residue(1));
    EXPECT_TRUE((x + -x).is_zero());
    EXPECT_NE(x.is_negative(), (-x).is_negative());
  }
  EXPECT_EQ(Residue().inverse(), Residue());
}

/// An independent way to the same: by 128-bit division.
TEST(PrimeField, MultipliesAsDivisionSays) {
  __extension__ using Wide = unsigned __int128;
  constexpr std::uint64_t p = Residue::kPrime;
  for (std::uint64_t k = 0; k < 1000; ++k)
    for (const std::uint64_t b : {p - 1, p - 2, p / 2, k, k * 0x9e3779b97f4a7c15u % p}) {
      const std::uint64_t a = k < 500 ? p - 1 - k : k * 0xd1342543de82ef95u % p;
      EXPECT_EQ((Residue(a) * Residue(b)).value(), static_cast<std::uint64_t>(static_cast<Wide>(a) * b % p));
    }
  for (std::uint64_t d = 2; d < 100000; ++d) ASSERT_NE(p % d, 0U);
  EXPECT_EQ(Residue(3).power(p - 1), Residue(1));
  EXPECT_EQ(p % 4, 3U);
}

TEST(PrimeField, TellsNumbersThatPeopleWriteFromEachOther) {
  std::vector<Residue> numbers;
  for (int exponent = 0; exponent < 1000; ++exponent)  // 3 · 2^k = 2^k + 2^(k+1)
    for (const double factor : {1.0, 5.0, 7.0}) numbers.push_back(Residue::of(std::ldexp(factor, exponent)));
  double power = 10;
  for (int exponent = 2; exponent < 200; ++exponent) numbers.push_back(Residue::of(power *= 10));
  for (int exponent = 25; exponent < 200; ++exponent)
    for (const int other : {1, 2, 3}) {
      numbers.push_back(Residue::of(std::ldexp(1, exponent)) + Residue(static_cast<std::uint64_t>(other)));
      numbers.push_back(Residue::of(std::ldexp(1, exponent)) - Residue(static_cast<std::uint64_t>(other)));
    }
  for (std::uint64_t k = 11; k < 1000; k += 2) numbers.push_back(Residue(k));
  for (const Residue number : std::vector(numbers)) numbers.push_back(-number);
  const auto is_less = [](Residue a, Residue b) { return a.value() < b.value(); };
  std::sort(numbers.begin(), numbers.end(), is_less);
  std::vector<std::uint64_t> twice;
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i] == numbers[i - 1]) twice.push_back(numbers[i].value());
  EXPECT_EQ(twice, std::vector<std::uint64_t>());
}

TEST(PrimeField, InvertsManyAsEach) {
  const std::vector<Residue> residues = {Residue(3), Residue(), Residue(Residue::kPrime - 1), Residue(7),
                                         Residue()};
  const std::vector<Residue> found = inverses(residues);
  ASSERT_EQ(found.size(), residues.size());
  for (std::size_t i = 0; i < residues.size(); ++i) EXPECT_EQ(found[i], residues[i].inverse()) << i;
  EXPECT_TRUE(inverses({}).empty());
}

}  // namespace
}  // namespace jourdain::ir
