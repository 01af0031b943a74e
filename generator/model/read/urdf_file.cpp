#include "model/read/urdf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "model/matrix3.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

using support::shown;

const XmlElement* UrdfFile::child(const XmlElement& parent, const char* name) {
  const XmlElement* first = parent.FirstChildElement(name);
  const XmlElement* second = first ? first->NextSiblingElement(name) : nullptr;
  if (second)
    diagnostics_.error(element(*second), fmt::format("<{}> has two <{}>", parent.Name(), name),
                       fmt::format("the first one stands at line {}", element(*first).line));
  return first;
}

void UrdfFile::check_children(const XmlElement& parent, const std::vector<std::string>& known) {
  for (const auto* item = parent.FirstChildElement(); item; item = item->NextSiblingElement()) {
    const std::string name = item->Name();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string close = support::nearest(name, known);
    if (name.starts_with("xacro:"))
      diagnostics_.error(element(*item), fmt::format("<{}> is a macro", shown(name)),
                         "expand the file with xacro first");
    else if (!close.empty())
      diagnostics_.warning(element(*item), fmt::format("element <{}> is ignored", shown(name)),
                           fmt::format("did you mean <{}>?", close));
  }
}

std::vector<std::string> UrdfFile::other_attributes(const XmlElement& where,
                                                    const std::vector<std::string>& known) {
  std::vector<std::string> others;
  for (const auto* attribute = where.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string name = attribute->Name();
    if (name.find(':') == std::string::npos && std::find(known.begin(), known.end(), name) == known.end())
      others.push_back(name);
  }
  return others;
}

void UrdfFile::check_attributes(const XmlElement& where, const std::vector<std::string>& known) {
  for (const std::string& name : other_attributes(where, known)) {
    const std::string close = support::nearest(name, known);
    diagnostics_.warning(value(where, name.c_str()),
                         fmt::format("attribute '{}' of <{}> is ignored", shown(name), shown(where.Name())),
                         close.empty() ? "" : fmt::format("did you mean '{}'?", close));
  }
}

std::optional<std::string> UrdfFile::required(const XmlElement& where, const char* attribute) {
  if (const char* text = where.Attribute(attribute)) return text;
  diagnostics_.error(element(where), fmt::format("<{}> needs the attribute '{}'", where.Name(), attribute));
  return {};
}

std::optional<std::string> UrdfFile::name(const XmlElement& where, const char* attribute) {
  constexpr int kLongest = 100;
  std::optional<std::string> text = required(where, attribute);
  if (!text) return {};
  int length = 0;
  bool printable = true;
  for (std::size_t i = 0; i < text->size(); ++length) {
    const support::Utf8Character character = support::utf8_at(*text, i);
    printable = printable && character.printable;
    i += character.bytes;
  }
  if (printable && length > 0 && length <= kLongest) return text;
  const char* const why = length == 0  ? "is empty"
                          : !printable ? "has characters that cannot be printed"
                                       : "is longer than 100 characters";
  diagnostics_.error(value(where, attribute), fmt::format("the name of <{}> {}", where.Name(), why));
  return {};
}

std::vector<UrdfFile::Word> UrdfFile::words(const std::string& text) {
  constexpr const char* kSpaces = " \t\r\n";
  std::vector<Word> result;
  for (std::size_t i = text.find_first_not_of(kSpaces); i != std::string::npos;
       i = text.find_first_not_of(kSpaces, i)) {
    const std::size_t end = std::min(text.find_first_of(kSpaces, i), text.size());
    result.push_back({i, text.substr(i, end - i)});
    i = end;
  }
  return result;
}

double UrdfFile::parsed(const XmlElement& where, const char* attribute, const Word& word) {
  return parsed(positions_.part_of_value(where, attribute, word.offset, word.text.size()), word.text);
}

