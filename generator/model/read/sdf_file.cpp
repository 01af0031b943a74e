#include "model/read/sdf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace jourdain::model {

using support::shown;

namespace {

/// All of it: comments may stand between its parts.
std::string text_of(const XmlElement& item) {
  std::string text;
  for (const auto* node = item.FirstChild(); node; node = node->NextSibling())
    if (const auto* part = node->ToText()) text += part->Value();
  return text;
}

}  // namespace

std::optional<std::string> SdfFile::text_in(const XmlElement& parent, const char* name) {
  const XmlElement* found = child(parent, name);
  if (!found) return {};
  const std::vector<Word> list = words(text_of(*found));
  std::string joined;
  for (const Word& word : list) joined += (joined.empty() ? "" : " ") + word.text;
  return joined;
}

std::vector<double> SdfFile::numbers(const XmlElement& item) {
  std::vector<double> list;
  for (const Word& word : words(text_of(item))) list.push_back(parsed(element(item), word.text));
  return list;
}

double SdfFile::number_in(const XmlElement& parent, const char* name, double otherwise) {
  const XmlElement* found = child(parent, name);
  if (!found) return otherwise;
  const std::vector<double> list = numbers(*found);
  if (list.size() == 1) return list[0];
  complete().numbers = false;
  error(element(*found), fmt::format("<{}> needs 1 number, found {}", name, list.size()));
  return otherwise;
}

bool SdfFile::flag_in(const XmlElement& parent, const char* name, bool otherwise) {
  const std::optional<std::string> text = text_in(parent, name);
  if (!text) return otherwise;
  return truth(element(*child(parent, name)), fmt::format("<{}>", name), *text, otherwise);
}

bool SdfFile::truth_of(const XmlElement& item, const char* attribute, bool otherwise) {
  const char* text = item.Attribute(attribute);
  return text ? truth(value(item, attribute), fmt::format("'{}'", attribute), text, otherwise) : otherwise;
}

bool SdfFile::truth(SourceRange where, const std::string& what, const std::string& text, bool otherwise) {
  if (text == "1" || text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "0" || text == "false" || text == "False" || text == "FALSE") return false;
  error(where, fmt::format("{} is true or false, not '{}'", what, shown(text)));
  return otherwise;
}

std::array<double, 3> SdfFile::triple_of(const XmlElement& item, const std::array<double, 3>& otherwise) {
  const std::vector<double> list = numbers(item);
  if (list.size() == 3) return {list[0], list[1], list[2]};
  complete().numbers = false;
  error(element(item), fmt::format("<{}> needs 3 numbers, found {}", item.Name(), list.size()));
  return otherwise;
}

std::optional<double> SdfFile::limit_in(const XmlElement& parent, const char* name) {
  constexpr double kNone = 1e15;
  const std::optional<std::string> text = text_in(parent, name);
  if (!text) return {};
  const std::size_t digits = text->find_first_not_of("+-");
  if (digits != std::string::npos && (text->substr(digits) == "inf" || text->substr(digits) == "Inf"))
    return {};
  const double value = number_in(parent, name, 0);
  return std::abs(value) < kNone ? std::optional(value) : std::nullopt;
}

double SdfFile::snapped(double angle, SourceRange where) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const double near = std::round(angle / kQuarter) * kQuarter;
  if (snap_ == 0 || angle == near || !(std::abs(angle - near) <= snap_)) return angle;
  if (std::abs(angle - near) > kAngleRounding * std::max(1.0, std::abs(near)) && snapped_++ == 0)
    first_snapped_ = where;
  return near;
}

namespace {

/// Quarter turns are permutations, without the rounding of sines.
Matrix3 exact_quarters(Matrix3 R) {
  constexpr double kRounding = 1e-15;
  for (Numbers3& row : R)
    for (double& entry : row) {
      const double near = std::round(entry);
      if (std::abs(entry - near) <= kRounding) entry = near;
    }
  return R;
}

}  // namespace

SdfPose SdfFile::pose_in(const XmlElement& parent, SourceRange& where) {
  const XmlElement* found = child(parent, "pose");
  if (!found) return {};
  where = element(*found);
  const std::vector<double> list = numbers(*found);
  check_attributes(*found, {version >= 7 ? "relative_to" : "frame", "rotation_format", "degrees"});
  const char* format = found->Attribute("rotation_format");
  if (format && std::string_view(format) != "quat_xyzw" && std::string_view(format) != "euler_rpy")
    error(value(*found, "rotation_format"),
          fmt::format("'rotation_format' is euler_rpy or quat_xyzw, not '{}'", shown(format)));
  const bool is_quaternion = format && std::string_view(format) == "quat_xyzw";
  if (list.empty()) return {};
  if (list.size() != (is_quaternion ? 7U : 6U)) {
    complete().numbers = false;
    error(where, fmt::format("<pose> needs {} numbers, found {}", is_quaternion ? 7 : 6, list.size()));
    return {};
  }
  SdfPose pose;
  pose.position = {list[0], list[1], list[2]};
  if (is_quaternion) {
    if (std::hypot(std::hypot(list[3], list[4]), std::hypot(list[5], list[6])) > 0)
      pose.rotation = rotation_from_quaternion({list[6], list[3], list[4], list[5]}).value_or(kIdentity3);
    else
      error(where, "the quaternion of <pose> is zero");
  } else {
    const bool degrees = truth_of(*found, "degrees", false);
    const double unit = degrees ? std::numbers::pi / 180 : 1;
    pose.rotation = rotation_from_rpy(
        {snapped(unit * list[3], where), snapped(unit * list[4], where), snapped(unit * list[5], where)});
  }
  if (snap_ > 0) pose.rotation = exact_quarters(pose.rotation);
  return pose;
}

std::string SdfFile::pose_base(const XmlElement& parent) {
  const XmlElement* found = parent.FirstChildElement("pose");
  const char* base = found ? found->Attribute(version >= 7 ? "relative_to" : "frame") : nullptr;
  return base ? base : "";
}

void SdfFile::check_elements(const XmlElement& parent, std::initializer_list<const char*> known) {
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto* item = parent.FirstChildElement(); item; item = item->NextSiblingElement()) {
    const std::string name = item->Name();
    if (name.find(':') != std::string::npos || std::find(names.begin(), names.end(), name) != names.end())
      continue;
    const std::string close = support::nearest(name, names);
    diagnostics().warning(element(*item), fmt::format("element <{}> is ignored", shown(name)),
                          close.empty() ? "" : fmt::format("did you mean <{}>?", close));
  }
}

void SdfFile::note_snapped() {
  if (snapped_ == 0) return;
  diagnostics().note(first_snapped_,
                     fmt::format("{} angle{} of poses within {:g} rad of a right angle read as exact",
                                 snapped_, snapped_ == 1 ? "" : "s", snap_),
                     "--no-snap takes them as they are, --snap ANGLE changes how near is near");
}

}  // namespace jourdain::model
