#include "model/dimensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <variant>

namespace jourdain::model {

namespace {

constexpr int kScale = 64;
constexpr int kLargest = 1000 * kScale;
constexpr std::array<std::string_view, 9> kFractions{"1",   "0.5", "0.25", "0.75", "1.5",
                                                     "1.0", ".5",  ".25",  ".75"};
constexpr std::array<std::string_view, 7> kMultiples{"2", "3", "4", "5", "6", "8", "12"};

template <std::size_t Count>
bool contains(const std::array<std::string_view, Count>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::optional<Dimension> dimension_of(std::string_view unit) {
  const auto parsed = parse_unit(unit);
  const auto* known = std::get_if<Unit>(&parsed);
  return known ? std::optional(known->dimension) : std::nullopt;
}

/// "m^2", "kg^(1/2)"; the exponent in 64ths, positive.
std::string raised(std::string_view symbol, int exponent) {
  const int common = std::gcd(exponent, kScale);
  const int above = exponent / common, below = kScale / common;
  if (below != 1) return fmt::format("{}^({}/{})", symbol, above, below);
  return above == 1 ? std::string(symbol) : fmt::format("{}^{}", symbol, above);
}

/// "kg m/s^2"
std::string in_base_units(const std::array<int, 4>& exponents) {
  constexpr std::pair<std::size_t, std::string_view> kOrder[] = {{1, "kg"}, {0, "m"}, {2, "s"}, {3, "A"}};
  std::string above, below;
  int divisors = 0;
  for (const auto& [i, symbol] : kOrder) {
    if (exponents[i] == 0) continue;
    std::string& part = exponents[i] > 0 ? above : below;
    part += (part.empty() ? "" : " ") + raised(symbol, std::abs(exponents[i]));
    divisors += exponents[i] < 0;
  }
  if (above.empty()) above = "1";
  if (divisors == 0) return above;
  return divisors == 1 ? above + "/" + below : fmt::format("{}/({})", above, below);
}

}  // namespace

std::string in_words(const Needed& needed) {
  std::string words;
  for (const std::string_view unit : needed.units)
    if (!unit.empty()) words += (words.empty() ? "" : " or ") + std::string(unit);
  return words;
}

Measure Measure::open() {
  Measure measure;
  measure.open_ = true;
  return measure;
}

Measure Measure::count() {
  Measure measure;
  measure.divisors_ = true;
  return measure;
}

Measure Measure::degree() {
  Measure measure = count();
  measure.degrees_ = true;
  return measure;
}

Measure Measure::literal(std::string_view written) {
  Measure measure;
  measure.divisors_ = contains(kFractions, written);
  measure.multiples_ = contains(kMultiples, written);
  measure.open_ = !measure.has_counts();
  return measure;
}

Measure Measure::of(const Dimension& dimension) {
  Measure measure;
  for (std::size_t i = 0; i < dimension.size(); ++i) measure.exponents_[i] = dimension[i] * kScale;
  return measure;
}

Measure Measure::parameter(std::string_view unit) {
  const std::optional<Dimension> dimension = unit.empty() ? std::nullopt : dimension_of(unit);
  if (!dimension) return open();
  Measure measure = of(*dimension);
  measure.anchored_ = true;
  return measure;
}

Measure Measure::variable(const Needed& unit) {
  const std::optional<Dimension> dimension =
      unit.units[0].empty() ? std::nullopt : dimension_of(unit.units[0]);
  if (!dimension) return open();
  Measure measure = of(*dimension);
  measure.moving_ = true;
  return measure;
}

Measure Measure::time() {
  Measure measure = of({0, 0, 1, 0});
  measure.moving_ = measure.timed_ = true;
  return measure;
}

Measure Measure::ratio_of(const Measure& argument) {
  Measure measure;
  measure.moving_ = argument.moving_;
  measure.timed_ = argument.timed_;
  return measure;
}

bool Measure::is_known() const {
  if (open_ || (timed_ && !anchored_)) return false;
  return !has_counts() || (anchored_ && !is_pure() && !timed_ && !(moving_ && multiples_));
}

bool Measure::fits(const Dimension& dimension) const {
  return !is_known() || exponents_ == of(dimension).exponents_;
}

bool Measure::fits(const Needed& needed) const {
  if (needed.units[0].empty()) return true;
  return std::any_of(needed.units.begin(), needed.units.end(), [this](std::string_view unit) {
    const std::optional<Dimension> dimension = unit.empty() ? std::nullopt : dimension_of(unit);
    return dimension && fits(*dimension);
  });
}

std::string Measure::unit() const {
  constexpr std::pair<Exponents, std::string_view> kNames[] = {
      {{0, 0, 0, 0}, "rad or 1"}, {{1, 1, -2, 0}, "N"},     {{2, 1, -2, 0}, "N m"}, {{0, 1, -2, 0}, "N/m"},
      {{0, 1, -1, 0}, "N s/m"},   {{2, 1, -1, 0}, "N m s"}, {{2, 1, -3, 0}, "W"}};
  for (const auto& [exponents, name] : kNames)
    if (exponents_ == of(exponents).exponents_) return std::string(name);
  return in_base_units(exponents_);
}

void Measure::take_flags(const Measure& other) {
  open_ = open_ || other.open_;
  anchored_ = anchored_ || other.anchored_;
  moving_ = moving_ || other.moving_;
  timed_ = timed_ || other.timed_;
  divisors_ = divisors_ || other.divisors_;
  multiples_ = multiples_ || other.multiples_;
  degrees_ = degrees_ || other.degrees_;
}

Measure Measure::times(const Measure& other) const {
  Measure result = *this;
  result.take_flags(other);
  for (std::size_t i = 0; i < exponents_.size(); ++i) result.exponents_[i] += other.exponents_[i];
  return result.scaled(1, 1);
}

Measure Measure::over(const Measure& other) const {
  Measure inverse = other.power(-1);
  inverse.divisors_ = other.has_counts();
  inverse.multiples_ = false;
  return times(inverse);
}

Measure Measure::power(int exponent) const { return scaled(exponent, 1); }

Measure Measure::power(double exponent) const {
  const double scaled_exponent = exponent * kScale;
  if (scaled_exponent != std::floor(scaled_exponent) || std::fabs(scaled_exponent) > kLargest)
    return is_pure() ? *this : open();
  return scaled(static_cast<int>(scaled_exponent), kScale);
}

Measure Measure::square_root() const { return scaled(1, 2); }

/// Open where the exponents are no whole 64ths any more, or absurdly large.
Measure Measure::scaled(int factor, int divisor) const {
  Measure result = *this;
  for (int& exponent : result.exponents_) {
    if (exponent % divisor != 0 || std::abs(exponent) > kLargest / std::max(1, std::abs(factor)))
      return open();
    exponent = exponent * factor / divisor;
  }
  return result;
}

std::optional<Measure> Measure::plus(const Measure& other) const {
  const bool here = is_known(), there = other.is_known();
  const bool differ = exponents_ != other.exponents_;
  if (here && there && differ) return {};
  if (!here && !there && differ) return open();
  Measure result = here || !there ? *this : other;
  if (here != there) {
    result.degrees_ = degrees_ || other.degrees_;
    return result;
  }
  result.take_flags(other);
  // What one side has without counts, or known without t, holds for the sum.
  if (!(has_counts() && other.has_counts())) result.divisors_ = result.multiples_ = false;
  if (here) result.timed_ = timed_ && other.timed_;
  return result;
}

}  // namespace jourdain::model
