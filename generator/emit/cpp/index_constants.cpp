#include "emit/cpp/index_constants.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/cpp/comments.hpp"
#include "emit/unique_names.hpp"

namespace jourdain::emit::cpp {

std::string index_constants(const ModelText& model) {
  std::string lines;
  std::vector<std::string> examples;
  const auto add = [&](const char* array, const char* prefix, const std::vector<std::string>& names) {
    const std::vector<std::string> constants = unique_names(prefix, names);
    for (std::size_t i = 0; i < constants.size(); ++i)
      lines += fmt::format("inline constexpr int {} = {};\n", constants[i], i);
    if (!constants.empty()) examples.push_back(fmt::format("{}[index::{}]", array, constants[0]));
  };
  add("state.y", "y_", model.facts.positions);
  add("state.z", "z_", model.facts.velocities);
  add("input.u", "u_", model.facts.inputs);
  if (lines.empty()) return "";
  return "\n" + wrapped_comment(fmt::format("Entries by name: {}.", fmt::join(examples, ", "))) +
         "namespace index {\n" + lines + "}  // namespace index\n";
}

}  // namespace jourdain::emit::cpp
