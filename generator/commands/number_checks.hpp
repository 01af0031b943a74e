// Numbers of options, checked as they are read. CLI11's own checks let pass what is no number, its conversions clamp.
#pragma once

#include <CLI/Error.hpp>
#include <CLI/Validators.hpp>

namespace jourdain::commands {

/// More than zero, and finite.
CLI::Validator positive_number();

/// From `low` to `high`; nan is not.
CLI::Validator number_between(double low, double high);

/// From 0 to 2^64 - 1, without a sign.
CLI::Validator seed_number();

/// "20us", "1ms", "0.5 s": becomes that time in s.
CLI::Validator time_with_unit();

}  // namespace jourdain::commands
