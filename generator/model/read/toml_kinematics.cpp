// [[kinematics]]
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/kinematic_kinds.hpp"
#include "model/names.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

class KinematicsReader {
 public:
  KinematicsReader(TomlFile& file, const TomlTable& table, Mechanism& mechanism)
      : file_(file), table_(table), mechanism_(mechanism) {}

  void read() {
    const std::string prefix = table_.text("name").value_or("");
    if (!prefix.empty()) check_identifier(file_, table_.where("name"), "function", prefix);
    std::optional<FrameIndex> frame;
    if (table_.has("frame")) {
      frame = find_frame(file_, table_, "frame", mechanism_);
      if (!frame) return;
      if (prefix.empty()) return table_.missing("name", "functions of a frame begin with it");
    }
    const std::optional<std::size_t> axes = table_.choice("axes", axes_names());
    if (!axes) return;
    const toml::node* node = table_.find("quantities");
    if (!node) return table_.missing("quantities", "[\"pose\", \"jacobian\"], for example");
    const toml::array* list = node->as_array();
    if (!list || !std::all_of(list->begin(), list->end(), [](const toml::node& n) { return n.is_string(); }))
      return table_.error("quantities",
                          fmt::format("{} must be a list of texts", table_.quoted("quantities")));
    if (list->empty())
      return table_.error("quantities", "no function is asked for", "[\"pose\"], for example");
    for (const toml::node& text : *list)
      add(prefix, frame, static_cast<Axes>(*axes), text.as_string()->get(), file_.range(text.source()));
  }

 private:
  void add(const std::string& prefix, std::optional<FrameIndex> frame, Axes axes, const std::string& text,
           SourceRange where) {
    const std::variant<std::vector<KinematicQuantity>, KinematicError> parsed =
        parse_quantities(text, frame.has_value());
    if (const auto* wrong = std::get_if<KinematicError>(&parsed))
      return file_.error(where, wrong->message, wrong->hint);
    const std::string wrong = add_kinematic_function(mechanism_, prefix, frame, axes,
                                                     std::get<std::vector<KinematicQuantity>>(parsed), where);
    if (!wrong.empty()) file_.error(where, wrong);
  }

  TomlFile& file_;
  const TomlTable& table_;
  Mechanism& mechanism_;
};

}  // namespace

void read_kinematics(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "[[kinematics]]", file.range(node.source()),
                          keys_of("kinematics"));
    KinematicsReader(file, table, mechanism).read();
  }
}

}  // namespace jourdain::model
