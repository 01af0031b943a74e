#include "commands/number_checks.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

namespace jourdain::commands {

namespace {

std::optional<double> finite_number(const std::string& text) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && std::isfinite(value)) return value;
  return {};
}

/// As CLI11 converts it, which takes prefixes of a base too.
bool is_seed(const std::string& text) {
  if (text.empty() || !std::isdigit(static_cast<unsigned char>(text.front()))) return false;
  char* end = nullptr;
  errno = 0;
  std::strtoull(text.c_str(), &end, 0);
  return errno == 0 && end == text.c_str() + text.size();
}

}  // namespace

CLI::Validator positive_number() {
  const auto check = [](std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value > 0 ? std::string() : fmt::format("must be positive and finite, not {}", text);
  };
  return CLI::Validator(check, "POSITIVE");
}

CLI::Validator number_between(double low, double high) {
  const auto check = [low, high](std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && low <= *value && *value <= high
               ? std::string()
               : fmt::format("must be a number from {:g} to {:g}, not {}", low, high, text);
  };
  return CLI::Validator(check, fmt::format("FLOAT in [{:g} - {:g}]", low, high));
}

CLI::Validator seed_number() {
  const auto check = [](std::string& text) {
    return is_seed(text) ? std::string()
                         : fmt::format("must be a whole number from 0 to {}, not {}",
                                       std::numeric_limits<unsigned long long>::max(), text);
  };
  return CLI::Validator(check, "");
}

}  // namespace jourdain::commands
