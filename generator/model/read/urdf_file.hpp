// Typed access to the elements and attributes of a URDF file; problems become diagnostics.
#pragma once

#include <tinyxml2.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "model/read/xml_positions.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

using XmlElement = tinyxml2::XMLElement;

/// One URDF file while it is read.
class UrdfFile {
 public:
  UrdfFile(support::Diagnostics& diagnostics, const std::vector<std::size_t>& starts,
           const tinyxml2::XMLDocument& document)
      : diagnostics_(diagnostics), positions_(diagnostics.text(), starts, document) {}

  support::Diagnostics& diagnostics() { return diagnostics_; }
  Completeness& complete() { return complete_; }

  SourceRange element(const XmlElement& element) const { return positions_.element(element); }
  SourceRange value(const XmlElement& element, const char* attribute) const {
    return positions_.value(element, attribute);
  }

  /// The element `name` within `parent`; nothing where there is none, the first one and a diagnostic where
  /// there are several.
  const XmlElement* child(const XmlElement& parent, const char* name);

  /// Reports child elements that look like a misspelling of one in `known` (a warning) or that are macros not
  /// yet expanded (an error). All others are none of our business: URDF files carry elements of many
  /// programs.
  void check_children(const XmlElement& parent, const std::vector<std::string>& known);

  /// The attributes that are not `known`. Those with a prefix (xmlns:xacro) are of other programs.
  static std::vector<std::string> other_attributes(const XmlElement& element,
                                                   const std::vector<std::string>& known);
  /// Warns of those.
  void check_attributes(const XmlElement& element, const std::vector<std::string>& known);

  /// The text of an attribute that must be there; nothing after a diagnostic.
  std::optional<std::string> required(const XmlElement& element, const char* attribute);
  /// A name: required, printable, not empty, at most 100 characters.
  std::optional<std::string> name(const XmlElement& element, const char* attribute = "name");

  /// A number that must be there; 0 after a diagnostic.
  double required_number(const XmlElement& element, const char* attribute);
  double number(const XmlElement& element, const char* attribute, double otherwise);
  /// Three numbers; `otherwise` where the attribute is missing or after a diagnostic.
  std::array<double, 3> triple(const XmlElement& element, const char* attribute,
                               const std::array<double, 3>& otherwise);
  /// Of the child element <origin> of `parent`; the identity where there is none.
  Placement origin(const XmlElement& parent);

 protected:
  struct Word {
    std::size_t offset = 0;
    std::string text;
  };
  static std::vector<Word> words(const std::string& text);
  /// The number that stands at `where`; 0 after a diagnostic.
  double parsed(SourceRange where, const std::string& word);

 private:
  double parsed(const XmlElement& element, const char* attribute, const Word& word);
  Placement turned_by_quaternion(const XmlElement& origin, const std::array<double, 3>& xyz);

  support::Diagnostics& diagnostics_;
  XmlPositions positions_;
  Completeness complete_;
};

}  // namespace jourdain::model
