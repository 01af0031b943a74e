#include "commands/number_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
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

/// "20us", "1ms", "0.5 s": a time in s.
std::string read_time(std::string& text) {
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
  const double scale = unit == "s" || unit.empty() ? 1
                       : unit == "ms"              ? 1e-3
                       : unit == "us"              ? 1e-6
                       : unit == "ns"              ? 1e-9
                                                   : 0;
  if (error != std::errc() || scale == 0 || !(value > 0) || !std::isfinite(value))
    return fmt::format("'{}' is no time; write 20us, 1ms or 0.5s", text);
  text = fmt::format("{}", value * scale);
  return "";
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

CLI::Validator time_with_unit() { return CLI::Validator(read_time, "TIME", "time"); }

}  // namespace jourdain::commands
