// Dimensions of what an expression's text holds: the first that do not agree.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "model/expression_functions.hpp"
#include "model/expression_text.hpp"

namespace jourdain::model {

class ExpressionDimensions : protected ExpressionText {
 public:
  using ExpressionText::ExpressionText;

  /// The first dimensions that do not agree.
  const std::optional<ExpressionError>& mismatch() const { return mismatch_; }

 protected:
  /// Of what begins at `begin` and was read last.
  void note_mismatch(std::size_t begin, std::string message) {
    if (!mismatch_)
      mismatch_ = {begin, std::max<std::size_t>(1, written(begin, position_).size()), std::move(message), ""};
  }

  /// Of arguments of one dimension, written from `begin` on.
  Measure in_common(const Measure& a, const Measure& b, std::size_t begin, std::string_view function) {
    const std::optional<Measure> measure = a.plus(b);
    if (!measure)
      note_mismatch(begin, fmt::format("{} needs arguments of one unit, but '{}' are in {} and {}", function,
                                       support::shown(written(begin, position_)), a.unit(), b.unit()));
    return measure.value_or(Measure::open());
  }

  void check_argument(const NamedFunction& function, const Measure& argument, std::size_t begin) {
    if (function.dimensions == NamedFunction::Dimensions::kAngle && !argument.fits(needed::kAngle))
      note_mismatch(begin, fmt::format("{} needs rad, but '{}' is in {}", function.name,
                                       support::shown(written(begin, position_)), argument.unit()));
    if (function.dimensions == NamedFunction::Dimensions::kPure)
      check_pure(function.name, argument, begin, position_);
  }

  void check_pure(std::string_view what, const Measure& measure, std::size_t begin, std::size_t end) {
    if (!measure.fits(needed::kPure))
      note_mismatch(begin, fmt::format("{} needs a pure number, but '{}' is in {}", what,
                                       support::shown(written(begin, end)), measure.unit()));
  }

 private:
  std::optional<ExpressionError> mismatch_;
};

}  // namespace jourdain::model
