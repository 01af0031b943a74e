#include "model/read/mjcf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>
#include <set>
#include <sstream>

namespace jourdain::model {

using support::shown;

namespace {

constexpr const char* kMain = "main";
constexpr const char* kActuator = "actuator";
constexpr std::size_t kMostOutermost = 100;

/// But quat, which gives way to each of these where one is in force.
const std::vector<std::string>& other_orientations() {
  static const std::vector<std::string> names{"axisangle", "euler", "xyaxes", "zaxis"};
  return names;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::string close = support::nearest(name, known);
  if (!close.empty()) return fmt::format("did you mean '{}'?", close);
  return fmt::format("known are {}", fmt::join(known, ", "));
}

}  // namespace

const std::vector<std::string>& actuator_names() {
  static const std::vector<std::string> names{"general",     "motor",   "position", "velocity",
                                              "intvelocity", "damper",  "cylinder", "muscle",
                                              "adhesion",    "dcmotor", "plugin"};
  return names;
}

bool is_actuator_name(const std::string& name) {
  const std::vector<std::string>& names = actuator_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

MjcfFile::MjcfFile(UrdfFile& xml, const XmlElement& root) : xml_(xml), root_(root) {
  classes_[kMain];
  for (const auto* e = root.FirstChildElement("default"); e; e = e->NextSiblingElement("default"))
    read_class(*e, "");
  read_compiler();
}

void MjcfFile::error(SourceRange where, std::string message, std::string hint) {
  xml_.diagnostics().error(where, std::move(message), std::move(hint));
}

void MjcfFile::warning(SourceRange where, std::string message, std::string hint) {
  xml_.diagnostics().warning(where, std::move(message), std::move(hint));
}

void MjcfFile::read_class(const XmlElement& block, const std::string& outer) {
  const char* const given = block.Attribute("class");
  if (!given && !outer.empty())
    return error(xml_.element(block), "a <default> within another needs the attribute 'class'");
  std::string name = given ? given : kMain;
  if (outer.empty() && name != kMain) {
    // The outermost class may have a name of its own; elements without a class take it by any name.
    classes_[name].outer = kMain;
    name = kMain;
  }
  Class& entry = classes_[name];
  if (!outer.empty() && entry.where.line != 0)
    return error(xml_.value(block, "class"), fmt::format("there are two classes '{}'", shown(name)),
                 fmt::format("first declared at line {}", entry.where.line));
  if (outer.empty() && ++outermost_blocks_ > kMostOutermost)
    return error(xml_.element(block),
                 fmt::format("<default> stands there more than {} times", kMostOutermost));
  entry.where = xml_.element(block);
  entry.outer = outer;
  std::set<std::string> own;
  for (const auto* e = block.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string tag = e->Name();
    if (tag == "default")
      read_class(*e, name);
    else if (own.insert(tag).second)
      entry.elements[is_actuator_name(tag) ? kActuator : tag].push_back(e);
    else
      error(xml_.element(*e), fmt::format("<default> has two <{}>", shown(tag)));
  }
}

void MjcfFile::read_compiler() {
  angle_unit_ = std::numbers::pi / 180;
  if (const XmlElement* e = compiler("angle"))
    if (choice(*e, "angle", {"degree", "radian"}, "degree") == "radian") angle_unit_ = 1;
  if (const XmlElement* e = compiler("eulerseq")) {
    const std::string sequence = e->Attribute("eulerseq");
    if (sequence.size() == 3 && sequence.find_first_not_of("xyzXYZ") == std::string::npos) {
      euler_sequence_ = sequence;
    } else {
      xml_.complete().numbers = false;
      error(xml_.value(*e, "eulerseq"), fmt::format("'{}' is no sequence of three axes", shown(sequence)),
            "such as xyz, axes of the turning frame, or XYZ, of the fixed one");
    }
  }
}

const XmlElement* MjcfFile::section(const char* name, const char* attribute) const {
  for (const auto* e = root_.LastChildElement(name); e; e = e->PreviousSiblingElement(name))
    if (e->Attribute(attribute)) return e;
  return nullptr;
}

void MjcfFile::check_class(const XmlElement& element, const char* attribute) {
  const char* const name = element.Attribute(attribute);
  if (!name || classes_.contains(name)) return;
  std::vector<std::string> known;
  for (const auto& entry : classes_) known.push_back(entry.first);
  const std::string close = support::nearest(name, known);
  error(xml_.value(element, attribute), fmt::format("there is no default class '{}'", shown(name)),
        close.empty() ? "" : fmt::format("did you mean '{}'?", close));
}

std::string MjcfFile::class_of(const XmlElement& element) const {
  if (const char* own = element.Attribute("class")) return own;
  for (const auto* node = element.Parent(); node; node = node->Parent()) {
    const XmlElement* around = node->ToElement();
    const char* name = around ? around->Attribute("childclass") : nullptr;
    if (name) return name;
  }
  return kMain;
}

std::vector<const XmlElement*> MjcfFile::levels(const XmlElement& element) const {
  std::vector<const XmlElement*> found{&element};
  // Of one name in defaults, whatever they are.
  const std::string section = element.Parent()->Value();
  const std::string tag = section == kActuator || section == "equality" ? section : element.Name();
  for (auto place = classes_.find(class_of(element)); place != classes_.end();
       place = place->second.outer.empty() ? classes_.end() : classes_.find(place->second.outer)) {
    const auto of_tag = place->second.elements.find(tag);
    if (of_tag != place->second.elements.end())
      found.insert(found.end(), of_tag->second.rbegin(), of_tag->second.rend());
  }
  return found;
}

const XmlElement* MjcfFile::holder(const XmlElement& element, const char* attribute) const {
  for (const XmlElement* level : levels(element))
    if (level->Attribute(attribute)) return level;
  return nullptr;
}

std::optional<std::string> MjcfFile::word(const XmlElement& element, const char* attribute) const {
  const XmlElement* found = holder(element, attribute);
  return found ? std::optional<std::string>(found->Attribute(attribute)) : std::nullopt;
}

std::string MjcfFile::choice(const XmlElement& element, const char* attribute,
                             const std::vector<std::string>& known, const std::string& otherwise) {
  const XmlElement* found = holder(element, attribute);
  if (!found) return otherwise;
  std::string text = found->Attribute(attribute);
  if (std::find(known.begin(), known.end(), text) != known.end()) return text;
  error(xml_.value(*found, attribute),
        fmt::format("'{}' of <{}> is '{}'", attribute, found->Name(), shown(text)), suggestion(text, known));
  xml_.complete().structure = false;
  return otherwise;
}

bool MjcfFile::truth(const XmlElement& element, const char* attribute, bool otherwise) {
  return choice(element, attribute, {"true", "false"}, otherwise ? "true" : "false") == "true";
}

double MjcfFile::number(const XmlElement& element, const char* attribute, double otherwise) {
  const XmlElement* found = holder(element, attribute);
  return found ? xml_.number(*found, attribute, otherwise) : otherwise;
}

std::optional<std::vector<double>> MjcfFile::listed(const XmlElement& element, const char* attribute,
                                                    std::size_t least, std::size_t most) {
  std::istringstream text(element.Attribute(attribute));
  std::vector<double> result;
  for (std::string word; text >> word;) {
    const char* begin = word.data() + (word.starts_with('+') && !word.starts_with("+-") ? 1 : 0);
    double value = 0;
    const auto [stop, code] = std::from_chars(begin, word.data() + word.size(), value);
    if (code != std::errc() || stop != word.data() + word.size() || !std::isfinite(value)) {
      xml_.complete().numbers = false;
      error(xml_.value(element, attribute), fmt::format("'{}' of <{}> has '{}', which is no finite number",
                                                        attribute, element.Name(), shown(word)));
      return {};
    }
    result.push_back(value);
  }
  if (result.size() >= least && result.size() <= most) return result;
  xml_.complete().numbers = false;
  error(xml_.value(element, attribute),
        fmt::format("'{}' of <{}> needs {} number{}, found {}", attribute, element.Name(),
                    least == most ? fmt::to_string(most) : fmt::format("{} to {}", least, most),
                    most == 1 ? "" : "s", result.size()));
  return {};
}

void MjcfFile::overlay(const XmlElement& level, const char* attribute, std::vector<double>& into,
                       std::size_t least) {
  if (!level.Attribute(attribute)) return;
  const auto given = listed(level, attribute, least, into.size());
  if (given) std::copy(given->begin(), given->end(), into.begin());
}

std::vector<double> MjcfFile::numbers(const XmlElement& element, const char* attribute,
                                      std::vector<double> otherwise, std::size_t least) {
  const std::vector<const XmlElement*> all = levels(element);
  for (auto level = all.rbegin(); level != all.rend(); ++level) overlay(**level, attribute, otherwise, least);
  return otherwise;
}

Numbers3 MjcfFile::triple(const XmlElement& element, const char* attribute, const Numbers3& otherwise) {
  const std::vector<double> found =
      numbers(element, attribute, {otherwise[0], otherwise[1], otherwise[2]}, 3);
  return {found[0], found[1], found[2]};
}

std::optional<Matrix3> MjcfFile::written_rotation(const XmlElement& level, const std::string& attribute) {
  const char* const name = attribute.c_str();
  const std::size_t count = attribute == "xyaxes"                             ? 6
                            : attribute == "quat" || attribute == "axisangle" ? 4
                                                                              : 3;
  const auto given = listed(level, name, count, count);
  if (!given) return {};
  const std::vector<double>& v = *given;
  std::optional<Matrix3> R;
  if (attribute == "quat")
    R = rotation_from_quaternion({v[0], v[1], v[2], v[3]});
  else if (attribute == "axisangle")
    R = rotation_about({v[0], v[1], v[2]}, v[3] * angle_unit_);
  else if (attribute == "euler")
    R = rotation_from_euler({v[0] * angle_unit_, v[1] * angle_unit_, v[2] * angle_unit_}, euler_sequence_);
  else if (attribute == "xyaxes")
    R = rotation_from_axes({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  else
    R = rotation_to({v[0], v[1], v[2]});
  if (R) return R;
  xml_.complete().numbers = false;
  error(xml_.value(level, name), fmt::format("'{}' of <{}> gives no direction", attribute, level.Name()),
        attribute == "xyaxes" ? "the two axes are parallel, or one is zero" : "all its numbers are zero");
  return {};
}

bool MjcfFile::is_oriented(const XmlElement& element) const {
  const std::vector<std::string>& others = other_orientations();
  return holder(element, "quat") || std::any_of(others.begin(), others.end(), [&](const std::string& name) {
           return holder(element, name.c_str()) != nullptr;
         });
}

Matrix3 MjcfFile::rotation(const XmlElement& element) {
  for (const XmlElement* level : levels(element)) {
    std::vector<std::string> given;
    for (const std::string& name : other_orientations())
      if (level->Attribute(name.c_str())) given.push_back(name);
    const bool with_quaternion = !given.empty() && level->Attribute("quat") != nullptr;
    if (given.size() > 1 || with_quaternion) {
      error(xml_.value(*level, given.back().c_str()),
            fmt::format("<{}> has two orientations, '{}' and '{}'", level->Name(),
                        with_quaternion ? "quat" : given.front(), given.back()));
      return kIdentity3;
    }
    if (!given.empty()) return written_rotation(*level, given.front()).value_or(kIdentity3);
  }
  const XmlElement* quaternion = holder(element, "quat");
  return quaternion ? written_rotation(*quaternion, "quat").value_or(kIdentity3) : kIdentity3;
}

Pose MjcfFile::pose(const XmlElement& element) { return {triple(element, "pos", {}), rotation(element)}; }

}  // namespace jourdain::model