double UrdfFile::parsed(SourceRange where, const std::string& word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  const char* const begin = word.data() + (plus ? 1 : 0);
  const char* const end = word.data() + word.size();
  double result = 0;
  const auto [stop, error] = std::from_chars(begin, end, result);
  std::string message;
  if (error == std::errc::result_out_of_range)
    message = fmt::format("'{}' is out of the range of double precision", shown(word));
  else if (error != std::errc() || stop != end)
    message = fmt::format("'{}' is not a number", shown(word));
  else if (!std::isfinite(result))
    message = fmt::format("'{}' is not finite", shown(word));
  if (message.empty()) return result;
  complete_.numbers = false;
  const bool macro = word.find("${") != std::string::npos;
  diagnostics_.error(where, message, macro ? "expand the file with xacro first" : "");
  return 0;
}

double UrdfFile::number(const XmlElement& where, const char* attribute, double otherwise) {
  const char* text = where.Attribute(attribute);
  if (!text) return otherwise;
  const std::vector<Word> found = words(text);
  if (found.size() == 1) return parsed(where, attribute, found[0]);
  complete_.numbers = false;
  diagnostics_.error(value(where, attribute), fmt::format("'{}' of <{}> needs 1 number, found {}", attribute,
                                                          where.Name(), found.size()));
  return 0;
}

double UrdfFile::required_number(const XmlElement& where, const char* attribute) {
  if (!required(where, attribute)) complete_.numbers = false;
  return number(where, attribute, 0);
}

std::array<double, 3> UrdfFile::triple(const XmlElement& where, const char* attribute,
                                       const std::array<double, 3>& otherwise) {
  const char* text = where.Attribute(attribute);
  if (!text) return otherwise;
  const std::vector<Word> found = words(text);
  if (found.size() != 3) {
    complete_.numbers = false;
    diagnostics_.error(value(where, attribute), fmt::format("'{}' of <{}> needs 3 numbers, found {}",
                                                            attribute, where.Name(), found.size()));
    return otherwise;
  }
  const std::size_t mark = diagnostics_.all().size();
  const std::array<double, 3> result{parsed(where, attribute, found[0]), parsed(where, attribute, found[1]),
                                     parsed(where, attribute, found[2])};
  return diagnostics_.all().size() == mark ? result : otherwise;
}

/// As URDF 1.2 has it.
Placement UrdfFile::turned_by_quaternion(const XmlElement& origin, const std::array<double, 3>& xyz) {
  const SourceRange where = value(origin, "quat_xyzw");
  const std::vector<Word> found = words(origin.Attribute("quat_xyzw"));
  const std::size_t mark = diagnostics_.all().size();
  std::string problem;
  if (origin.Attribute("rpy")) problem = "<origin> has 'rpy' and 'quat_xyzw'";
  if (found.size() != 4)
    problem = fmt::format("'quat_xyzw' of <origin> needs 4 numbers, found {}", found.size());
  std::array<double, 4> xyzw{};
  for (std::size_t k = 0; k < 4 && problem.empty(); ++k) xyzw[k] = parsed(origin, "quat_xyzw", found[k]);
  const auto rotation = rotation_from_quaternion({xyzw[3], xyzw[0], xyzw[1], xyzw[2]});
  if (diagnostics_.all().size() != mark) return {};
  if (problem.empty() && !rotation) problem = "the quaternion of <origin> is zero";
  if (problem.empty()) {
    const Numbers3 rpy = rpy_of(*rotation);
    return {{xyz[0], xyz[1], xyz[2]}, {{rpy[0], rpy[1], rpy[2]}, where}};
  }
  complete_.numbers = false;
  diagnostics_.error(where, problem);
  return {};
}

Placement UrdfFile::origin(const XmlElement& parent) {
  const XmlElement* element_found = child(parent, "origin");
  if (!element_found) return {};
  const auto xyz = triple(*element_found, "xyz", {});
  if (element_found->Attribute("quat_xyzw")) return turned_by_quaternion(*element_found, xyz);
  const auto rpy = triple(*element_found, "rpy", {});
  return {{xyz[0], xyz[1], xyz[2]}, {{rpy[0], rpy[1], rpy[2]}, value(*element_found, "rpy")}};
}

}  // namespace jourdain::model
