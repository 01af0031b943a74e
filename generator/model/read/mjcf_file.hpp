// Typed access to the attributes of an MJCF file: an element's own, otherwise those of its default class.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/read/mjcf_pose.hpp"
#include "model/read/urdf_file.hpp"

namespace jourdain::model {

/// One MJCF file while it is read: its default classes and what <compiler> says of angles.
class MjcfFile {
 public:
  /// Reads <compiler> and <default>; `root` is <mujoco>.
  MjcfFile(UrdfFile& xml, const XmlElement& root);

  UrdfFile& xml() { return xml_; }
  const XmlElement& root() const { return root_; }
  void error(SourceRange where, std::string message, std::string hint = "");
  void warning(SourceRange where, std::string message, std::string hint = "");

  /// The last <compiler> that has the attribute; null: none has.
  const XmlElement* compiler(const char* attribute) const { return section("compiler", attribute); }
  /// The last child `name` of <mujoco> that has the attribute: a section may stand there several times.
  const XmlElement* section(const char* name, const char* attribute) const;

  /// Reports a default class that an element names and that is not there.
  void check_class(const XmlElement& element, const char* attribute);

  /// The element that says what the attribute of `element` is: itself, otherwise that of its name (of any actuator's
  /// name for an actuator) in its default class or the classes around that; null: none does.
  const XmlElement* holder(const XmlElement& element, const char* attribute) const;

  /// `element`, then those of its classes that say something of it, innermost first.
  std::vector<const XmlElement*> levels(const XmlElement& element) const;
  /// Puts the numbers that `level` itself has, at least `least`, over the first of `into`.
  void overlay(const XmlElement& level, const char* attribute, std::vector<double>& into, std::size_t least);

  std::optional<std::string> word(const XmlElement& element, const char* attribute) const;
  /// One of `known`; an error and `otherwise` where it is another.
  std::string choice(const XmlElement& element, const char* attribute, const std::vector<std::string>& known,
                     const std::string& otherwise);
  bool truth(const XmlElement& element, const char* attribute, bool otherwise);
  double number(const XmlElement& element, const char* attribute, double otherwise);
  /// As many numbers as `otherwise` has, at least `least`; where fewer are given, the outer class's stand.
  std::vector<double> numbers(const XmlElement& element, const char* attribute, std::vector<double> otherwise,
                              std::size_t least);
  Numbers3 triple(const XmlElement& element, const char* attribute, const Numbers3& otherwise);

  /// rad of the unit that the file's angles are in.
  double angle_unit() const { return angle_unit_; }
  /// pos and one of quat, axisangle, euler, xyaxes, zaxis.
  Pose pose(const XmlElement& element);
  /// Whether an orientation is given, by any of them.
  bool is_oriented(const XmlElement& element) const;

 private:
  struct Class {
    std::map<std::string, std::vector<const XmlElement*>> elements;  ///< by name; of all actuators as one
    std::string outer;                                               ///< empty: none
    SourceRange where;
  };
  void read_class(const XmlElement& block, const std::string& outer);
  void read_compiler();
  std::string class_of(const XmlElement& element) const;
  std::optional<std::vector<double>> listed(const XmlElement& element, const char* attribute,
                                            std::size_t least, std::size_t most);
  Matrix3 rotation(const XmlElement& element);
  std::optional<Matrix3> written_rotation(const XmlElement& level, const std::string& attribute);

  UrdfFile& xml_;
  const XmlElement& root_;
  std::map<std::string, Class> classes_;
  std::size_t outermost_blocks_ = 0;
  double angle_unit_ = 0;
  std::string euler_sequence_ = "xyz";
};

/// Whether an element of <actuator> has that name; they share their defaults.
bool is_actuator_name(const std::string& name);
/// Names of the elements that stand for an actuator.
const std::vector<std::string>& actuator_names();

}  // namespace jourdain::model
