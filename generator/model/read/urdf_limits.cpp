#include "model/read/urdf_limits.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace jourdain::model {

namespace {

using tinyxml2::XMLElement;

/// Infinite where it is too large for a double.
std::optional<double> number(const char* attribute) {
  constexpr std::string_view kSpaces = " \t\r\n";
  std::string_view text = attribute ? attribute : "";
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  text.remove_suffix(text.size() - (text.find_last_not_of(kSpaces) + 1));
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || stop != text.data() + text.size()) return {};
  return error == std::errc() ? value : std::numeric_limits<double>::infinity();
}

std::optional<double> finite_number(const char* attribute) {
  const std::optional<double> value = number(attribute);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

Limits limits_of(const XMLElement& limit, bool continuous) {
  Limits limits{{}, {}, finite_number(limit.Attribute("velocity")), finite_number(limit.Attribute("effort"))};
  const char *lower = limit.Attribute("lower"), *upper = limit.Attribute("upper");
  if (continuous || (!lower && !upper)) return limits;
  limits.lower = lower ? finite_number(lower) : 0.0;
  limits.upper = upper ? finite_number(upper) : 0.0;
  return limits;
}

std::vector<const char*> limits_without_number(const XMLElement& limit) {
  std::vector<const char*> names;
  for (const char* name : {"lower", "upper", "velocity", "effort"})
    if (const char* text = limit.Attribute(name); text && !number(text)) names.push_back(name);
  return names;
}

std::map<std::string, Limits> read_urdf_limits(const std::string& text) {
  std::map<std::string, Limits> all;
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  const XMLElement* robot = document.Error() ? nullptr : document.RootElement();
  if (!robot) return all;
  for (const auto* e = robot->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
    const XMLElement* limit = e->FirstChildElement("limit");
    const char *name = e->Attribute("name"), *type = e->Attribute("type");
    if (!limit || !name || !type) continue;
    const Limits limits = limits_of(*limit, std::string_view(type) == "continuous");
    if (limits.any()) all.emplace(name, limits);
  }
  return all;
}

}  // namespace jourdain::model
