#include "model/read/format.hpp"

#include "model/read/xml_text.hpp"

namespace jourdain::model {

Format format_of(const std::string& path, const std::string& text) {
  const bool is_xml = path.ends_with(".urdf") || path.ends_with(".xml");
  const std::string root = is_xml ? first_element(text) : "";
  if (path.ends_with(".sdf") || path.ends_with(".world") || root == "sdf") return Format::kSdf;
  if (path.ends_with(".mjcf") || root == "mujoco") return Format::kMjcf;
  return is_xml ? Format::kUrdf : Format::kToml;
}

}  // namespace jourdain::model
