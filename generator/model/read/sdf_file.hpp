// Typed access to the elements of an SDF file, whose values are texts of elements; problems become diagnostics.
#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "model/read/sdf_pose.hpp"
#include "model/read/urdf_file.hpp"

namespace jourdain::model {

/// One SDF file while it is read.
class SdfFile : public UrdfFile {
 public:
  SdfFile(support::Diagnostics& diagnostics, const std::vector<std::size_t>& starts,
          const tinyxml2::XMLDocument& document, double snap)
      : UrdfFile(diagnostics, starts, document), snap_(snap) {}

  /// The y of version 1.y.
  int version = 0;

  /// The text of the child `name`, without blanks around it; nothing where there is none.
  std::optional<std::string> text_in(const XmlElement& parent, const char* name);
  double number_in(const XmlElement& parent, const char* name, double otherwise);
  bool flag_in(const XmlElement& parent, const char* name, bool otherwise);
  /// An attribute that is true or false.
  bool truth_of(const XmlElement& element, const char* attribute, bool otherwise);
  /// Three numbers of the element itself.
  std::array<double, 3> triple_of(const XmlElement& element, const std::array<double, 3>& otherwise);
  /// A limit; nothing where it is missing or at least 1e15, which stands for none.
  std::optional<double> limit_in(const XmlElement& parent, const char* name);

  /// Of the child <pose>; the identity where there is none. Angles within the snapping tolerance of a right angle are
  /// that. `where` becomes the range of the element.
  SdfPose pose_in(const XmlElement& parent, SourceRange& where);
  /// What that pose is relative to; empty where it does not say.
  std::string pose_base(const XmlElement& parent);

  /// A warning for each child that is not among `known` and has no prefix.
  void check_elements(const XmlElement& parent, std::initializer_list<const char*> known);

  void error(SourceRange where, std::string message, std::string hint = "") {
    diagnostics().error(where, std::move(message), std::move(hint));
  }
  double snap() const { return snap_; }
  /// One note that says how many angles became right ones.
  void note_snapped();

 private:
  bool truth(SourceRange where, const std::string& what, const std::string& text, bool otherwise);
  std::vector<double> numbers(const XmlElement& element);
  double snapped(double angle, SourceRange where);

  double snap_;
  std::size_t snapped_ = 0;
  SourceRange first_snapped_;
};

}  // namespace jourdain::model
